// What a student does with the live panel, in headless Chromium: live_test.mjs FOLDER BOOKSPIN
// FOLDER holds site/ and node_modules/. Prints one line a check; exit code 1 when one fails, 77 without a panel.

import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { axe, check, close, expect, finish, launch, openPage } from "./browser.mjs";
import { liveKeys } from "./live_keys.mjs";

const [folder, bookspin] = process.argv.slice(2);
const address = pathToFileURL(join(folder, "site", "index.html")).href;
if (!readFileSync(join(folder, "site", "index.html"), "utf8").includes('id="live-data"')) {
  console.log("page_live skipped: the page has no live panel, as its module could not be built (docs/LIVE.md)");
  process.exit(77);
}

const browser = await launch("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader");

// The page, its panel there, in sight and at the end of its motion.
async function open(hash = "", options = {}) {
  const page = await openPage(browser, address + hash, { viewport: { width: 640, height: 700 }, reducedMotion: "reduce", ...options });
  page.context().setDefaultTimeout(120000);
  await page.waitForFunction(() => document.getElementById("live").panel);
  await page.locator("#live .live-grid").scrollIntoViewIfNeeded();
  await complete(page);
  return page;
}
const complete = (page) => page.waitForFunction(() => document.getElementById("live").panel.complete);
const panel = (page, look) => page.evaluate(`((panel) => (${look}))(document.getElementById("live").panel)`);
async function is(page, look, wanted) {
  const now = await panel(page, look);
  expect(JSON.stringify(now) === JSON.stringify(wanted), `${look}: ${JSON.stringify(now)}, not ${JSON.stringify(wanted)}`);
}
const control = (page, name) => page.locator(`#live [name="${name}"]`);

await check("every control changes what it says, and the address", async () => {
  const page = await open();
  const slide = async (name, look) => {
    const was = await panel(page, look);
    await control(page, name).focus();
    await page.keyboard.press("ArrowRight");
    const now = await panel(page, look);
    expect(now > was, `${name}: ${was}, then ${now}`);
    const said = await control(page, name).getAttribute("aria-valuetext");
    expect(said === (await control(page, name).locator("xpath=ancestor::p").locator("output").textContent()), said);
    expect((await page.evaluate(() => location.hash)).includes(`${name}=`), `${name} is not in the address`);
  };
  for (const [name, key] of [["kick", "jiggle"], ["stiffness", "stiffness"], ["mass", "particle_mass"], ["damping", "damping"], ["every", "normalize_every"]]) {
    await slide(name, `panel.book.${key}`);
  }
  await slide("time", "panel.scene.time_per_frame");
  await slide("steps", "panel.scene.substeps");
  for (const [axis, at] of [["1", 1], ["2", 2], ["0", 0]]) {
    await page.locator(`#live [name="axis"][value="${axis}"]`).click();
    await is(page, "panel.book.angular_velocity.map((x) => x > 0)", [0, 1, 2].map((d) => d === at));
  }
  for (const name of ["ghost", "springs"]) {
    await control(page, name).click();
    await is(page, `panel.book.show.includes("${name === "ghost" ? "exact" : name}")`, true);
  }
  await control(page, "trace").click();
  await is(page, 'panel.book.show.includes("trace")', false);
  await control(page, "damping").focus();
  await page.keyboard.press("Home");
  await control(page, "integrator").selectOption("velocity_verlet");
  await is(page, "panel.book.integrator", "velocity_verlet");
  for (const method of ["matrix", "quaternion", "exact", "springs"]) {
    await page.locator(`#live [name="method"][value="${method}"]`).click();
    await is(page, "panel.book.method", method);
    expect((await control(page, "stiffness").isVisible()) === (method === "springs"), `stiffness of ${method}`);
    expect((await control(page, "steps").isVisible()) === (method !== "exact"), `steps of ${method}`);
    await complete(page);
    expect(/turn|explode/.test(await page.locator("#live-told").textContent()), "it is not told in words");
  }
  await page.locator('#live [data-live="anew"]').click();
  await is(page, "JSON.stringify(panel.scene) === JSON.stringify(homeScene)", true);
  await close(page);
});

await check("the original's keys", async () => {
  const page = await open();
  const canvas = page.locator("#live .live-stage canvas");
  await canvas.focus();
for (const [key, look, wanted] of liveKeys) {
    await page.keyboard.press(key);
    await is(page, look, wanted);
  }
  await page.keyboard.press("Control+r").catch(() => {});
  await close(page);
});

