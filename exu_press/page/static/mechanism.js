// The mechanism from the front, to scale: bodies at their poses, names that follow, forces.

const SVG = "http://www.w3.org/2000/svg";

function drawn(kind, attributes, parent) {
  const made = document.createElementNS(SVG, kind);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  parent.append(made);
  return made;
}

const corners = points => points.map(([x, y]) => `${x},${-y}`).join(" ");

class Mechanism {
  constructor(svg) { this.svg = svg; }

  async open(run) {
    const {scenery} = run, {svg} = this, [left, low, right, high] = scenery.box;
    const {unit} = scenery;
    this.run = run;
    this.scenery = scenery;
    svg.replaceChildren();
    const poses = await channel(run, "body_position");
    svg.toggleAttribute("hidden", poses === null);
    this.poses = poses;
    if (!poses) return;
    const ends = scenery.ends.length ? 0.12 : 0.03;
    this.box = [left - ends * unit, low - 0.13 * unit, right + 0.42 * unit, high + 0.05 * unit];
    const [x0, y0, x1, y1] = this.box;
    svg.setAttribute("viewBox", `${x0} ${-y1} ${x1 - x0} ${y1 - y0}`);
    for (const rail of scenery.rails) drawn("polygon", {points: corners(rail), class: "fixed"}, svg);
    for (const wheel of scenery.wheels) drawn("polygon", {points: corners(wheel), class: "wheel"}, svg);
    for (const [x, y] of scenery.pivots) {
      drawn("circle", {cx: x, cy: -y, r: 0.026 * unit, class: "fixed"}, svg);
    }
    for (const {label, at: [x, y], aside: [ux, uy], above} of scenery.ends) {
      const from = 0.01 * unit, to = 0.035 * unit, x2 = x + to * ux, y2 = -y - to * uy;
      drawn("line", {x1: x + from * ux, y1: -y - from * uy, x2, y2, class: "end"}, svg);
      const dy = above ? -0.006 * unit : 0.026 * unit;
      drawn("text", {x: x2, y: y2 + dy, "font-size": 0.026 * unit, class: "faint"}, svg)
        .textContent = label;
    }
    this.bodies = scenery.bodies.map((body, index) => ({...body, index}));
    for (const body of [...this.bodies].sort((a, b) => a.layer - b.layer)) {
      body.group = drawn("g", {class: "body"}, svg);
      drawn("polygon", {points: corners(body.outline), fill: body.colour}, body.group);
      for (const slot of body.slots) {
        drawn("polygon", {points: corners(slot), class: "fixed"}, body.group);
      }
      drawn("title", {}, body.group).textContent = body.name;
    }
    this.springs = scenery.springs.map(spring => ({...spring}));
    for (const spring of this.springs) {
      spring.line = drawn("polyline", {class: "spring"}, svg);
      drawn("title", {}, spring.line).textContent = spring.name;
    }
    const size = 0.034 * unit;
    for (const body of this.bodies.filter(one => one.label)) {
      body.leader = drawn("line", {class: "leader"}, svg);
      body.middle = [0, 1].map(k => {  // of its outline: the centre of mass may be elsewhere
        const along = body.outline.map(point => point[k]);
        return (Math.min(...along) + Math.max(...along)) / 2;
      });
      body.words = drawn("text", {x: right + 0.07 * unit, "font-size": size}, svg);
      body.words.textContent = body.label;
    }
    this.joints = scenery.joints.map(joint => ({...joint}));
    for (const joint of this.joints) {
      const loose = joint.kind !== "ideal";
      joint.pin = drawn("circle",
        {r: (loose ? 0.012 : 0.008) * unit, class: loose ? "pin loose" : "pin"}, svg);
      drawn("title", {}, joint.pin).textContent = `${joint.label}, ${joint.kind}`;
    }
    this.arrows = drawn("g", {class: "arrows"}, svg);
    this.largest = 0;
    await Promise.all(this.joints.map(async joint => {
      joint.force = await channel(run, `${joint.name}_force`);
      joint.size = await curve(run, `${joint.name}_force`);
      if (!joint.force) return;
      joint.arrow = drawn("path", {class: "arrow"}, this.arrows);
      for (const size of joint.size) if (size > this.largest) this.largest = size;
    }));
  }

