// The motion in WebAssembly is that of the program, to the last digit: every method, integrator and toggle, and the scripts
// named. trajectory_test.mjs SCENE.toml ...

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { engine, program, trajectory } from "./trajectory.mjs";

let failed = 0;
function compare(args) {
  const native = execFileSync(program, ["trajectory", ...args], { encoding: "utf8", maxBuffer: 1 << 28 }).split("\n");
  const live = trajectory(args).split("\n");
  const line = native.findIndex((text, i) => text !== live[i]);
  if (line < 0 && native.length === live.length) return;
  ++failed;
  const names = native[0].split(",");
  const [a, b] = [native, live].map((all) => (all[line] ?? "").split(","));
  const column = names.findIndex((_, i) => a[i] !== b[i]);
  console.log(`FAILED  ${args.join(" ")}: line ${line + 1}, ${names[column]}: ${a[column]} by the program, ${b[column]} here`);
}

const folder = mkdtempSync(join(tmpdir(), "bookspin-live-"));
const script = join(folder, "one.toml");
writeFileSync(script, `title = "T"
seed = 3
[clip]
frames = 200
time_per_frame = 0.11
substeps = 4
[[book]]
jiggle = 1e-3
`);
const axes = ["[0.9, 0, 0]", "[0, 1.06, 0]", "[0, 0, 0.67]", "[0.3, 0.2, 0.5]"];
const shapes = ["normalize=true", "normalize=false", "normalize_every=3"];
let cases = 0;
for (const method of engine.methods) {
  for (const damping of method === "springs" ? [0, 1, 0.3] : [1]) {
    for (const integrator of engine.integrators) {
      const takes = engine.takes(method, damping > 0, integrator);
      if (!takes && !(method === "exact" && integrator === "explicit_euler")) continue;
      for (const axis of axes) {
        for (const shape of shapes) {
          const words = [`method=${method}`, `damping=${damping}`, ...(takes ? [`integrator=${integrator}`] : []), shape,
            `angular_velocity=${axis}`, ...(method === "springs" && axis === axes[0] ? ["stiffness=47", "particle_mass=1.3"] : [])];
          compare([script, ...words.flatMap((word) => ["--set", "book.0." + word])]);
          ++cases;
        }
      }
    }
  }
}
for (const more of [["moments=[30, 17, 45]", "method=exact"], ["orientation=[0.4, 0.3, 0.5, 0.1]", "method=matrix"], ["size=[2, 3, 0]", "method=quaternion"]]) {
  compare([script, "--set", "book.0.angular_velocity=[0.9, 0.1, 0]", ...more.flatMap((word) => ["--set", "book.0." + word])]);
  ++cases;
}
for (const scene of process.argv.slice(2)) compare([scene]);
rmSync(folder, { recursive: true });
console.log(`${cases} settings and ${process.argv.length - 2} scripts: ${failed === 0 ? "the same to the last digit" : failed + " differ"}`);
process.exitCode = failed === 0 && cases > 200 ? 0 : 1;