await check("its buttons, its time and a drag in the picture", async () => {
  const page = await open();
  const press = (name) => page.locator(`#live [data-do="${name}"]`).click();
  await press("on");
  await is(page, "panel.place", 1);
  await press("back");
  await is(page, "panel.place", 0);
  await press("play");
  await page.waitForFunction(() => document.getElementById("live").panel.place > 2);
  await press("play");
  await is(page, "panel.playing", false);
  await press("restart");
  await is(page, "panel.place", 0);
  await press("speed");
  await is(page, "panel.rate", 2);
  const seek = page.locator("#live .seek");
  await seek.scrollIntoViewIfNeeded();
  const bar = await seek.boundingBox();
  await page.mouse.click(bar.x + bar.width / 2, bar.y + 20);
  await is(page, "Math.abs(panel.place / panel.end - 0.5) < 0.01", true);
  await seek.press("End");
  await is(page, "panel.place === panel.end - 1", true);
  await page.waitForFunction(() => Number(document.querySelector("#live .seek").getAttribute("aria-valuenow")) === document.getElementById("live").panel.end - 1);
  const canvas = page.locator("#live .live-stage canvas");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  await page.mouse.move(box.x + 100, box.y + 100);
  await page.mouse.down();
  await page.mouse.move(box.x + 220, box.y + 130, { steps: 4 });
  await page.mouse.up();
  await is(page, "panel.from[0] < 0 && panel.from[1] > 0.3", true);
  await press("view");
  await is(page, "panel.from", [0.35, 0.3, 1]);
  await close(page);
});

// The picture: how many of its pixels are not background, in each of four quarters.
const inked = (page) => page.evaluate(() => {
  const { panel } = document.getElementById("live");
  panel.draw();
  const { canvas } = panel.painter;
  const pixels = new Uint8Array(4 * canvas.width * canvas.height);
  const copied = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
  copied.drawImage(canvas, 0, 0);
  pixels.set(copied.getImageData(0, 0, canvas.width, canvas.height).data);
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) if (Math.abs(pixels[i] - 32) + Math.abs(pixels[i + 1] - 39) + Math.abs(pixels[i + 2] - 49) > 12) ++count;
  return count / (canvas.width * canvas.height);
});

await check("a book is drawn, and again after the context was lost", async () => {
  const page = await open("#live?show=exact.trace.springs");
  const before = await inked(page);
  expect(before > 0.05 && before < 0.6, `${before} of the picture`);
  await page.evaluate(() => {
    const { gl } = document.getElementById("live").panel.painter;
    const extension = gl.getExtension("WEBGL_lose_context");
    extension.loseContext();
    setTimeout(() => extension.restoreContext(), 100);
  });
  await page.waitForFunction(() => document.getElementById("live").panel.painter.gl.isContextLost());
  await page.waitForFunction(() => !document.getElementById("live").panel.painter.gl.isContextLost());
  await page.waitForTimeout(300);
  const after = await inked(page);
  expect(Math.abs(after - before) < 0.001, `${after}, was ${before}`);
  page.complaints = page.complaints.filter((text) => !/CONTEXT_LOST_WEBGL/.test(text));
  await close(page);
});

await check("k is raised until it explodes; the script that is copied explodes in the same frame", async () => {
  const page = await open("#live?every=0&stiffness=50");
  await control(page, "stiffness").focus();
  for (let i = 0; i < 60 && (await panel(page, "panel.engine.exploded(0)")) < 0; ++i) {
    await page.keyboard.press("ArrowRight");
    await complete(page);
  }
  const frame = await panel(page, "panel.engine.exploded(0)");
  expect(frame > 0, "it never explodes");
  expect((await page.locator("#live-told").textContent()).includes("explodes at t ="), "the moment is not told");
  await page.locator('#live [data-live="script"]').click();
  await page.waitForFunction(() => document.getElementById("status").textContent !== "");
  const script = await page.evaluate(() => navigator.clipboard.readText());
  const file = join(folder, "copied.toml");
  writeFileSync(file, script);
  const rows = execFileSync(bookspin, ["trajectory", file], { encoding: "utf8", maxBuffer: 1 << 28 }).trim().split("\n").map((row) => row.split(","));
  const exploded = rows[0].indexOf("exploded");
  const found = rows.slice(1).find((row) => Number(row[exploded]) === 1);
  expect(Number(found[0]) === frame, `frame ${found[0]} by the program, ${frame} here`);
  await close(page);
});

const ordered = (value) => JSON.stringify(value, (_, part) => (part && part.constructor === Object ? Object.fromEntries(Object.entries(part).sort()) : part));

