// The course page in Firefox as Debian ships it: firefox_test.mjs FOLDER
// FOLDER holds site/ and node_modules/. Speaks WebDriver BiDi, W3C, to a Firefox of its own; prints one line a check; exit
// code 1 when one fails.

import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { liveKeys } from "./live_keys.mjs";

const [folder] = process.argv.slice(2);
const require = createRequire(join(folder, "node_modules", "x.js"));
const { ws: WebSocket } = require("playwright-core/lib/utilsBundle");

// Firefox has WebGL on a display only, be it one in memory.
const screen = spawn("Xvfb", ["-displayfd", "3", "-screen", "0", "1400x1000x24"], { stdio: ["ignore", "ignore", "ignore", "pipe"] });
const display = await new Promise((done) => {
  screen.on("error", () => done("")).on("exit", () => done(""));
  screen.stdio[3].on("data", (number) => done(":" + String(number).trim()));
});
const profile = mkdtempSync(join(tmpdir(), "firefox-"));
writeFileSync(join(profile, "user.js"), 'user_pref("webgl.force-enabled", true);\n');
const firefox = spawn("firefox-esr", [...(display ? [] : ["--headless"]), "--no-remote", "--profile", profile, "--remote-debugging-port=0"], {
  stdio: ["ignore", "ignore", "pipe"], env: { ...process.env, DISPLAY: display },
});
const gone = new Promise((done) => firefox.on("exit", done));
const address = await new Promise((done, fail) => {
  let said = "";
  firefox.stderr.on("data", (text) => {
    said += text;
    const found = /listening on (ws:\S+)/.exec(said);
    if (found) done(found[1]);
  });
  gone.then(() => fail(new Error("Firefox ended: " + said)));
});
const socket = new WebSocket(address + "/session");
await new Promise((done, fail) => socket.on("open", done).on("error", fail));
const answers = new Map();
const complaints = [];
socket.on("message", (text) => {
  const message = JSON.parse(text);
  if (message.id) answers.get(message.id)(message);
  else if (message.params.level === "error" || message.params.level === "warn") complaints.push(message.params.text);
});
let last = 0;
async function send(method, params) {
  const id = ++last;
  socket.send(JSON.stringify({ id, method, params }));
  const answer = await new Promise((done) => answers.set(id, done));
  if (answer.type === "error") throw new Error(`${method}: ${answer.message}`);
  return answer.result;
}

let failed = 0;
async function check(name, work) {
  try {
    await work();
    console.log(`ok      firefox: ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  firefox: ${name}\n        ${error.message}`);
  }
}

await send("session.new", { capabilities: {} });
await send("session.subscribe", { events: ["log.entryAdded"] });
const { context } = await send("browsingContext.create", { type: "tab" });
await send("browsingContext.setViewport", { context, viewport: { width: 1280, height: 900 } });
const open = (file) => send("browsingContext.navigate", { context, url: pathToFileURL(file).href, wait: "complete" });

// Runs in the page, and gives what the expression gives, as JSON.
async function run(expression) {
  const { result, exceptionDetails } = await send("script.evaluate", {
    expression: `Promise.resolve(${expression}).then((value) => JSON.stringify(value) ?? "null")`,
    target: { context }, awaitPromise: true,
  });
  if (exceptionDetails) throw new Error(exceptionDetails.text);
  return JSON.parse(result.value);
}
async function until(what, expression) {
  for (let i = 0; i < 100; ++i) {
    if (await run(expression)) return;
    await new Promise((done) => setTimeout(done, 50));
  }
  throw new Error(`never: ${what} (${expression})`);
}
async function press(...keys) {
  const actions = keys.flatMap((value) => [{ type: "keyDown", value }, { type: "keyUp", value }]);
  await send("input.performActions", { context, actions: [{ type: "key", id: "keys", actions }] });
}

async function watch(id) {
  const film = `document.getElementById(${JSON.stringify(id)})`;
  const near = (share) => `((film, x) => Math.abs(film.querySelector("video").currentTime - x) < 0.051 &&
    Math.abs(parseFloat(film.querySelector(".cursor").style.left) / 100 * film.querySelector(".screen").dataset.seconds - x) < 0.051)(${film}, ${share})`;
  const place = await run(`(() => { const seek = ${film}.querySelector(".seek"); seek.scrollIntoView({ block: "center", behavior: "instant" });
    const box = seek.getBoundingClientRect(); return { x: box.x + 0.6 * box.width, y: box.y + 0.5 * box.height }; })()`);
  await send("input.performActions", { context, actions: [{ type: "pointer", id: "mouse", actions: [
    { type: "pointerMove", x: Math.round(place.x), y: Math.round(place.y) }, { type: "pointerDown", button: 0 }, { type: "pointerUp", button: 0 }] }] });
  await until("a click in the chart seeks the film", `${film}.querySelector("video").videoWidth > 0 &&
    Math.abs(${film}.querySelector("video").currentTime / ${film}.querySelector(".screen").dataset.seconds - 0.6) < 0.05`);
  await press("\uE011", "\uE014", "\uE014");  // Home, arrow right twice
  await until("arrow keys seek the film", near(0.2));
  await press(" ");
  await until("the film plays", `${film}.querySelector("video").currentTime > 0.35`);
  await run(`((video) => { video.pause(); video.currentTime = 0.9; })(${film}.querySelector("video"))`);
  await until("the chart follows the film", near(0.9));
}