  // Show an instant: place and share between two of the run's; `since` is the last one shown.
  show(place, share, since) {
    if (!this.poses) return;
    const {unit} = this.scenery, pose = k => at(this.poses[k], place, share);
    for (const body of this.bodies) {
      body.x = pose(3 * body.index);
      body.y = pose(3 * body.index + 1);
      body.angle = pose(3 * body.index + 2);
      const degrees = -body.angle * 180 / Math.PI;
      body.group.setAttribute("transform", `translate(${body.x} ${-body.y}) rotate(${degrees})`);
    }
    this.name();
    for (const spring of this.springs) this.stretch(spring);
    for (const joint of this.joints) {
      [joint.x, joint.y] = this.point(joint.body, joint.at);
      joint.pin.setAttribute("cx", joint.x);
      joint.pin.setAttribute("cy", -joint.y);
      if (joint.arrow) this.force(joint, place, since, unit);
    }
  }

  // The position of a point of a body, by its index, or of the frame.
  point(index, [px, py]) {
    if (index < 0) return [px, py];
    const {x, y, angle} = this.bodies[index], c = Math.cos(angle), s = Math.sin(angle);
    return [x + c * px - s * py, y + s * px + c * py];
  }

  // Draw a spring between its ends.
  stretch({ends, symbol, line}) {
    const [[x1, y1], [x2, y2]] = ends.map(({body, at}) => this.point(body, at));
    const dx = x2 - x1, dy = y2 - y1, length = Math.hypot(dx, dy) || 1;
    line.setAttribute("points", corners(symbol.map(([share, across]) =>
      [x1 + share * dx - across * dy / length, y1 + share * dy + across * dx / length])));
  }

  // Put the names beside their bodies, none over another.
  name() {
    const {unit} = this.scenery, line = 0.042 * unit, [, low, right, high] = this.box;
    const named = this.bodies.filter(body => body.words);
    for (const body of named) [body.toX, body.toY] = this.point(body.index, body.middle);
    named.sort((a, b) => b.toY - a.toY);
    let top = high - 0.5 * line;
    for (const body of named) top = body.at = Math.min(body.toY, top) - line;
    let bottom = low;
    for (const body of [...named].reverse()) {
      body.at = Math.max(body.at + line, bottom);
      bottom = body.at + line;
    }
    const x = right - 0.355 * unit;
    for (const body of named) {
      body.words.setAttribute("y", -body.at + 0.012 * unit);
      const ends = {x1: body.toX, y1: -body.toY, x2: x, y2: -body.at};
      for (const [name, value] of Object.entries(ends)) body.leader.setAttribute(name, value);
    }
  }

  // Draw the largest force on a joint since the last picture; its length is its square root.
  force(joint, place, since, unit) {
    let largest = place;
    for (let i = Math.min(since, place); i <= place; i++) {
      if (joint.size[i] > joint.size[largest]) largest = i;
    }
    const size = joint.size[largest], fx = joint.force[0][largest], fy = joint.force[1][largest];
    const flat = Math.hypot(fx, fy), length = 0.16 * unit * Math.sqrt(size / (this.largest || 1));
    joint.shown = size;
    if (!(length > 0.004 * unit) || !flat) { joint.arrow.setAttribute("d", ""); return; }
    const ux = fx / flat, uy = -fy / flat, head = Math.min(0.022 * unit, 0.6 * length);
    const x = joint.x + ux * length, y = -joint.y + uy * length;
    const bx = x - ux * head, by = y - uy * head, wx = -uy * head * 0.4, wy = ux * head * 0.4;
    joint.arrow.setAttribute("d", `M${joint.x} ${-joint.y}L${bx} ${by}M${x} ${y}` +
      `L${bx + wx} ${by + wy}L${bx - wx} ${by - wy}Z`);
  }
}
