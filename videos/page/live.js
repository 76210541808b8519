// The live panel: a scene is computed whole by the program's own code, a few milliseconds at a time, and played as a film is.
// What changes a motion changes it from its start on: the script that is copied films what is on the screen.
"use strict";

const liveData = JSON.parse(document.getElementById("live-data").textContent);
const copyOf = (value) => JSON.parse(JSON.stringify(value));
const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

const homeScene = {
  title: "The book in your hands", seed: 5, frames: 1200, fps: 60, time_per_frame: 0.5, substeps: 30, from: [0.35, 0.3, 1],
  books: [{ name: "", method: "springs", integrator: "explicit_euler", size: [1.878, 2.9085, 0.5], moments: [0, 0, 0], orientation: null,
    angular_velocity: [0.11482, 0, 0], jiggle: 0.01, normalize_every: 1, damping: 1, stiffness: 10, particle_mass: 1, position: [0, 0, 0],
    ghost: false, show: ["trace"] }],
};
const mostBookFrames = 8000;  // of memory, and of what is computed anew while a slider moves

// A scene as a script, every number to its last digit.
function scriptOf(scene, from) {
  const list = (numbers) => `[${numbers.join(", ")}]`;
  const text = (words) => JSON.stringify(words).replace(/\u007f/g, "\\u007f");
  const lines = [`title = ${text(scene.title)}`, `seed = ${scene.seed}`, "", "[clip]", `frames = ${scene.frames}`, `fps = ${scene.fps}`,
    `time_per_frame = ${scene.time_per_frame}`, `substeps = ${scene.substeps}`, "", "[view]", `from = ${list(from)}`,
    'head_up = ["tilt", "flips", "energy_ratio"]'];
  for (const book of scene.books) {
    lines.push("", "[[book]]");
    if (book.name) lines.push(`name = ${text(book.name)}`);
    lines.push(`method = "${book.method}"`);
    if (book.method !== "exact") lines.push(`integrator = "${book.integrator}"`);
    lines.push(book.moments.some((x) => x !== 0) ? `moments = ${list(book.moments)}` : `size = ${list(book.size)}`);
    if (book.orientation) lines.push(`orientation = ${list(book.orientation)}`);
    lines.push(`angular_velocity = ${list(book.angular_velocity)}`, `jiggle = ${book.jiggle}`);
    lines.push(book.normalize_every === 0 ? "normalize = false" : `normalize_every = ${book.normalize_every}`);
    lines.push(`damping = ${book.damping}`, `stiffness = ${book.stiffness}`, `particle_mass = ${book.particle_mass}`);
    if (book.position.some((x) => x !== 0)) lines.push(`position = ${list(book.position)}`);
    if (book.ghost) lines.push('style = "ghost"');
    lines.push(`show = [${book.show.map((word) => `"${word}"`).join(", ")}]`);
  }
  return lines.join("\n") + "\n";
}

// What a slider can be set to.
function geometric(low, high, steps) {
  const values = [];
  for (let i = 0; i <= steps; ++i) {
    const value = Number((low * (high / low) ** (i / steps)).toPrecision(2));
    if (value !== values.at(-1)) values.push(value);
  }
  return values;
}
const whole = (low, high, steps) => [...new Set(geometric(low, high, steps).map(Math.round))];
const sliders = {
  kick: { key: "jiggle", values: [0, ...geometric(1e-6, 0.1, 50)], say: (v) => (v === 0 ? "none" : v < 1e-3 ? v.toExponential(0) : `${Number((100 * v).toPrecision(2))} %`) },
  stiffness: { key: "stiffness", values: geometric(0.1, 10000, 100), say: (v) => `k = ${v}` },
  mass: { key: "particle_mass", values: geometric(0.01, 100, 80), say: (v) => `m = ${v}` },
  damping: { key: "damping", values: Array.from({ length: 31 }, (_, i) => i / 10), say: (v) => (v === 0 ? "none" : `${v} crit.`) },
  time: { key: "time_per_frame", clip: true, values: geometric(0.005, 2, 80), say: (v) => `Δt = ${v}` },
  steps: { key: "substeps", clip: true, values: whole(1, 100, 60), say: (v) => `${v}` },
  every: { key: "normalize_every", values: [0, 1, 2, 3, 4, 5, 7, 10, 20, 30, 50, 100, 200, 500, 1000], say: (v) => (v === 0 ? "never" : v === 1 ? "step" : `${v} steps`) },
};
const shows = { ghost: "exact", trace: "trace", springs: "springs" };
const rates = [1, 2, 4, 0.25, 0.5];

