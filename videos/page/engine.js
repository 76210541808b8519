// The motion, computed by the program's own code in WebAssembly: src/live/live.h says what it offers.
"use strict";

class Engine {
  static async open(bytes) {
    const engine = new Engine();
    const { instance } = await WebAssembly.instantiate(bytes, {
      bookspin: { fail: (text, size) => { engine.complaint = engine.#text(text, size); } },
    });
    engine.#wasm = instance.exports;
    engine.#wasm._initialize();
    const column = (table) => {
      const words = [];
      for (let row = 0, text; (text = engine.#wasm.live_word(table, row)) !== 0; ++row) words.push(engine.#text(text));
      return words;
    };
    const [methods, integrators, overlays, names, symbols, titles, units] = [0, 1, 2, 3, 4, 5, 6].map(column);
    engine.methods = methods;
    engine.integrators = integrators;
    engine.overlays = overlays;
    engine.quantities = names.map((name, i) => {
      const [scale, low, high, most] = [0, 1, 2, 3].map((which) => engine.#wasm.live_axis(i, which));
      return { name, symbol: symbols[i], title: titles[i], unit: units[i], scale, low, high, most };
    });
    engine.doubles = engine.#wasm.live_doubles();
    return engine;
  }

  #wasm;
  #scene = 0;

  #text(at, size) {
    const bytes = new Uint8Array(this.#wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, size ?? bytes.indexOf(0)));
  }

  takes(method, damped, integrator) {
    return this.#wasm.live_takes(this.methods.indexOf(method), damped ? 1 : 0, this.integrators.indexOf(integrator)) === 1;
  }

  // A scene as `bookspin json` prints it: its motion begins anew.
  begin(scene) {
    this.#wasm.live_close(this.#scene);
    const numbers = [scene.frames, scene.time_per_frame, scene.substeps, scene.seed];
    for (const book of scene.books) {
      numbers.push(this.methods.indexOf(book.method), this.integrators.indexOf(book.integrator), ...book.size, ...book.moments,
        ...(book.orientation ?? [0, 0, 0, 0]), ...book.angular_velocity, book.jiggle, book.normalize_every, book.damping, book.stiffness,
        book.particle_mass, ...book.position, book.ghost ? 1 : 0,
        book.show.reduce((bits, overlay) => bits | (1 << this.overlays.indexOf(overlay)), 0));
    }
    const room = this.#wasm.malloc(8 * numbers.length);
    new Float64Array(this.#wasm.memory.buffer, room, numbers.length).set(numbers);
    this.#scene = this.#wasm.live_open(room, scene.books.length);
    this.#wasm.free(room);
    this.frames = 1;
  }

  // At most so many frames more.
  advance(frames) {
    this.frames = this.#wasm.live_advance(this.#scene, frames);
  }

  // The first frame in which the book has exploded; -1: none so far.
  exploded(book) {
    return this.#wasm.live_exploded(this.#scene, book);
  }

  // Of all frames so far, as live.h says; to be asked for anew after advance().
  track(book) {
    return new Float64Array(this.#wasm.memory.buffer, this.#wasm.live_track(this.#scene, book), this.frames * this.doubles);
  }

  // Where a quantity stands among a frame's doubles.
  place(name) {
    return this.doubles - this.quantities.length + this.quantities.findIndex((q) => q.name === name);
  }

  // The hardcover, coarse (1) or fine (4).
  mesh(fineness) {
    const at = this.#wasm.live_mesh(fineness);
    const { buffer } = this.#wasm.memory;  // of now: the module may have grown
    const numbers = new Uint32Array(buffer, at, 14);
    const list = (Kind, i) => new Kind(buffer, numbers[2 * i], numbers[2 * i + 1]).slice();
    return { vertices: list(Float32Array, 0), borders: list(Float32Array, 1), parts: [2, 3, 4, 5, 6].map((i) => list(Uint16Array, i)) };
  }

  // The next smaller picture of a texture, of 4 bytes a pixel.
  halved(pixels, width, height) {
    const room = this.#wasm.malloc(pixels.length);
    new Uint8Array(this.#wasm.memory.buffer, room, pixels.length).set(pixels);
    const at = this.#wasm.live_halved(room, width, height);
    const half = new Uint8Array(this.#wasm.memory.buffer, at, 4 * Math.max(1, width >> 1) * Math.max(1, height >> 1)).slice();
    this.#wasm.free(room);
    return half;
  }

  // What a frame shows: a kind and its numbers, item after item, until the next call.
  *picture(frame, from, zoom, width, height) {
    const room = this.#wasm.malloc(24);
    new Float64Array(this.#wasm.memory.buffer, room, 3).set(from);
    let at = this.#wasm.live_picture(this.#scene, frame, room, zoom, width, height);
    this.#wasm.free(room);
    const { buffer } = this.#wasm.memory;
    while (true) {
      const [kind, count] = new Float32Array(buffer, at, 2);
      if (kind < 0) return;
      yield [kind, new Float32Array(buffer, at + 8, count)];
      at += 8 + 4 * count;
    }
  }
}
