// What a visitor of the course page does, done in headless Chromium: browser_test.mjs FOLDER VIDEOS
// FOLDER holds site/ and node_modules/, VIDEOS the scripts. Prints one line a check; exit code 1 when one fails.

import { createServer } from "node:http";
import { cpSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { extname, join } from "node:path";
import { pathToFileURL } from "node:url";
import { axe, check, close, expect, finish, launch, openPage } from "./browser.mjs";

const [folder, videos] = process.argv.slice(2);
const site = join(folder, "site");

// Serves the site as any web server does: with ranges, without which a browser cannot seek.
const types = { ".html": "text/html; charset=utf-8", ".mp4": "video/mp4", ".png": "image/png", ".json": "application/json", ".svg": "image/svg+xml",
  ".vtt": "text/vtt" };
const server = createServer((request, response) => {
  const file = join(site, decodeURIComponent(new URL(request.url, "http://x").pathname));
  const type = types[extname(file)];
  const size = type && statSync(file, { throwIfNoEntry: false })?.size;
  if (!size) return response.writeHead(404).end();
  const [, from, to] = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "") ?? [];
  const start = Number(from ?? 0);
  const end = to ? Math.min(Number(to), size - 1) : size - 1;
  const head = { "Content-Type": type, "Accept-Ranges": "bytes", "Content-Length": end - start + 1 };
  if (from) head["Content-Range"] = `bytes ${start}-${end}/${size}`;
  response.writeHead(from ? 206 : 200, head).end(readFileSync(file).subarray(start, end + 1));
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));

const browser = await launch("--disable-gpu");
const origins = {
  "file://": pathToFileURL(join(site, "index.html")).href,
  "a server": `http://127.0.0.1:${server.address().port}/index.html`,
};

const open = (address, options = {}) => openPage(browser, address, { viewport: { width: 1280, height: 900 }, ...options });

const names = (page) => page.$$eval(".film:has(video)", (films) => films.map((film) => film.id));

// Runs in the page: what the film and its cursor show.
const state = (id) => {
  const film = document.getElementById(id);
  const video = film.querySelector("video");
  const [seconds, span] = ["seconds", "span"].map((key) => Number(film.querySelector(".screen").dataset[key]));
  return {
    time: video.currentTime, duration: video.duration, seconds, width: video.videoWidth,
    cursor: (parseFloat(film.querySelector(".cursor").style.left) / 100) * seconds,
    told: (Number(film.querySelector(".seek").getAttribute("aria-valuenow")) * seconds) / span,
    paused: video.paused, rate: video.playbackRate, captions: video.textTracks[0].mode,
  };
};
async function until(page, id, what, holds) {
  let now;
  for (let i = 0; i < 100; ++i) {
    now = await page.evaluate(state, id);
    if (holds(now)) return now;
    await page.waitForTimeout(50);
  }
  throw new Error(`${id}: ${what}: ${JSON.stringify(now)}`);
}
const near = (a, b) => Math.abs(a - b) < 0.051;  // three frames of 60 a second

async function watch(page, id) {
  const seek = page.locator(`[id="${id}"] .seek`);
  await seek.scrollIntoViewIfNeeded();
  // A click in the chart, before the film has been loaded at all, goes there.
  const box = await seek.boundingBox();
  await page.mouse.click(box.x + 0.6 * box.width, box.y + 0.5 * box.height);
  const clicked = await until(page, id, "a click in the chart seeks the film",
    (s) => s.width > 0 && near(s.time, 0.6 * s.seconds) && near(s.cursor, s.time));
  expect(near(clicked.duration, clicked.seconds), `${id}: the chart shows ${clicked.seconds} s, the film has ${clicked.duration} s`);
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await until(page, id, "arrow keys seek the film", (s) => near(s.time, 0.2) && near(s.cursor, 0.2) && near(s.told, 0.2));
  await page.keyboard.press("Space");
  await until(page, id, "the film plays and its cursor follows", (s) => s.time > 0.35 && near(s.cursor, s.time));
  await page.evaluate((name) => {
    const video = document.getElementById(name).querySelector("video");
    video.pause();
    video.currentTime = 0.9;
  }, id);
  await until(page, id, "the cursor follows a seek in the film", (s) => near(s.time, 0.9) && near(s.cursor, 0.9));
}

