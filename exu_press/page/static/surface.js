// Flexible bodies, deformed and coloured by stress or displacement, drawn by the graphics card.

const VERTEX = `attribute vec3 place; attribute vec3 normal; attribute float level;
uniform mat3 view; uniform vec3 middle; uniform vec2 scale; varying float shown; varying float light;
void main() { vec3 seen = view * (place - middle); shown = level;
  light = 0.72 + 0.28 * clamp(dot(normalize(view * normal), vec3(-0.353, 0.656, 0.667)), 0.0, 1.0);
  gl_Position = vec4(seen.xy * scale, -seen.z * 0.2 * scale.x, 1.0); }`;
// From pale to dark: levels are told apart by their lightness alone.
const FRAGMENT = `precision mediump float; varying float shown; varying float light;
void main() { float s = clamp(shown, 0.0, 1.0);
  vec3 a = vec3(0.93, 0.97, 0.76), b = vec3(0.38, 0.77, 0.73), c = vec3(0.13, 0.37, 0.66),
    d = vec3(0.03, 0.11, 0.35);
  vec3 colour = s < 0.34 ? mix(a, b, s / 0.34) : s < 0.67 ? mix(b, c, (s - 0.34) / 0.33)
    : mix(c, d, (s - 0.67) / 0.33);
  gl_FragColor = vec4(colour * light, 1.0); }`;

class Surfaces {
  constructor(parent) { this.parent = parent; }

  async open(run) {
    this.parent.replaceChildren();
    this.parent.hidden = !run.surfaces.length;
    this.run = null;
    if (!run.surfaces.length) return;
    const bar = element("div", {class: "bar"});
    this.choice = element("select", {"aria-label": "colour of flexible bodies"});
    const stressed = run.surfaces.every(one => one.stress);
    if (stressed) this.choice.append(element("option", {value: "stress"}, "von Mises stress, MPa"));
    this.choice.append(element("option", {value: "displacement"}, "displacement, µm"));
    this.factor = element("select", {"aria-label": "deformation is drawn larger by"});
    for (const times of [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000]) {
      this.factor.append(element("option", {value: times}, `deformation × ${times}`));
    }
    bar.append(this.choice, this.factor);
    this.canvas = element("canvas", {role: "img", tabindex: "0",
      "aria-label": "flexible bodies, deformed; drag or use the arrow keys to turn them"});
    this.legend = element("div", {class: "scale"});
    this.parent.append(element("h3", {}, "Flexible bodies"), bar, this.canvas, this.legend);
    const gl = this.gl = this.canvas.getContext("webgl", {antialias: true});
    if (!gl) {
      this.legend.textContent = "This browser has no WebGL, which draws flexible bodies.";
      this.legend.className = "";
      this.canvas.hidden = true;
      return;
    }
    this.program();
    this.poses = await channel(run, "body_position");
    this.bodies = [];
    for (const one of run.surfaces) this.bodies.push(await this.body(run, one));
    this.run = run;
    this.turn = [-55 * Math.PI / 180, 20 * Math.PI / 180];
    this.extremes();
    for (const control of [this.choice, this.factor]) {
      control.addEventListener("change", () => this.again?.());
    }
    this.drag();
  }

  program() {
    const {gl} = this, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    this.at = name => gl.getUniformLocation(program, name);
    this.attribute = name => gl.getAttribLocation(program, name);
  }

