// What the page's tests in a browser have in common. node_modules/ lies in the folder that is their first argument.

import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { join } from "node:path";

const require = createRequire(join(process.argv[2], "node_modules", "x.js"));
const { chromium } = require("playwright-core");
export const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

export const launch = (...more) => chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", ...more],
});

let failed = 0;
export async function check(name, work) {
  const start = Date.now();
  try {
    await work();
    console.log(`ok      ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n        ${String(error.stack ?? error).split("\n").slice(0, 4).join("\n        ")}`);
  }
}
export function expect(condition, message) {
  if (!condition) throw new Error(message);
}
export function finish() {
  console.log(failed === 0 ? "all well" : `${failed} failed`);
  process.exitCode = failed === 0 ? 0 : 1;
}

// A page whose every complaint, and every request that leaves its site, is an error.
export async function openPage(browser, address, options) {
  const context = await browser.newContext(options);
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const page = await context.newPage();
  page.complaints = [];
  page.on("console", (message) => {
    // Without a GPU the browser itself reads each picture of the live panel back, and says so.
    if (message.type() === "log" || /GPU stall due to ReadPixels/.test(message.text())) return;
    page.complaints.push(`console ${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => page.complaints.push(`uncaught: ${error.message}`));
  page.on("request", (request) => {
    const home = new URL(address);
    const there = new URL(request.url());
    if (there.protocol !== "data:" && there.protocol + there.host !== home.protocol + home.host) {
      page.complaints.push(`request to ${there.href}`);
    }
  });
  await page.goto(address);
  return page;
}
export async function close(page) {
  await page.context().close();
  expect(page.complaints.length === 0, page.complaints.join("; "));
}