async function captions(page, selector) {
  return page.$$eval(selector, (all) => Promise.all(all.map(async (video) => {
    const track = video.textTracks[0];
    track.mode = "showing";
    for (let i = 0; i < 60 && video.querySelector("track").readyState < 2; ++i) await new Promise((done) => setTimeout(done, 50));
    const told = video.closest(".film")?.querySelectorAll(".events [data-time]").length;
    return { state: video.querySelector("track").readyState, cues: track.cues?.length ?? 0, told };
  })));
}

for (const [origin, address] of Object.entries(origins)) {
  await check(`every film loads, plays, seeks, and its chart follows, from ${origin}`, async () => {
    const page = await open(address);
    const films = await names(page);
    expect(films.length >= 12, `only ${films.length} films`);
    for (const id of films) await watch(page, id);
    const tracks = await captions(page, ".film video");
    expect(tracks.every((t) => t.state === 2), "captions that do not load: " + JSON.stringify(tracks));
    // In a film cut short nothing may happen yet.
    expect(tracks.every((t) => t.cues === t.told), "captions that are not what happens: " + JSON.stringify(tracks));
    expect(tracks.filter((t) => t.cues > 0).length >= 12, "films without captions: " + JSON.stringify(tracks));
    await close(page);
  });
}

await check("the player steps, slows down, shows captions, fills the screen, and runs one film at a time", async () => {
  const page = await open(origins["file://"]);
  const [id, other] = await names(page);
  const film = page.locator(`[id="${id}"]`);
  const press = (name) => film.locator(`.player [data-do="${name}"]`).click();
  expect(await film.locator("video").evaluate((video) => !video.controls), "a second scrubber");
  await film.locator(".seek").press("Home");
  await until(page, id, "it begins", (s) => s.width > 0 && s.time === 0);
  await press("on");
  await until(page, id, "a frame on", (s) => near(s.time, 1.5 / 60) && s.paused);
  await film.locator(".seek").press(".");
  await until(page, id, "another by key", (s) => Math.abs(s.time - 2.5 / 60) < 0.002);
  await press("back");
  await until(page, id, "a frame back", (s) => Math.abs(s.time - 1.5 / 60) < 0.002);
  await press("speed");
  await press("captions");
  await until(page, id, "half the speed, with captions", (s) => s.rate === 0.5 && s.captions === "showing");
  await press("play");
  await until(page, id, "it plays", (s) => !s.paused);
  await page.locator(`[id="${other}"] .seek`).press("Space");
  await until(page, id, "it stops when another begins", (s) => s.paused);
  await press("full");
  await page.waitForFunction((name) => document.fullscreenElement?.closest(".film").id === name, id);
  const chart = await film.locator(".chart").boundingBox();
  const size = await page.evaluate(() => innerHeight);
  expect(chart.y > 0 && chart.y + chart.height <= size, `the chart stands at ${JSON.stringify(chart)} of ${size}`);
  await press("full");
  await page.waitForFunction(() => !document.fullscreenElement);
  // One tab stop for all of the buttons.
  expect((await film.locator(".player button:not([tabindex='-1'])").count()) === 1, "tab stops");
  await film.locator(".player [data-do=full]").focus();
  await page.keyboard.press("ArrowLeft");
  expect(await film.locator(".player [data-do=captions]").evaluate((b) => b === document.activeElement), "arrows");
  await close(page);
});

await check("a claim and an event show their moment, film in sight", async () => {
  const page = await open(origins["file://"], { viewport: { width: 1280, height: 800 } });
  await page.locator("#fig05_unstable_x summary").click();
  for (const link of ["#fig05_unstable_x .claims [data-time]", "#fig05_unstable_x .events [data-time]"]) {
    const there = page.locator(link).last();
    const time = Number(await there.getAttribute("data-time"));
    await there.click();
    await until(page, "fig05_unstable_x", link, (s) => near(s.time, time) && near(s.cursor, time));
    // In sight and at rest: a click on a page that still scrolls is not a reader's.
    await page.waitForFunction(() => {
      const box = document.querySelector("#fig05_unstable_x .screen").getBoundingClientRect();
      const rests = window.lastTop === box.top;
      window.lastTop = box.top;
      return rests && box.top >= -1 && box.bottom <= innerHeight + 1;
    }, null, { polling: 200 });
  }
  await close(page);
});