await check("films play, seek, and their charts follow", async () => {
  await open(join(folder, "site", "index.html"));
  const films = await run(`[...document.querySelectorAll(".film:has(video)")].map((film) => film.id)`);
  if (films.length < 12) throw new Error(`${films.length} films`);
  for (const id of [films[0], films[1], films.at(-1)]) await watch(id);
});
await check("captions are what happens", async () => {
  const films = await run(`(async () => {
    const films = [...document.querySelectorAll(".film video")].map((video) => ({
      track: video.textTracks[0], told: video.closest(".film").querySelectorAll(".events [data-time]").length }));
    for (const { track } of films) track.mode = "hidden";
    for (let i = 0; i < 60 && films.some(({ track, told }) => track.cues?.length !== told); ++i) await new Promise((done) => setTimeout(done, 50));
    return films.map(({ track, told }) => [track.cues?.length ?? 0, told]);
  })()`);
  // In a film cut short nothing may happen yet.
  if (films.filter(([cues]) => cues > 0).length < 12 || films.some(([cues, told]) => cues !== told)) throw new Error(films.join("; "));
});
await check("the live panel computes and explodes, where there is WebGL2", async () => {
  if (!(await run(`!!document.getElementById("live-data")`))) return;
  if (!(await run(`!!document.createElement("canvas").getContext("webgl2")`))) {
    console.log("        without WebGL2");
    if (!(await run(`document.getElementById("live").hidden`))) throw new Error("a panel that cannot draw");
    return;
  }
  const panel = (look) => `((panel) => (${look}))(document.getElementById("live").panel)`;
  await until("the panel is there", `!!document.getElementById("live").panel`);
  await run(`document.querySelector("#live .live-grid").scrollIntoView({ behavior: "instant" })`);
  await run(panel("panel.painter.canvas.focus({ preventScroll: true })"));
  await run(panel("(panel.playing = false, panel.place = 0)"));
  await until("the motion is whole", panel("panel.complete"));
  for (const [key, look, wanted] of liveKeys) {
    await press({ ArrowRight: "\uE014" }[key] ?? key);
    await until(`${key} is heard`, `JSON.stringify(${panel(look)}) === ${JSON.stringify(JSON.stringify(wanted))}`);
  }
  for (const name of ["kick", "stiffness", "mass", "damping", "time", "steps", "every"]) {
    await run(`document.querySelector('#live [name="${name}"]').focus()`);
    await press("\uE014");
    await until(`${name} changes the address`, `location.hash.includes("${name}=")`);
  }
  await run(`document.querySelector("#live .live-try a").click()`);
  await until("a link is followed", panel("panel.book.angular_velocity[2] > 0 && panel.book.stiffness === 10"));
  await run(panel('panel.set("every", 0), panel.set("stiffness", 100)'));
  await until("it explodes", panel("panel.complete && panel.engine.exploded(0) > 0"));
});
await check("nothing sticks out", async () => {
  for (const width of [360, 768, 1920]) {
    await send("browsingContext.setViewport", { context, viewport: { width, height: 900 } });
    const wide = await run("document.documentElement.scrollWidth - innerWidth");
    if (wide > 0) throw new Error(`${wide} pixels too wide at ${width}`);
  }
});
await check("no complaint in the console", async () => {
  // Laid out while it still comes in, a formula may lack a part. When all has come none does.
  const lacking = await run(`[...document.querySelectorAll("msub, msup, mfrac, mover")].filter((e) => e.childElementCount !== 2).length`);
  if (lacking > 0) throw new Error(`${lacking} formulas lack a part`);
  const others = complaints.filter((text) => !text.includes("Incorrect number of children for <m"));
  if (others.length > 0) throw new Error(others.join("; "));
});

await send("browser.close", {}).catch(() => {});
const late = setTimeout(() => firefox.kill(), 10000);
await gone;
clearTimeout(late);
screen.kill();
rmSync(profile, { recursive: true, force: true });
process.exitCode = failed === 0 ? 0 : 1;
