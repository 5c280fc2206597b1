// A joint with clearance, magnified: the clearance is drawn as large as the bearing, so that contact
// looks like contact.

const BORE = 1, CLEARANCE = 0.45, RIM = 1.18;

class Joint {
  constructor(parent, run, names, name) {
    this.run = run;
    this.box = element("figure", {class: "joint"});
    const select = element("select", {"aria-label": "magnified joint"});
    for (const joint of run.scenery.joints.filter(one => names.includes(one.name))) {
      select.append(element("option", {value: joint.name}, `${joint.label}, ${joint.kind}`));
    }
    select.value = name;
    select.addEventListener("change", async () => { await this.choose(select.value); this.again?.(); });
    this.canvas = element("canvas", {role: "img", "aria-label": "journal in its bearing"});
    this.words = element("figcaption");
    this.box.append(select, this.canvas, this.words);
    parent.append(this.box);
  }

  async choose(name) {
    const {run} = this, joint = run.scenery.joints.find(one => one.name === name);
    this.joint = joint;
    this.apart = (await channel(run, `${name}_eccentricity`)).slice(0, 2);
    this.ratio = await curve(run, `${name}:ratio`);
    this.force = (await channel(run, `${name}_force`))?.slice(0, 2);
    this.size = await curve(run, `${name}_force`);
    const poses = await channel(run, "body_position");
    this.turn = poses && joint.turns ? poses[3 * joint.body + 2] : null;
    const reach = this.ratio.reduce((a, b) => Math.max(a, b), 0);
    this.largest = this.size ? this.size.reduce((a, b) => Math.max(a, b), 0) || 1 : 1;
    this.scale = Math.min(CLEARANCE, (RIM - BORE) / Math.max(reach - 1, 1e-9));
    this.small = reach < 0.2 ? 1.25 * Math.max(reach, 1e-6) : null;
  }

  show(place, share, since) {
    if (!this.apart) return;
    const {canvas, joint, run} = this, dots = Math.min(devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * dots), height = Math.round(width * 0.9);
    if (!width) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    const pen = canvas.getContext("2d"), unit = 0.36 * height, theme = getComputedStyle(canvas);
    const colour = name => theme.getPropertyValue(`--${name}`);
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.setTransform(unit, 0, 0, -unit, 0.45 * width, 0.5 * height);
    const circle = (x, y, r, fill, edge, thick = 1) => {
      pen.beginPath();
      pen.arc(x, y, r, 0, 2 * Math.PI);
      if (fill) { pen.fillStyle = fill; pen.fill(); }
      if (edge) { pen.strokeStyle = edge; pen.lineWidth = thick * dots / unit; pen.stroke(); }
    };
    circle(0, 0, RIM, colour("steel"), colour("edge"));
    circle(0, 0, BORE, joint.kind === "lubricated" ? colour("oil") : colour("ground"), colour("edge"));
    const [ex, ey] = this.apart.map(values => at(values, place, share) / joint.clearance);
    const x = this.scale * ex, y = this.scale * ey, radius = BORE - this.scale;
    circle(x, y, radius, colour("metal"), colour("edge"));
    if (this.turn && !joint.ball) {
      const turn = at(this.turn, place, share), s = -Math.sin(turn), c = Math.cos(turn);
      pen.beginPath();
      pen.moveTo(x + 0.72 * radius * s, y + 0.72 * radius * c);
      pen.lineTo(x + radius * s, y + radius * c);
      pen.strokeStyle = colour("spoke");
      pen.lineWidth = 2 * dots / unit;
      pen.stroke();
    }
    pen.setLineDash([6 * dots / unit, 4 * dots / unit]);
    circle(0, 0, this.scale, null, colour("mark"), 1.3);
    pen.setLineDash([]);
    const first = before(run.seconds, run.seconds[place] - run.scenery.revolution);
    const path = scale => {
      pen.beginPath();
      for (let i = first; i <= place; i++) {
        pen.lineTo(scale * this.apart[0][i] / joint.clearance, scale * this.apart[1][i] / joint.clearance);
      }
      pen.strokeStyle = colour("run");
      pen.stroke();
    };
    pen.lineWidth = dots / unit;
    path(this.scale);
    circle(x, y, 0.035, colour("run"), colour("ground"));
    this.arrow(pen, x, y, place, since, dots / unit, colour("force"));
    if (this.small) this.inset(pen, path, ex, ey, colour, dots, unit, circle);
    this.tell(place, share, since);
  }

  // Draw the force on the journal, the largest since the last picture.
  arrow(pen, x, y, place, since, line, colour) {
    if (!this.size) return;
    let largest = place;
    for (let i = Math.min(since, place); i <= place; i++) {
      if (this.size[i] > this.size[largest]) largest = i;
    }
    this.shown = this.size[largest];
    const fx = this.force[0][largest], fy = this.force[1][largest], flat = Math.hypot(fx, fy);
    const length = 0.9 * Math.sqrt(this.shown / this.largest);
    if (!(length > 0.01) || !flat) return;
    const ux = fx / flat, uy = fy / flat, head = Math.min(0.14, 0.6 * length);
    const tx = x + ux * length, ty = y + uy * length, bx = tx - ux * head, by = ty - uy * head;
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(bx, by);
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = 2.4 * line;
    pen.stroke();
    pen.beginPath();
    pen.moveTo(tx, ty);
    pen.lineTo(bx - uy * head * 0.45, by + ux * head * 0.45);
    pen.lineTo(bx + uy * head * 0.45, by - ux * head * 0.45);
    pen.fill();
  }

  // Draw a path that is small in the clearance once more, magnified, in a corner.
  inset(pen, path, ex, ey, colour, dots, unit, circle) {
    const half = 0.42, middle = [1.05, -0.9];
    pen.save();
    pen.translate(...middle);
    pen.beginPath();
    pen.rect(-half, -half, 2 * half, 2 * half);
    pen.fillStyle = colour("ground");
    pen.fill();
    pen.strokeStyle = colour("edge");
    pen.lineWidth = dots / unit;
    pen.stroke();
    pen.clip();
    const scale = half / this.small;
    path(scale);
    circle(scale * ex, scale * ey, 0.035, colour("run"), null);
    pen.restore();
  }

  tell(place, share, since) {
    const ratio = at(this.ratio, place, share), gap = (1 - ratio) * this.joint.clearance * 1e6;
    const named = gap >= 0 ? `gap ${gap.toFixed(2)} µm` : `penetration ${(-gap).toFixed(2)} µm`;
    const force = this.shown ?? 0, most = since < place ? "largest " : "";
    const shown = force < 100 ? `${force.toPrecision(3)} N` : `${Number((force / 1e3).toPrecision(4))} kN`;
    const inset = this.small ? `; corner: path, ${Number((2e6 * this.small * this.joint.clearance)
      .toPrecision(2))} µm wide` : "";
    this.words.textContent = `e/c = ${ratio.toFixed(4)}, ${named}, ${most}F = ${shown}${inset}`;
  }
}
