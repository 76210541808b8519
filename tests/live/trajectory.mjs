// What `bookspin trajectory` prints, from the WebAssembly of the course page: trajectory.mjs SCENE.toml [--set KEY=VALUE ...]
// $BOOKSPIN is the program, which reads the script, $BOOKSPIN_LIVE the module; else those in build/.

import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const project = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
export const program = process.env.BOOKSPIN ?? join(project, "build", "bookspin");
const module = process.env.BOOKSPIN_LIVE ?? join(project, "build", "live", "live.wasm");
const Engine = new Function(readFileSync(join(project, "videos", "page", "engine.js"), "utf8") + "; return Engine;")();
export const engine = await Engine.open(readFileSync(module));

// printf's "%.17g": of two that are as near the even one, where toExponential takes the larger.
function g17(x) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x < 0 ? "-inf" : "inf";
  if (x === 0) return Object.is(x, -0) ? "-0" : "0";
  const even = /^(-?\d\.\d{15}[02468])50*(e.*)$/.exec(x.toExponential(100));
  const [, sign, first, rest, exponent] = /^(-?)(\d)\.(\d+)e([+-]\d+)$/.exec(even ? even[1] + even[2] : x.toExponential(16));
  const e = Number(exponent);
  const number = (whole, part) => sign + whole + (part.replace(/0+$/, "") && "." + part.replace(/0+$/, ""));
  if (e < -4 || e > 16) return `${number(first, rest)}e${e < 0 ? "-" : "+"}${String(Math.abs(e)).padStart(2, "0")}`;
  return e < 0 ? number("0", "0".repeat(-1 - e) + first + rest) : number(first + rest.slice(0, e), rest.slice(e));
}

const at = (name) => engine.place(name);
const before = ["kinetic_energy", "elastic_energy", "stretch", "angle_error"];
const after = engine.quantities.map((q) => q.name).filter((name) => !before.includes(name));
const corners = Array.from({ length: 8 }, (_, i) => ["x", "y", "z"].map((axis) => `c${i}${axis}`)).flat();
const places = [...corners.keys(), 27, 24, 25, 26, 32, 33, 34, ...before.map(at), 35, 36, 37, ...after.map(at)];
const header = ["frame,t,book", ...corners, "qw,qx,qy,qz,Lx,Ly,Lz", ...before, "omega_x,omega_y,omega_z", ...after].join(",") + "\n";

export function trajectory(args) {
  const scene = JSON.parse(execFileSync(program, ["json", ...args], { stdio: ["ignore", "pipe", "inherit"] }));
  engine.begin(scene);
  engine.advance(scene.frames);
  const tracks = scene.books.map((_, book) => engine.track(book));
  let text = header;
  for (let frame = 0; frame < scene.frames; ++frame) {
    for (const [book, track] of tracks.entries()) {
      const row = places.map((place) => g17(track[frame * engine.doubles + place]));
      text += `${frame},${g17(frame * scene.time_per_frame)},${book},${row.join(",")}\n`;
    }
  }
  return text;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  try {
    process.stdout.write(trajectory(process.argv.slice(2)));
  } catch (error) {
    if (error.status === undefined) throw error;
    process.exitCode = error.status;  // of the program, which has said why
  }
}