class Panel {
  constructor(root, engine, painter) {
    Object.assign(this, { root, engine, painter });
    this.form = root.querySelector("form");
    this.controls = this.form.elements;
    this.figures = root.querySelector(".live-figures");
    this.chart = root.querySelector(".live-chart canvas");
    this.seekBar = root.querySelector(".seek");
    this.cursor = this.seekBar.appendChild(Object.assign(document.createElement("div"), { className: "cursor" }));
    this.told = root.querySelector(".live-told");
    this.buttons = Object.fromEntries([...root.querySelectorAll("[data-do]")].map((button) => [button.dataset.do, button]));
    this.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.inSight = this.placeInSight = this.afloat = false;
    this.offered = null;  // the number in the text that was dragged last
    this.rate = 1;
    this.withFigures = true;
    this.begin("", copyOf(homeScene));
    for (const [id, film] of Object.entries(liveData.films)) this.controls.film.append(new Option(film.title, id));
    for (const [name, slider] of Object.entries(sliders)) Object.assign(this.controls[name], { min: 0, max: slider.values.length - 1, step: 1 });
    this.listen();
    this.readAddress();
  }

  get book() { return this.scene.books[this.current]; }

  // Another scene than the one before: a film's, or the panel's own.
  begin(film, scene, frame = 0) {
    this.offered = null;
    this.film = film;
    this.base = copyOf(scene);
    this.scene = scene;
    this.current = 0;
    this.turn(scene.from);
    this.place = frame;
    this.renew();
  }

  // The motion from its start, of the scene as it is.
  renew() {
    const scene = { ...this.scene, frames: Math.min(this.scene.frames, Math.floor(mostBookFrames / this.scene.books.length)) };
    this.engine.begin(scene);
    this.length = scene.frames;
    this.end = scene.frames;
    this.complete = false;
    this.show();
  }

  // A few milliseconds of the motion; whatever else there is to do waits no longer.
  compute() {
    const start = performance.now();
    const extent = this.engine.place("extent");
    const missing = this.engine.frames <= this.place;
    while (!this.complete && performance.now() - start < (this.playing ? 9 : 25)) {
      this.engine.advance(Math.max(1, Math.min(8, Math.floor(2000 / this.scene.substeps))));
      const tracks = this.scene.books.map((_, b) => this.engine.track(b));
      const last = (this.engine.frames - 1) * this.engine.doubles + extent;
      // When all have exploded and gone a film ends a second later, and so does this.
      if (this.end === this.length && tracks.every((track) => !(track[last] < 8))) this.end = Math.min(this.length, this.engine.frames + this.scene.fps);
      this.complete = this.engine.frames >= this.end;
    }
    if (missing || this.complete) this.drawn = false;
    this.charted = false;
    if (this.complete) this.tell();
  }