await check("every film's scene is taken over, and its script gives that scene", async () => {
  const page = await open();
  const films = await page.evaluate(() => Object.keys(liveData.films));
  expect(films.length >= 12, `${films.length} films`);
  const scenes = await page.evaluate(() => Object.values(liveData.films).map(({ scene }) => scene));
  // Bodies of other kinds too, which are in no film of this page.
  const gallery = new URL("../../videos/more/", import.meta.url).pathname;
  for (const file of readdirSync(gallery)) scenes.push(JSON.parse(execFileSync(bookspin, ["json", join(gallery, file)], { encoding: "utf8" })));
  for (const scene of scenes) {
    const script = await page.evaluate((one) => scriptOf(one, one.from), scene);
    const file = join(folder, "taken.toml");
    writeFileSync(file, script);
    const again = JSON.parse(execFileSync(bookspin, ["json", file], { encoding: "utf8" }));
    const [is, was] = [again, scene].map(ordered);
    expect(is === was, `${is}, not ${was}`);
  }
  for (const id of ["fig12_pulsating_quaternion", "compare_methods"]) {
    await page.locator(`[data-take="${id}"]`).click();
    await is(page, "panel.film", id);
    await page.waitForFunction(() => {
      const { top } = document.getElementById("live").getBoundingClientRect();
      const rests = window.lastTop === top;
      window.lastTop = top;
      return rests && Math.abs(top) < 60;
    }, null, { polling: 200 });
    await complete(page);
    expect((await inked(page)) > 0.02, `${id} is not to be seen`);
  }
  await control(page, "book").selectOption("2");
  await control(page, "steps").focus();
  await page.keyboard.press("ArrowLeft");
  expect((await page.evaluate(() => location.hash)).startsWith("#live?film=compare_methods&steps="), await page.evaluate(() => location.hash));
  await close(page);
});

await check("an address gives the scene that gave it", async () => {
  const page = await open("#live?film=fig02_experiment&time=0.123&method1=matrix&every1=7&kick2=0.05&show=exact.springs&from=1_0.5_-2");
  const state = 'JSON.stringify([panel.film, panel.scene, panel.from])';
  const was = await panel(page, state);
  expect(was.includes('"normalize_every":7') && was.includes('"jiggle":0.05') && was.includes("0.123") && was.includes("[1,0.5,-2]"), was);
  const hash = await page.evaluate(() => location.hash);
  await close(page);
  const again = await open(hash);
  expect((await panel(again, state)) === was, "another scene");
  // A link within the page, too; and back again.
  await again.locator('#live .live-try a').nth(2).click();
  await again.waitForFunction(() => document.getElementById("live").panel.scene.books[0].stiffness === 75);
  await close(again);
});

await check("numbers in the text move the panel, which comes beside them", async () => {
  const page = await open();
  const number = (name) => page.locator(`.drag[data-drag="${name}"]`);
  const shown = (name) => number(name).textContent();
  // The step of damped springs, which the text calls too long above about 0.04.
  await number("steps").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => !document.getElementById("live").panel.placeInSight);
  expect((await shown("steps")) === "h = 0.0357", await shown("steps"));
  await number("steps").press("ArrowRight");
  await number("steps").press("ArrowRight");
  expect((await shown("steps")) === "h = 0.0417", await shown("steps"));
  expect((await number("steps").getAttribute("aria-valuetext")) === "h = 0.0417", "it is not said");
  await is(page, "[panel.afloat, panel.scene.substeps, panel.book.normalize_every]", [true, 12, 0]);
  await complete(page);
  await is(page, "panel.engine.exploded(0)", 29);
  await number("steps").press("ArrowLeft");
  await complete(page);
  await is(page, "panel.engine.exploded(0)", -1);  // 0.0385
  await page.mouse.click(5, 5);
  await is(page, "panel.afloat", false);
  // Dragged; another number brings a scene of its own.
  await number("stiffness").scrollIntoViewIfNeeded();
  const box = await number("stiffness").boundingBox();
  await page.mouse.move(box.x + 10, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 50, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  await is(page, "[panel.afloat, panel.book.stiffness > 1, panel.book.damping, panel.scene.substeps]", [true, true, 0, 30]);
  const over = await page.evaluate(() => {
    const [a, b] = [".drag[data-drag=stiffness]", ".afloat"].map((one) => document.querySelector(one).getBoundingClientRect());
    return a.bottom > b.top && a.top < b.bottom && a.right > b.left;
  });
  expect(!over, "the screen lies over the number");
  await number("kick").press("ArrowLeft");
  await is(page, '[panel.book.method, panel.book.jiggle < 0.01, location.hash.startsWith("#live?method=exact&kick=")]', ["exact", true, true]);
  await page.evaluate(() => document.getElementById("live").scrollIntoView({ behavior: "instant" }));
  await page.waitForFunction(() => !document.getElementById("live").panel.afloat);
  await close(page);
});