await check("the first screen shows a book that turns over, and it can be stopped", async () => {
  const page = await open(origins["a server"], { viewport: { width: 1280, height: 800 } });
  const hero = page.locator(".hero video");
  const box = await hero.boundingBox();
  expect(box.y >= 0 && box.y + box.height <= 800, JSON.stringify(box));
  await page.waitForFunction(() => !document.querySelector(".hero video").paused);
  await page.locator(".hold").click();
  await page.waitForFunction(() => document.querySelector(".hero video").paused);
  await close(page);
});

await check("posters come when they are near", async () => {
  const page = await open(origins["file://"]);
  const posters = page.locator(".stage > img");
  const loaded = () => posters.evaluateAll((all) => all.map((img) => img.naturalWidth));
  expect((await loaded()).at(-1) === 0, "the last one has been fetched at once");
  for (const img of await posters.all()) await img.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => [...document.querySelectorAll(".stage > img")].every((img) => img.naturalWidth === 192));
  // Seen through the film that has not begun.
  expect(await page.$$eval(".stage video", (all) => all.every((v) => getComputedStyle(v).backgroundColor === "rgba(0, 0, 0, 0)" &&
    v.getBoundingClientRect().top === v.previousElementSibling.getBoundingClientRect().top)), "hidden posters");
  await close(page);
});

// The snippets in an empty page: each film loads its picture, plays and has captions.
async function works(address, count) {
  const page = await open(address);
  const found = await page.$$eval("video", (all) => Promise.all(all.map(async (video) => {
    await video.play();
    for (let i = 0; i < 100 && video.currentTime < 0.1; ++i) await new Promise((done) => setTimeout(done, 50));
    video.pause();
    return { time: video.currentTime, width: video.videoWidth };
  })));
  expect(found.length === count, `${found.length} of ${count} films`);
  expect(found.every((f) => f.time >= 0.1 && f.width === 192), JSON.stringify(found));
  expect((await captions(page, "video")).every((t) => t.state === 2), "captions do not load");
  await close(page);
}
const empty = (body) => `<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>Mine</title><link rel="icon" href="data:,">${body}</html>`;

await check("a copied snippet works in an empty page in another folder", async () => {
  const elsewhere = join(site, "elsewhere");
  mkdirSync(elsewhere, { recursive: true });
  const page = await open(origins["a server"]);
  const more = page.locator("#fig05_unstable_x .more");
  await more.locator("summary").click();
  await more.locator("[data-copy$=snippet]").click();
  await page.getByText("Copied", { exact: true }).waitFor();
  const snippet = await page.evaluate(() => navigator.clipboard.readText());
  // Every snippet, and the one for a film that lies beside the page.
  const all = await page.$$eval(".film:has(video) .snippet", (pres) => pres.map((pre) => pre.textContent));
  await more.locator(".base").fill("");
  const beside = await page.locator("#fig05_unstable_x-snippet").textContent();
  await close(page);
  writeFileSync(join(elsewhere, "one.html"), empty(snippet));
  writeFileSync(join(elsewhere, "all.html"), empty(all.join("\n")));
  writeFileSync(join(elsewhere, "beside.html"), empty(beside));
  for (const end of ["mp4", "png", "vtt"]) cpSync(join(site, "fig05_unstable_x." + end), join(elsewhere, "fig05_unstable_x." + end));
  for (const [name, count] of [["one", 1], ["all", all.length], ["beside", 1]]) {
    await works(origins["a server"].replace("index.html", `elsewhere/${name}.html`), count);
  }
  rmSync(elsewhere, { recursive: true });
});

await check("a snippet from a page on a disk names no place on that disk", async () => {
  const page = await open(origins["file://"]);
  const snippets = await page.$$eval(".snippet", (pres) => pres.map((pre) => pre.textContent).join());
  expect(!snippets.includes("file:"), "file: addresses");
  await close(page);
});

await check("a copied script is the script", async () => {
  const page = await open(origins["a server"]);
  await page.locator("#fig12_pulsating_quaternion summary", { hasText: "script" }).click();
  await page.getByRole("button", { name: "Copy the script" }).locator("visible=true").click();
  await page.getByText("Copied", { exact: true }).waitFor();
  const text = await page.evaluate(() => navigator.clipboard.readText());
  expect(text === readFileSync(join(videos, "fig12_pulsating_quaternion.toml"), "utf8"), text.slice(0, 200));
  await close(page);
});

