// The panel's picture is seen from where the panel looks: picture_test.mjs POLHODES.toml

import { execFileSync } from "node:child_process";
import { engine, program } from "./trajectory.mjs";

engine.begin(JSON.parse(execFileSync(program, ["json", process.argv[2]], { encoding: "utf8" })));
engine.advance(10);
const [translucent_lines, floats, vertices] = [4, 8, 6];  // a kind of item; of a vertex; of a line

// How opaque each line is that is not quite; of the polhodes those behind the book are paler.
function opacities(from) {
  for (const [kind, numbers] of engine.picture(9, from, 1, 1280, 720)) {
    if (kind !== translucent_lines) continue;
    return Array.from({ length: numbers.length / floats / vertices }, (_, i) => numbers[i * floats * vertices + floats - 1]);
  }
  return [];
}
const sides = [[0.35, 0.3, 1], [-0.35, -0.3, -1]].map(opacities);
const pale = sides.map((all) => all.filter((opacity) => opacity < 0.2).length / all.length);  // 30 of 255, not 120 or 150
console.log(`pale lines: ${pale.map((share) => share.toFixed(2)).join(" and ")} of ${sides.map((all) => all.length).join(" and ")}`);
// Half of them, whichever side one looks at; and not the same half.
const half = pale.every((share) => share > 0.3 && share < 0.7);
const same = String(sides[0]) === String(sides[1]);
process.exitCode = half && !same ? 0 : 1;