await check("hostile addresses are harmless", async () => {
  const home = await (async () => {
    const page = await open();
    const scene = await panel(page, "JSON.stringify(panel.scene)");
    await close(page);
    return scene;
  })();
  for (const hash of ["#live?film=__proto__", "#live?film=%3Cscript%3Ealert(1)%3C/script%3E", "#live?stiffness=1e999&mass=-1&kick=NaN&time=0&steps=1e9",
    "#live?steps=2.5&every=1.5&damping=", "#live?method=constructor&integrator=dmv&axis=w&show=__proto__.<img>", "#live?from=0_1_0", "#live?from=1e9_2_x",
    "#live?" + "x".repeat(20000), "#live?%", "#live?time=Infinity&stiffness=0x&mass=%00"]) {
    const page = await open(hash);
    expect((await panel(page, "JSON.stringify(panel.scene)")) === home, `${hash.slice(0, 60)}: ${await panel(page, "JSON.stringify(panel.scene)")}`);
    await is(page, "panel.from", [0.35, 0.3, 1]);
    await close(page);
  }
});

await check("memory stays as it is through 23 motions, nearly eight minutes if watched", async () => {
  const page = await open();
  const cdp = await page.context().newCDPSession(page);
  const after = async (motions) => {
    const wasm = await page.evaluate((count) => {
      const { panel } = document.getElementById("live");
      for (let i = 0; i < count; ++i) {
        panel.set("stiffness", 10 + (i % 2));
        while (!panel.complete) panel.compute();
        for (let frame = 0; frame < panel.end; frame += 100) {
          panel.place = frame;
          panel.draw();
          panel.drawCurves(0);
        }
      }
      return panel.engine.track(0).buffer.byteLength;
    }, motions);
    await cdp.send("HeapProfiler.collectGarbage");
    return { wasm, page: (await cdp.send("Runtime.getHeapUsage")).usedSize };
  };
  const [once, often] = [await after(3), await after(20)];
  expect(often.wasm === once.wasm, `${often.wasm} bytes of the module's, were ${once.wasm}`);
  expect(often.page < 1.1 * once.page, `${often.page} bytes of the page's, were ${once.page}`);  // measured: 1.02
  await close(page);
});

await check("it plays in sight, rests out of sight, and is paused for those who want less motion", async () => {
  const calm = await open();
  await is(calm, "panel.playing", false);
  await close(calm);
  const page = await open("", { reducedMotion: "no-preference" });
  await page.waitForFunction(() => document.getElementById("live").panel.place > 1);
  await page.evaluate(() => document.querySelector("footer").scrollIntoView({ behavior: "instant" }));
  await page.waitForFunction(() => !document.getElementById("live").panel.inSight);
  await page.waitForTimeout(300);
  const place = await panel(page, "panel.place");
  await page.waitForTimeout(600);
  await is(page, "panel.place", place);
  await close(page);
});

for (const width of [360, 1280]) {
  for (const colorScheme of ["light", "dark"]) {
    await check(`accessible at ${width} pixels, ${colorScheme}`, async () => {
      const page = await open("", { viewport: { width, height: 700 }, colorScheme });
      await page.locator("#live summary").click();
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => globalThis.axe.run("#live", { resultTypes: ["violations"] }));
      expect(violations.length === 0, violations.map((v) => `${v.id} (${v.nodes.length}): ${v.nodes[0].html.slice(0, 120)} ${v.nodes[0].failureSummary}`).join("; "));
      const wide = await page.evaluate(() => [...document.querySelectorAll("#live *")].filter((e) => !e.closest("pre, svg") && e.getBoundingClientRect().right > innerWidth + 0.5).map((e) => e.outerHTML.slice(0, 80)));
      expect(wide.length === 0, `too wide: ${wide.slice(0, 3)}`);
      const live = await page.locator("#live [aria-live], #live output, #live [role=status]").evaluateAll((all) => all.filter((e) => e.ariaLive !== "off").length);
      expect(live === 0, `${live} live regions`);
      await close(page);
    });
  }
}

await check("by touch at 360 pixels", async () => {
  const page = await open("", { viewport: { width: 360, height: 700 }, hasTouch: true, isMobile: true });
  await page.locator('#live [name="axis"][value="2"]').tap();
  await is(page, "panel.book.angular_velocity[2] > 0", true);
  await page.locator('#live [data-do="play"]').tap();
  await page.waitForFunction(() => document.getElementById("live").panel.place > 1);
  const small = await page.locator("#live button, #live fieldset label").evaluateAll((all) => all.filter((e) => e.offsetParent && e.getBoundingClientRect().height < 24).length);
  expect(small === 0, `${small} targets below 24 pixels`);
  await close(page);
});
await browser.close();

await check("without WebGL2 the films are there, and nothing is said", async () => {
  const poor = await launch("--disable-3d-apis");
  const page = await poor.newPage();
  const complaints = [];
  page.on("console", (message) => complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  await page.goto(address);
  await page.waitForTimeout(500);
  expect(await page.locator("#live").isHidden(), "a panel that cannot draw");
  expect((await page.locator("[data-take]:visible").count()) === 0, "a button that does nothing");
  expect(complaints.length === 0, complaints.join("; "));
  await poor.close();
});

finish();