  // What controls show of the scene.
  show() {
    const { controls, book, scene } = this;
    controls.film.value = this.film;
    const many = scene.books.length > 1;
    this.root.querySelector(".live-book").hidden = !many;
    controls.book.replaceChildren(...scene.books.map((one, b) => new Option(one.name || `${b + 1}: ${one.method}`, b)));
    controls.book.value = this.current;
    const axis = book.angular_velocity.filter((x) => x !== 0).length === 1 ? book.angular_velocity.findIndex((x) => x !== 0) : -1;
    for (const radio of controls.axis) radio.checked = Number(radio.value) === axis;
    for (const radio of controls.method) radio.checked = radio.value === book.method;
    const taken = this.engine.integrators.filter((name) => this.engine.takes(book.method, book.damping > 0, name));
    controls.integrator.replaceChildren(...taken.map((name) => new Option(name.replaceAll("_", " "), name)));
    controls.integrator.value = book.integrator;
    this.root.querySelector(".live-integrator").hidden = taken.length < 2;
    for (const part of this.root.querySelectorAll(".of-springs")) part.hidden = book.method !== "springs";
    for (const part of this.root.querySelectorAll(".of-steps")) part.hidden = book.method === "exact";
    for (const [name, slider] of Object.entries(sliders)) {
      const value = (slider.clip ? scene : book)[slider.key];
      const nearest = slider.values.reduce((best, one, i) => (Math.abs(one - value) < Math.abs(slider.values[best] - value) ? i : best), 0);
      controls[name].value = nearest;
      const text = slider.say(value);
      controls[name].setAttribute("aria-valuetext", text);
      controls[name].closest("p").querySelector("output").textContent = text;
    }
    for (const [name, overlay] of Object.entries(shows)) controls[name].checked = book.show.includes(overlay);
    this.buttons.play.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    this.buttons.play.querySelector("use").setAttribute("href", this.playing ? "#i-pause" : "#i-play");
    this.drawn = false;
    this.wake();
  }

  // A change by hand: the motion anew, and the address with it.
  change(alter) {
    alter(this.scene, this.book);
    for (const book of this.scene.books) {
      if (book.method === "exact" || this.engine.takes(book.method, book.damping > 0, book.integrator)) continue;
      book.integrator = this.engine.integrators.find((name) => this.engine.takes(book.method, book.damping > 0, name));
    }
    this.renew();
    this.writeAddress();
  }

  set(name, value) {
    if (name === "axis") {
      this.change((_, book) => {
        const speed = Math.hypot(...book.angular_velocity);
        book.angular_velocity = [0, 1, 2].map((axis) => (axis === value ? speed : 0));
        this.place = 0;
      });
    } else if (name === "method") this.change((_, book) => { book.method = value; });
    else if (name === "integrator") this.change((_, book) => { book.integrator = value; });
    else if (name in shows) {
      this.change((_, book) => {
        const overlays = new Set(book.show);
        if (value) overlays.add(shows[name]); else overlays.delete(shows[name]);
        book.show = this.engine.overlays.filter((overlay) => overlays.has(overlay));
      });
    } else {
      const slider = sliders[name];
      this.change((scene, book) => { (slider.clip ? scene : book)[slider.key] = value; });
    }
  }

  // One place further up or down what a slider holds.
  nudge(name, by) {
    const { values, key, clip } = sliders[name];
    const now = (clip ? this.scene : this.book)[key];
    const next = by > 0 ? values.find((value) => value > now) : values.findLast((value) => value < now);
    if (next !== undefined) this.set(name, next);
  }

  turn(from) {
    const length = Math.hypot(...from);
    this.yaw = Math.atan2(from[0], from[2]);
    this.pitch = Math.asin(from[1] / length);
    this.from = [...from];
    this.drawn = false;
    this.wake?.();
  }
  turnBy(right, up) {
    this.yaw += right;
    this.pitch = Math.min(1.5, Math.max(-1.5, this.pitch + up));
    const across = Math.cos(this.pitch);
    this.turn([Math.sin(this.yaw) * across, Math.sin(this.pitch), Math.cos(this.yaw) * across].map((x) => Number(x.toFixed(4))));
    this.writeAddress();
  }

  go(frame) {
    this.place = Math.min(Math.max(frame, 0), this.end - 1);
    this.drawn = false;
    this.wake();
  }
  step(frames) {
    this.playing = false;
    this.go(Math.floor(this.place) + frames);
    this.show();
  }
  act(what) {
    if (what === "play") {
      this.playing = !this.playing;
      if (this.playing && this.place >= this.end - 1) this.place = 0;
      for (const video of document.querySelectorAll("video")) if (this.playing) video.pause();
      this.show();
    } else if (what === "restart") this.go(0);
    else if (what === "back") this.step(-1);
    else if (what === "on") this.step(1);
    else if (what === "speed") {
      this.rate = rates[(rates.indexOf(this.rate) + 1) % rates.length];
      this.buttons.speed.textContent = { 0.25: "¼×", 0.5: "½×" }[this.rate] ?? this.rate + "×";
      this.buttons.speed.setAttribute("aria-label", "Speed: " + this.buttons.speed.textContent);
    } else if (what === "view") {
      this.turn(this.base.from);
      this.writeAddress();
    }
  }