// Nothing sticks out, closed or open, and axe has nothing to say.
async function layout(address, width, look) {
  const page = await open(address, { viewport: { width, height: 900 }, ...look });
  const overflow = () => page.evaluate(() => {
    const wide = document.documentElement.scrollWidth - innerWidth;
    const scrolls = (e) => e && (/auto|scroll/.test(getComputedStyle(e).overflowX) || scrolls(e.parentElement.closest("main *")));
    const out = [...document.querySelectorAll("main *")].filter((e) => e.getBoundingClientRect().right > innerWidth + 1 && !scrolls(e));
    return wide > 0 || out.length > 0 ? `${wide} pixels too wide: ${out.slice(0, 3).map((e) => e.outerHTML.slice(0, 80))}` : "";
  });
  expect((await overflow()) === "", await overflow());
  await page.$$eval("details", (all) => all.forEach((d) => { d.open = true; }));
  expect((await overflow()) === "", "with all open: " + (await overflow()));
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run({ resultTypes: ["violations"] }));
  const text = violations.map((v) => `${v.id} (${v.nodes.length}): ${v.nodes[0].html.slice(0, 120)} ${v.nodes[0].failureSummary}`);
  expect(violations.length === 0, text.join("; "));
  await close(page);
}

const looks = { light: { colorScheme: "light" }, dark: { colorScheme: "dark" }, "forced colors": { forcedColors: "active" } };
for (const width of [360, 768, 1920]) {
  for (const [name, look] of Object.entries(looks)) {
    await check(`layout and accessibility at ${width} pixels, ${name}`, () => layout(origins["file://"], width, look));
    const report = origins["file://"].replace("index.html", "report/index.html");
    await check(`the report's too`, () => layout(report, width, look));
  }
}

// own/ holds two films of names that no address can hold as they are.
for (const [origin, address] of Object.entries(origins)) {
  await check(`a stranger's page works, whatever the films' names, from ${origin}`, async () => {
    const own = address.replace("index.html", "own/index.html");
    const page = await open(own);
    const films = await names(page);
    expect(films.length === 2, `${films.length} films`);
    for (const id of films) await watch(page, id);
    await page.locator("nav a").last().click();
    expect(await page.locator(".film").last().evaluate((film) => film.matches(":target")), "a link in the head finds its film");
    await close(page);
    for (const width of [360, 1280]) await layout(own, width, looks.light);
  });
}

await check("print shows posters, not films", async () => {
  const page = await open(origins["file://"]);
  await page.emulateMedia({ media: "print" });
  const bad = await page.$$eval(".film:has(video)", (films) => films.filter((film) =>
    film.querySelector("video").offsetParent !== null || film.querySelector(".stage img").offsetWidth === 0).length);
  expect(bad === 0, `${bad} films`);
  // A heading stays with what follows it, a film is on one page, and there are not too many pages.
  const loose = await page.$$eval("h2, h3, .film", (all) => all.filter((e) =>
    getComputedStyle(e)[e.matches(".film") ? "breakInside" : "breakAfter"] !== "avoid").length);
  expect(loose === 0, `${loose} that break`);
  const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
  const count = (what) => pdf.match(what)?.length ?? 0;
  expect(count(/\/Type \/Page\b/g) <= 16, `${count(/\/Type \/Page\b/g)} pages`);
  expect(count(/\/Subtype \/Image\b/g) >= 16, `${count(/\/Subtype \/Image\b/g)} posters`);
  await close(page);
});

await check("nothing moves by itself, and nothing loops for those who want less motion", async () => {
  const page = await open(origins["file://"], { reducedMotion: "reduce" });
  const moving = await page.$$eval("video", (all) => all.filter((v) => v.autoplay || !v.paused || v.loop || v.preload !== "none").length);
  expect(moving === 0, `${moving} films`);
  await close(page);
});

await check("text and charts are there without a script", async () => {
  const page = await open(origins["file://"], { javaScriptEnabled: false });
  const charts = await page.locator(".chart path").evaluateAll((all) => all.filter((p) => p.getBoundingClientRect().width > 100).length);
  expect(charts >= 12, `${charts} curves`);
  expect((await page.locator(".copy:visible, .seek:visible, .player:visible, .hold:visible").count()) === 0, "a button that does nothing is shown");
  await close(page);
});

await browser.close();
server.close();
finish();
