// The books and their overlays, drawn as the program draws them: with its meshes, shaders and order.
class Painter {
  constructor(canvas, engine, shaders, pictures) {
    this.gl = canvas.getContext("webgl2", { antialias: true, alpha: false });
    if (!this.gl) throw new Error("no WebGL2");
    this.canvas = canvas;
    this.engine = engine;
    this.shaders = shaders;
    this.pictures = pictures;
    this.begin();
  }

  begin() {
    const gl = this.gl;
    const compile = (stage, text) => {
      const shader = gl.createShader(stage);
      gl.shaderSource(shader, text.replace("#version 330 core", "#version 300 es\nprecision highp float;"));
      gl.compileShader(shader);
      return shader;
    };
    const program = (vertex, fragment) => {
      const handle = gl.createProgram();
      gl.attachShader(handle, compile(gl.VERTEX_SHADER, this.shaders[vertex]));
      gl.attachShader(handle, compile(gl.FRAGMENT_SHADER, this.shaders[fragment]));
      gl.linkProgram(handle);
      if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(`${vertex}: ${gl.getProgramInfoLog(handle)}`);
      return new Proxy({ handle }, { get: (known, name) => known[name] ?? (known[name] = gl.getUniformLocation(handle, name)) });
    };
    this.solid = program("book.vert", "book.frag");
    this.glass = program("book.vert", "ghost.frag");
    this.border = program("border.vert", "line.frag");
    this.arrow = program("solid.vert", "solid.frag");
    this.line = program("line.vert", "line.frag");
    this.meshes = [1, 4].map((fineness) => this.mesh(this.engine.mesh(fineness)));
    this.stream = gl.createBuffer();
    this.streams = [[3, 3, 4], [4, 4]].map((sizes) => this.vertices(this.stream, sizes));
    this.textures = this.pictures.map((picture) => this.texture(picture));
  }

  // A vertex array of attributes that follow one another in a buffer.
  vertices(buffer, sizes) {
    const gl = this.gl;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    const stride = 4 * sizes.reduce((sum, size) => sum + size);
    let offset = 0;
    sizes.forEach((size, place) => {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
      offset += 4 * size;
    });
    return array;
  }

  mesh({ vertices, borders, parts }) {
    const gl = this.gl;
    const filled = (data, sizes) => {
      const buffer = gl.createBuffer();
      const array = this.vertices(buffer, sizes);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      return array;
    };
    const borderArray = filled(borders, [3, 3, 3, 2]);
    const array = filled(vertices, [3, 3, 2, 1]);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    const indices = new Uint16Array(parts.flatMap((part) => [...part]));
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    let first = 0;
    const ranges = parts.map((part) => ({ count: part.length, at: 2 * ((first += part.length) - part.length) }));
    return { array, ranges, borderArray, borderCount: borders.length / 11 };
  }

  texture(picture) {
    const gl = this.gl;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    let { width, height } = picture;
    let pixels = new Uint8Array(picture.data.buffer);
    for (let level = 0; ; ++level) {
      gl.texImage2D(gl.TEXTURE_2D, level, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      if (width === 1 && height === 1) break;
      pixels = this.engine.halved(pixels, width, height);
      [width, height] = [Math.max(1, width >> 1), Math.max(1, height >> 1)];
    }
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);  // WebGL cannot choose a finer level
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }

  draw(frame, from, zoom) {
    const gl = this.gl;
    if (gl.isContextLost()) return;
    const { canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(32 / 255, 39 / 255, 49 / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.frontFace(gl.CW);  // y runs down; the style sheet turns the canvas over
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    for (const [kind, numbers] of this.engine.picture(frame, from, zoom, canvas.width, canvas.height)) {
      if (kind === 0) this.drawSolid(numbers);
      else if (kind === 1) this.drawGhost(numbers);
      else if (kind === 2) this.drawArrow(numbers);
      else this.drawLines(numbers, kind === 4);
    }
  }

  place(program, numbers, nearer = 0) {
    const gl = this.gl;
    gl.useProgram(program.handle);
    gl.uniform3fv(program.corners_C, numbers.subarray(3, 27));
    const clip = numbers.slice(27, 43);
    for (let column = 0; column < 4; ++column) clip[4 * column + 2] -= nearer * clip[4 * column + 3];
    gl.uniformMatrix4fv(program.clip_from_camera, false, clip);
    if (numbers[2] === 1) gl.enable(gl.CULL_FACE); else gl.disable(gl.CULL_FACE);
  }

  part(mesh, part) {
    const gl = this.gl;
    gl.bindVertexArray(mesh.array);
    gl.bindTexture(gl.TEXTURE_2D, this.textures[Math.max(part - 1, 0)]);  // the insides are of paper, too
    gl.drawElements(gl.TRIANGLES, mesh.ranges[part].count, gl.UNSIGNED_SHORT, mesh.ranges[part].at);
  }

  drawSolid(numbers) {
    this.place(this.solid, numbers);
    this.gl.uniform1f(this.solid.brightness, numbers[0]);
    for (let part = 0; part < 5; ++part) this.part(this.meshes[1 - numbers[1]], part);
  }

  drawGhost(numbers) {
    const gl = this.gl;
    const bent = numbers[1] === 0;
    const mesh = this.meshes[1 - numbers[1]];
    const tint = [190 / 255, 228 / 255, 1];
    const coincident = 4e-5;
    const faces = () => {
      this.place(this.glass, numbers, -coincident);
      gl.uniform3fv(this.glass.tint, tint);
      for (let part = 4; part >= 0; --part) this.part(mesh, part);
    };
    if (bent) {
      gl.colorMask(false, false, false, false);
      faces();
      gl.colorMask(true, true, true, true);
    }
    gl.enable(gl.BLEND);
    this.place(this.border, numbers, coincident);
    gl.bindVertexArray(this.meshes[0].borderArray);
    gl.uniform2fv(this.border.half_frame, numbers.subarray(43, 45));
    for (const seen of [false, true]) {
      gl.depthFunc(seen ? gl.LESS : gl.ALWAYS);
      gl.depthMask(seen);
      gl.uniform4f(this.border.color, ...tint, seen ? 0.85 : 0.4);
      gl.drawArrays(gl.TRIANGLES, 0, this.meshes[0].borderCount);
    }
    gl.depthFunc(bent ? gl.LEQUAL : gl.LESS);
    faces();
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
  }

  triangles(stream, vertices, floats) {
    const gl = this.gl;
    gl.disable(gl.CULL_FACE);
    gl.bindVertexArray(this.streams[stream]);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.stream);
    gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STREAM_DRAW);
    gl.drawArrays(gl.TRIANGLES, 0, vertices.length / floats);
  }

  drawArrow(numbers) {
    const gl = this.gl;
    gl.useProgram(this.arrow.handle);
    gl.uniformMatrix4fv(this.arrow.clip_from_world, false, numbers.subarray(0, 16));
    gl.uniformMatrix3fv(this.arrow.R_CW, false, numbers.subarray(16, 25));
    this.triangles(0, numbers.subarray(25), 10);
  }

  drawLines(numbers, translucent) {
    const gl = this.gl;
    gl.useProgram(this.line.handle);
    if (translucent) gl.enable(gl.BLEND);
    gl.depthMask(!translucent);
    this.triangles(1, numbers, 8);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
  }
}