  // Frame by frame as long as there is something to do and somebody sees it.
  wake() {
    if (this.asked || !this.inSight) return;
    this.asked = requestAnimationFrame((now) => {
      this.asked = 0;
      const passed = Math.min((now - (this.before ?? now)) / 1000, 0.1);
      this.before = now;
      if (!this.complete) this.compute();
      if (this.playing) {
        const there = Math.min(this.engine.frames, this.end) - 1;
        if (this.place < this.end - 1) {
          this.place = Math.min(this.place + passed * this.scene.fps * this.rate, there);
          this.rested = 0;
          this.drawn = false;
        } else if ((this.rested = (this.rested ?? 0) + passed) > 1) {
          this.place = 0;
        }
      }
      if (!this.drawn) this.draw();
      if (!this.charted && (this.complete || !(now - this.chartedAt < 120))) this.drawCurves(now);
      if (this.playing || !this.complete) this.wake(); else this.before = undefined;
    });
  }

  get frame() { return Math.max(0, Math.min(Math.floor(this.place), this.engine.frames - 1)); }
  explosions() {
    return this.scene.books.map((book, b) => ({ book, frame: this.engine.exploded(b) })).filter(({ frame }) => frame >= 0);
  }
  timeOf(frame) { return Number((frame * this.scene.time_per_frame).toPrecision(4)); }