  async body(run, one) {
    const {gl} = this, count = one.nodes.rows, modes = one.modes.length;
    const triangles = (await block(one.triangles)), third = one.triangles.rows;
    const order = new Uint32Array(3 * third);
    for (let t = 0; t < third; t++) for (let k = 0; k < 3; k++) order[3 * t + k] = triangles[k * third + t];
    if (!gl.getExtension("OES_element_index_uint")) throw new Error("WebGL without large indices");
    const index = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, order, gl.STATIC_DRAW);
    const all = await channel(run, `${one.body}_modes`);
    return {
      ...one, count, order, indices: index,
      nodes: await block(one.nodes),
      coordinates: one.modes.map(mode => all[mode]),
      shapes: await block(one.shapes.block), scales: one.shapes.scale,
      stresses: one.stress ? await block(one.stress.block) : null,
      stressScales: one.stress?.scale,
      place: new Float32Array(3 * count), normal: new Float32Array(3 * count),
      level: new Float32Array(count), moved: new Float32Array(3 * count),
      part: new Float32Array(6 * count),
      buffers: ["place", "normal", "level"].map(() => gl.createBuffer()), modes,
    };
  }

  // Sum components of all modes: out[c * count + s].
  sum(body, table, scales, components, place, share, out) {
    const {count, modes} = body;
    out.fill(0);
    for (let m = 0; m < modes; m++) {
      const q = at(body.coordinates[m], place, share) * scales[m];
      if (!q) continue;
      for (let c = 0; c < components; c++) {
        const from = (c * modes + m) * count, to = c * count;
        for (let s = 0; s < count; s++) out[to + s] += q * table[from + s];
      }
    }
  }

  // Work out displacements and levels of a body at an instant; return the largest of both.
  work(body, place, share) {
    const {count, moved, level, part} = body;
    this.sum(body, body.shapes, body.scales, 3, place, share, moved);
    let displaced = 0, most = 0;
    const stress = this.choice.value === "stress";
    if (stress) this.sum(body, body.stresses, body.stressScales, 6, place, share, part);
    for (let s = 0; s < count; s++) {
      const size = Math.hypot(moved[s], moved[count + s], moved[2 * count + s]);
      if (size > displaced) displaced = size;
      let value = size * 1e6;
      if (stress) {
        const [xx, yy, zz, yz, xz, xy] = [0, 1, 2, 3, 4, 5].map(c => part[c * count + s]);
        value = 1e-6 * Math.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) +
          3 * (yz * yz + xz * xz + xy * xy));
      }
      level[s] = value;
      if (value > most) most = value;
    }
    return [displaced, most];
  }

  // Find the largest displacement and levels of the run, for the scales.
  extremes() {
    const {run} = this, length = run.seconds.length, chosen = new Set();
    for (let k = 0; k < 24; k++) chosen.add(Math.floor((length - 1) * k / 23));
    for (const body of this.bodies) {
      for (const values of body.coordinates.slice(0, 6)) {
        let high = 0, low = 0;
        for (let i = 0; i < values.length; i++) {
          if (values[i] > values[high]) high = i;
          if (values[i] < values[low]) low = i;
        }
        chosen.add(high).add(low);
      }
    }
    this.most = {};
    let displaced = 0, extent = 0;
    for (const kind of [...this.choice.options].map(option => option.value).reverse()) {
      this.choice.value = kind;
      this.most[kind] = 0;
      for (const body of this.bodies) {
        for (const place of chosen) {
          const [moved, level] = this.work(body, place, 0);
          displaced = Math.max(displaced, moved);
          this.most[kind] = Math.max(this.most[kind], level);
        }
        extent = Math.max(extent, ...[0, 1, 2].map(c => {
          const column = body.nodes.subarray(c * body.count, (c + 1) * body.count);
          return column.reduce((a, b) => Math.max(a, b)) - column.reduce((a, b) => Math.min(a, b));
        }));
      }
    }
    const wanted = displaced ? 0.06 * extent / displaced : 1;
    const fits = [...this.factor.options].filter(option => Number(option.value) <= wanted);
    this.factor.value = (fits.at(-1) ?? this.factor.options[0]).value;
    this.extent = extent;
  }

  show(place, share) {
    if (!this.run) return;
    const {gl, canvas} = this, dots = Math.min(devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * dots), height = Math.round(width * 0.7);
    if (!width) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const [y, x] = this.turn, cy = Math.cos(y), sy = Math.sin(y), cx = Math.cos(x), sx = Math.sin(x);
    const view = [cy, sx * sy, -cx * sy, 0, cx, sx, sy, -sx * cy, cx * cy];
    gl.uniformMatrix3fv(this.at("view"), false, new Float32Array(view));
    const most = this.most[this.choice.value] || 1, factor = Number(this.factor.value);
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const body of this.bodies) {
      [, body.largest] = this.work(body, place, share);
      this.pose(body, place, share, factor, most);
      for (let i = 0; i < body.place.length; i++) {
        low[i % 3] = Math.min(low[i % 3], body.place[i]);
        high[i % 3] = Math.max(high[i % 3], body.place[i]);
      }
    }
    this.box ??= [low, high];  // the view stands still
    const middle = [0, 1, 2].map(c => (this.box[0][c] + this.box[1][c]) / 2);
    const reach = Math.hypot(...[0, 1, 2].map(c => this.box[1][c] - this.box[0][c]));
    gl.uniform3fv(this.at("middle"), middle);
    const scale = 1.75 / reach;
    gl.uniform2f(this.at("scale"), scale, scale * width / height);
    for (const body of this.bodies) this.draw(body);
    const unit = this.choice.value === "stress" ? "MPa" : "µm";
    const now = Math.max(...this.bodies.map(body => body.largest));
    this.legend.textContent = `0 to ${Number(most.toPrecision(3))} ${unit}; now at most ${
      Number(now.toPrecision(3))} ${unit}`;
  }

  // Put a body's nodes where they are, deformed.
  pose(body, place, share, factor, most) {
    const {count, nodes, moved, order} = body, k = 3 * body.index;
    const [x, y, angle] = [0, 1, 2].map(c => this.poses ? at(this.poses[k + c], place, share) : 0);
    const c = Math.cos(angle), s = Math.sin(angle);
    for (let n = 0; n < count; n++) {
      const px = nodes[n] + factor * moved[n], py = nodes[count + n] + factor * moved[count + n];
      body.place[3 * n] = x + c * px - s * py;
      body.place[3 * n + 1] = y + s * px + c * py;
      body.place[3 * n + 2] = nodes[2 * count + n] + factor * moved[2 * count + n];
      body.level[n] /= most;
    }
    const {normal} = body, p = body.place;
    normal.fill(0);
    for (let t = 0; t < order.length; t += 3) {
      const [i, j, l] = [3 * order[t], 3 * order[t + 1], 3 * order[t + 2]];
      const ax = p[j] - p[i], ay = p[j + 1] - p[i + 1], az = p[j + 2] - p[i + 2];
      const bx = p[l] - p[i], by = p[l + 1] - p[i + 1], bz = p[l + 2] - p[i + 2];
      const nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
      for (const at of [i, j, l]) { normal[at] += nx; normal[at + 1] += ny; normal[at + 2] += nz; }
    }
  }

  draw(body) {
    const {gl} = this;
    ["place", "normal", "level"].forEach((name, k) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, body.buffers[k]);
      gl.bufferData(gl.ARRAY_BUFFER, body[name], gl.DYNAMIC_DRAW);
      const where = this.attribute(name);
      gl.enableVertexAttribArray(where);
      gl.vertexAttribPointer(where, name === "level" ? 1 : 3, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, body.indices);
    gl.drawElements(gl.TRIANGLES, body.order.length, gl.UNSIGNED_INT, 0);
  }

  drag() {
    const {canvas} = this;
    canvas.addEventListener("pointermove", event => {
      if (!event.buttons) return;
      this.turn = [this.turn[0] + 0.01 * event.movementX, this.turn[1] + 0.01 * event.movementY];
      this.again?.();
    });
    canvas.addEventListener("keydown", event => {
      const by = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
      if (!by[event.key]) return;
      event.preventDefault();
      event.stopPropagation();
      this.turn = this.turn.map((angle, k) => angle + by[event.key][k]);
      this.again?.();
    });
  }
}