  draw() {
    const { canvas } = this.painter;
    const scale = Math.min(devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((length) => Math.max(1, Math.round(length * scale)));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const { frame } = this;
    this.painter.draw(frame, this.from, 1);
    this.cursor.style.left = `${(100 * frame) / Math.max(1, this.end - 1)}%`;
    this.root.querySelector(".clock").textContent = `t = ${this.timeOf(frame)}`;
    this.drawFigures(frame);
    this.drawn = true;
    if (this.playing) return;  // who listens is told where it stands, not every frame
    this.seekBar.setAttribute("aria-valuemax", this.end - 1);
    this.seekBar.setAttribute("aria-valuenow", frame);
    this.seekBar.setAttribute("aria-valuetext", this.figures.textContent.replaceAll("\n", ", ") || `t = ${this.timeOf(frame)}`);
  }

  value(b, name, frame) {
    return this.engine.track(b)[frame * this.engine.doubles + this.engine.place(name)];
  }
  drawFigures(frame) {
    const lines = [];
    const shown = (x, digits, unit = "") => (!Number.isFinite(x) ? "–" : (Math.abs(x) >= 1e5 ? x.toExponential(1) : x.toFixed(digits)) + unit);
    if (this.withFigures) {
      lines.push(`t ${this.timeOf(frame).toFixed(1)}`);
      if (this.scene.books.length === 1) {
        lines.push(`tilt ${shown(this.value(0, "tilt", frame), 1, "°")}`, `flips ${shown(this.value(0, "flips", frame), 0)}`,
          `E/E₀ ${shown(this.value(0, "energy_ratio", frame), 3)}`, `|L|/L₀ ${shown(this.value(0, "angular_momentum_ratio", frame), 3)}`,
          `error ${shown(this.value(0, "angle_error", frame), 3, " rad")}`);
      } else {
        this.scene.books.forEach((book, b) => lines.push(`${book.name || book.method}: tilt ${shown(this.value(b, "tilt", frame), 1, "°")}`));
      }
    }
    this.figures.textContent = lines.join("\n");
    for (const { book, frame: when } of this.explosions()) {
      if (frame < when) continue;
      const said = document.createElement("b");
      said.textContent = `${this.figures.textContent ? "\n" : ""}${book.name ? book.name + " " : ""}exploded at t = ${this.timeOf(when)}`;
      this.figures.append(said);
    }
  }

  drawCurves(now) {
    this.chartedAt = now;
    const { engine, scene } = this;
    const marks = this.explosions().map(({ book, frame }) => ({ frame, label: `${scene.books.length > 1 ? (book.name || book.method) + " " : ""}explodes at t = ${this.timeOf(frame)}` }));
    const count = Math.min(engine.frames, this.end);
    const panelOf = (...names) => {
      const curves = [];
      let [low, high, unit, most] = [Infinity, -Infinity, "", 0];
      for (const name of names) {
        const q = engine.quantities.find((one) => one.name === name);
        [low, high, unit, most] = [Math.min(low, q.low), Math.max(high, q.high), q.unit, q.most];
        const place = engine.place(name);
        const said = this.chart.clientWidth < 440 ? q.symbol : q.title;
        scene.books.forEach((book, b) => {
          if (name === "angle_error" && book.method === "exact") return;
          const exploded = engine.exploded(b);
          const values = [];
          const track = engine.track(b);
          for (let n = 0; n < count && (exploded < 0 || n < exploded); ++n) values.push(track[n * engine.doubles + place] * q.scale);
          curves.push({ label: scene.books.length === 1 ? said : (b === 0 ? said + ": " : "") + (book.name || book.method), values });
        });
      }
      return { curves, low, high, unit, most, marks };
    };
    const one = scene.books.length === 1;
    const panels = [one ? panelOf("tilt", ...(this.book.show.includes("exact") ? ["exact_tilt"] : [])) : panelOf("tilt"),
      one ? panelOf("energy_ratio", "angular_momentum_ratio") : panelOf("energy_ratio"), panelOf("angle_error")].filter((panel) => panel.curves.length > 0);
    const parts = this.chart.clientWidth < 300 ? 2 : 4;
    const times = Array.from({ length: parts + 1 }, (_, n) => this.timeOf(Math.round(((this.end - 1) * n) / parts)));
    drawChart(this.chart, panels, 1 / Math.max(1, this.end - 1), times);
    this.charted = true;
  }

  // What happened, in words: of the whole motion, once it is known.
  tell() {
    const last = this.end - 1;
    const times = (n) => (n === 0 ? "does not turn over" : n === 1 ? "turns over once" : `turns over ${n} times`);
    const sentences = this.scene.books.map((book, b) => {
      const exploded = this.engine.exploded(b);
      const name = this.scene.books.length > 1 ? (book.name || book.method) + ": " : "";
      if (exploded >= 0) return `${name}the book explodes at t = ${this.timeOf(exploded)}.`;
      let first = 0;
      while (first < last && !(this.value(b, "flips", first) > 0)) ++first;
      const flips = this.value(b, "flips", last);
      const when = flips > 0 ? `, the first time by t = ${this.timeOf(first)}` : "";
      const exact = book.method === "exact" ? "" : `; the exact book ${times(this.value(b, "exact_flips", last))}`;
      return `${name}in ${this.timeOf(last)} units of time the book ${times(flips)}${when}${exact}. Energy ${this.value(b, "energy_ratio", last).toPrecision(3)} of what it was.`;
    });
    this.told.textContent = sentences.map((text) => text[0].toUpperCase() + text.slice(1)).join(" ");
  }

  // The address says what differs from the scene as it began, and what it was.
  writeAddress() {
    const words = new URLSearchParams();
    if (this.film) words.set("film", this.film);
    for (const [name, slider] of Object.entries(sliders)) if (slider.clip && this.scene[slider.key] !== this.base[slider.key]) words.set(name, this.scene[slider.key]);
    this.scene.books.forEach((book, b) => {
      const was = this.base.books[b];
      const put = (name, value) => words.set(b === 0 ? name : `${name}${b}`, value);
      const spin = book.angular_velocity;
      if (String(spin) !== String(was.angular_velocity)) put("axis", "xyz"[spin.findIndex((x) => x !== 0)]);
      for (const key of ["method", "integrator"]) if (book[key] !== was[key]) put(key, book[key]);
      for (const [name, slider] of Object.entries(sliders)) if (!slider.clip && book[slider.key] !== was[slider.key]) put(name, book[slider.key]);
      if (String(book.show) !== String(was.show)) put("show", book.show.join("."));
    });
    if (String(this.from) !== String(this.base.from)) words.set("from", this.from.join("_"));
    const text = String(words);
    history.replaceState(null, "", text ? "#live?" + text : "#live");
  }

  readAddress() {
    if (!/^#live(\?|$)/.test(location.hash)) return false;
    const written = location.hash;
    this.read(new URLSearchParams(written.slice("#live?".length)));
    if (written.length <= "#live?".length) history.replaceState(null, "", "#live");
    this.root.scrollIntoView({ block: "start" });
    return true;
  }

  // Whatever an address says: a word or number that a control could not give is passed over.
  read(words) {
    const film = Object.hasOwn(liveData.films, words.get("film") ?? "") ? words.get("film") : "";
    this.begin(film, copyOf(film ? liveData.films[film].scene : homeScene));
    const number = (name, { values }, whole) => {
      const text = words.get(name);
      const value = text === null || text.trim() === "" ? NaN : Number(text);
      return value >= values[0] && value <= values.at(-1) && (!whole || Number.isInteger(value)) ? value : undefined;
    };
    const put = (target, key, value) => { if (value !== undefined) target[key] = value; };
    for (const [name, slider] of Object.entries(sliders)) {
      if (slider.clip) put(this.scene, slider.key, number(name, slider, name === "steps"));
    }
    this.scene.books.forEach((book, b) => {
      const named = (name) => (b === 0 ? name : `${name}${b}`);
      const axis = ["x", "y", "z"].indexOf(words.get(named("axis")));
      const speed = Math.hypot(...book.angular_velocity);
      if (axis >= 0) book.angular_velocity = [0, 1, 2].map((d) => (d === axis ? speed : 0));
      const method = words.get(named("method"));
      if (this.engine.methods.includes(method)) book.method = method;
      for (const [name, slider] of Object.entries(sliders)) {
        if (!slider.clip) put(book, slider.key, number(named(name), slider, name === "every"));
      }
      const integrator = words.get(named("integrator"));
      if (this.engine.integrators.includes(integrator)) book.integrator = integrator;
      const show = words.get(named("show"))?.split(".").filter(Boolean);
      if (show?.every((word) => this.engine.overlays.includes(word))) book.show = this.engine.overlays.filter((overlay) => show.includes(overlay));
    });
    this.current = 0;
    const from = words.get("from")?.split("_").map(Number);
    if (from?.length === 3 && from.every((x) => Math.abs(x) <= 1e3) && (from[0] !== 0 || from[2] !== 0)) this.turn(from);
    this.change(() => {});
  }

  // A number in the text, dragged or moved by arrow keys: its scene comes into the panel, and the screen beside it.
  offer(number) {
    const { drag: name, scene } = number.dataset;
    const { values, key, clip, say } = sliders[name];
    const written = new URLSearchParams(scene).get(name);
    let place = values.indexOf(written === null ? homeScene.books[0][key] : Number(written));
    const show = () => {
      const text = name === "steps" ? `h = ${Number((homeScene.time_per_frame / values[place]).toPrecision(3))}` : say(values[place]);
      number.textContent = text;
      const attributes = { valuemin: 0, valuemax: values.length - 1, valuenow: place, valuetext: text };
      for (const [attribute, value] of Object.entries(attributes)) number.setAttribute("aria-" + attribute, value);
    };
    const move = (to) => {
      const next = Math.min(Math.max(to, 0), values.length - 1);
      if (this.offered !== number) {
        if (!calm) this.playing = true;
        this.read(new URLSearchParams(scene));
        this.offered = number;
      }
      this.float(true, number.getBoundingClientRect().top > innerHeight / 2);
      place = next;
      show();
      this.place = 0;
      if ((clip ? this.scene : this.book)[key] !== values[place]) this.set(name, values[place]);
    };
    number.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (by === undefined) return;
      event.preventDefault();
      move(place + by * (name === "steps" ? -1 : 1));  // of a step, not of how many there are
    });
    let from;
    number.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      number.setPointerCapture(event.pointerId);
      number.focus({ preventScroll: true });
      from = { x: event.clientX, place };
      move(place);
    });
    number.addEventListener("pointermove", (event) => {
      if (!number.hasPointerCapture(event.pointerId)) return;
      const to = from.place + Math.round((event.clientX - from.x) / 8) * (name === "steps" ? -1 : 1);
      if (to !== place) move(to);
    });
    number.addEventListener("blur", () => this.float(false));
    show();
  }

  // The screen over the page, at its lower or upper edge, as long as its own place is out of sight.
  float(on, above = false) {
    const [screen, grid] = [".screen", ".live-grid"].map((one) => this.root.querySelector(one));
    if (on === this.afloat || (on && this.placeInSight)) return;
    grid.style.minHeight = on ? `${grid.offsetHeight}px` : "";
    screen.classList.toggle("afloat", on);
    screen.classList.toggle("above", above);
    this.afloat = on;
    this.inSight = on || this.placeInSight;
    this.drawn = this.charted = false;
    this.wake();
  }

  // A film's scene, from where the film stands.
  take(id) {
    const video = document.getElementById(id)?.querySelector("video");
    const { scene, first } = liveData.films[id];
    video?.pause();
    this.begin(id, copyOf(scene), first + Math.floor((video?.currentTime ?? 0) * scene.fps));
    this.writeAddress();
    this.root.scrollIntoView({ block: "start", behavior: calm ? "auto" : "smooth" });
    this.painter.canvas.focus({ preventScroll: true });
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.target;
    const { key } = event;
    if (target === this.painter.canvas && key.startsWith("Arrow")) {
      this.turnBy({ ArrowLeft: -0.1, ArrowRight: 0.1 }[key] ?? 0, { ArrowUp: 0.1, ArrowDown: -0.1 }[key] ?? 0);
      event.preventDefault();
      return;
    }
    if (target === this.seekBar) {
      const to = { ArrowLeft: -6, ArrowDown: -6, ArrowRight: 6, ArrowUp: 6, PageDown: -60, PageUp: 60, Home: -Infinity, End: Infinity }[key];
      if (to !== undefined) {
        this.go(this.place + to);
        event.preventDefault();
        return;
      }
    }
    if (target.matches("select, summary, pre") || (key === " " && target.matches("button, input, a"))) return;
    const { book } = this;
    const keys = {
      1: () => this.set("axis", 0), 2: () => this.set("axis", 1), 3: () => this.set("axis", 2),
      7: () => this.set("method", "springs"), 8: () => this.set("method", "matrix"), 9: () => this.set("method", "quaternion"), 0: () => this.set("method", "exact"),
      n: () => this.set("every", book.normalize_every === 0 ? 1 : 0), d: () => this.set("damping", book.damping === 0 ? 1 : 0),
      "+": () => this.nudge("time", 1), "-": () => this.nudge("time", -1), "*": () => this.nudge("steps", 1), "/": () => this.nudge("steps", -1),
      e: () => { this.withFigures = !this.withFigures; this.go(this.place); }, g: () => this.set("ghost", !book.show.includes("exact")),
      " ": () => this.act("play"), ",": () => this.act("back"), ".": () => this.act("on"), r: () => this.act("restart"), s: () => this.act("speed"), v: () => this.act("view"),
    };
    const act = keys[key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  }

  listen() {
    const { root, form, controls, painter, seekBar } = this;
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("input", ({ target }) => {
      if (target.name in sliders) this.set(target.name, sliders[target.name].values[target.value]);
      else if (target.name === "axis") this.set("axis", Number(target.value));
      else if (target.name === "method" || target.name === "integrator") this.set(target.name, target.value);
      else if (target.name in shows) this.set(target.name, target.checked);
      else if (target.name === "book") { this.current = Number(target.value); this.show(); }
      else if (target.name === "film") { this.begin(target.value, copyOf(target.value ? liveData.films[target.value].scene : homeScene)); this.writeAddress(); }
    });
    root.addEventListener("keydown", (event) => this.key(event));
    root.querySelector(".player").addEventListener("click", (event) => this.act(event.target.closest("button")?.dataset.do));
    root.addEventListener("click", async (event) => {
      const button = event.target.closest("[data-live]");
      if (!button) return;
      if (button.dataset.live === "anew") {
        this.begin("", copyOf(homeScene));
        history.replaceState(null, "", "#live");
        return;
      }
      const script = document.getElementById("live-script");
      script.textContent = button.dataset.live === "script" ? scriptOf(this.scene, this.from) : location.href;
      script.hidden = button.dataset.live !== "script";
      button.dataset.copy = "live-script";
      if (button.dataset.live === "link") {
        this.writeAddress();
        script.textContent = location.href;
        script.hidden = false;
      }
      await copy(button);
    });
    for (const button of document.querySelectorAll("[data-take]")) {
      if (!Object.hasOwn(liveData.films, button.dataset.take)) continue;
      button.hidden = false;
      button.addEventListener("click", () => this.take(button.dataset.take));
    }
    let last;
    painter.canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      painter.canvas.setPointerCapture(event.pointerId);
      last = event;
    });
    painter.canvas.addEventListener("pointermove", (event) => {
      if (!painter.canvas.hasPointerCapture(event.pointerId)) return;
      this.turnBy(-(event.clientX - last.clientX) / 150, (event.clientY - last.clientY) / 150);
      last = event;
    });
    const seek = (event) => {
      const box = seekBar.getBoundingClientRect();
      this.go(Math.round(((event.clientX - box.left) / box.width) * (this.end - 1)));
    };
    seekBar.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      seekBar.setPointerCapture(event.pointerId);
      this.playing = false;
      this.show();
      seek(event);
    });
    seekBar.addEventListener("pointermove", (event) => { if (seekBar.hasPointerCapture(event.pointerId)) seek(event); });
    painter.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    painter.canvas.addEventListener("webglcontextrestored", () => { painter.begin(); this.go(this.place); });
    addEventListener("hashchange", () => this.readAddress());
    document.addEventListener("play", (event) => {
      if (!this.playing || event.target.closest(".hero")) return;
      this.playing = false;
      this.show();
    }, true);
    new ResizeObserver(() => { this.drawn = this.charted = false; this.wake(); }).observe(root);
    new IntersectionObserver((entries) => {
      this.placeInSight = entries.at(-1).isIntersecting;  // in a busy browser several come at once
      if (this.placeInSight) this.float(false);
      this.inSight = this.afloat || this.placeInSight;
      this.before = undefined;
      this.wake();
    }).observe(root.querySelector(".live-grid"));
  }
}

async function openPanel(root) {
  if (!document.createElement("canvas").getContext("webgl2")) return;  // the films are there
  const engine = await Engine.open(bytesOf(liveData.wasm));
  const pictures = await Promise.all(["pages", "front", "back", "spine"].map(async (name) => {
    const picture = new Image();
    picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(liveData.textures[name].replaceAll("Inter Display, Inter", "Inter Display, Inter, system-ui, sans-serif"));
    await picture.decode();
    const pen = new OffscreenCanvas(picture.width, picture.height).getContext("2d", { willReadFrequently: true });
    pen.drawImage(picture, 0, 0);
    return pen.getImageData(0, 0, picture.width, picture.height);
  }));
  root.hidden = false;
  root.panel = new Panel(root, engine, new Painter(root.querySelector(".live-stage canvas"), engine, liveData.shaders, pictures));
  for (const number of document.querySelectorAll(".drag")) root.panel.offer(number);
  for (const part of document.querySelectorAll(".to-live")) part.hidden = false;
}
openPanel(document.getElementById("live")).catch((error) => {
  document.getElementById("live").hidden = true;
  console.warn("The live panel: " + error.message);
});
