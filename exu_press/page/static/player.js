// Playback: one instant that curves, slider, mechanism and joints share.

class Player {
  constructor(data) {
    this.data = data;
    this.playing = false;
    this.impact = -1;
    this.x = 0;  // on the axis that is shown, of the main run
    this.seen = null;  // the last instant that was drawn
  }

  async open() {
    const {data} = this;
    this.curves = new Curves(data, x => { if (!this.playing) this.put(x); });
    this.curves.changed = () => this.follow();
    this.curves.clicked = (kind, number) => this.open_mark(kind, number);
    await this.curves.open();
    const choice = byId("run");
    data.runs.forEach((run, r) => choice.append(element("option", {value: r}, run.label || "run")));
    byId("run-choice").hidden = data.runs.length < 2;
    const richest = data.runs.map(run => 1e6 * run.scenery.magnified.length + run.impacts.length);
    choice.value = String(richest.indexOf(Math.max(...richest)));
    this.legend();
    this.listen();
    this.mechanism = new Mechanism(byId("mechanism"));
    this.surfaces = new Surfaces(byId("surfaces"));
    this.surfaces.again = () => this.redraw();
    await this.choose(Number(choice.value));
    const largest = [...this.run.impacts].sort((a, b) => b.force - a.force)[0];
    const start = largest ? 1e3 * largest.peak : this.run.x.time[0];
    this.put(interpolated(start, this.run.x.time, this.run.x[this.curves.axis]));
  }

  get run() { return this.curves.main; }

  // Show the mechanism of a run.
  async choose(number) {
    this.curves.mainRun = number;
    const {run} = this;
    this.curves.marks();
    byId("previous").disabled = byId("next").disabled = !run.impacts.length;
    await this.mechanism.open(run);
    await this.surfaces.open(run);
    byId("joints").replaceChildren();
    const loose = run.scenery.joints.filter(joint => `${joint.name}:ratio` in run.curves)
      .map(joint => joint.name);
    this.joints = [];
    for (const name of run.scenery.magnified.filter(one => loose.includes(one))) {
      const joint = new Joint(byId("joints"), run, loose, name);
      await joint.choose(name);
      joint.again = () => this.redraw();
      this.joints.push(joint);
    }
    const thinned = this.data.runs.filter(one => one.every > 1).map(one =>
      `${one.label ? `${one.label}: ` : ""}the page holds the least and the largest value of every ${
        one.every} of ${one.count} steps, so that it stays small; no peak is lost.`);
    const more = run.unmarked ? [`${run.unmarked} weaker impacts are not marked.`] : [];
    if (run.horizon !== null) {
      more.push(`Hatched, from ${inWords(1e3 * run.horizon)} ms on: errors have grown beyond the figures.`);
    }
    byId("thinned").textContent = [...thinned, ...more].join(" ");
    this.redraw();
  }

  legend() {
    if (this.data.runs.length < 2) return;
    for (const run of this.data.runs) {
      const one = element("span", {class: "value"}, run.label);
      one.style.setProperty("--run", run.colour);
      byId("legend").append(one);
    }
  }

  listen() {
    byId("play").addEventListener("click", () => this.toggle());
    byId("slider").addEventListener("input", event => this.put(Number(event.target.value)));
    byId("previous").addEventListener("click", () => this.next(-1));
    byId("next").addEventListener("click", () => this.next(1));
    byId("in").addEventListener("click", () => this.curves.scale(0.5, this.x));
    byId("out").addEventListener("click", () => this.curves.scale(2, this.x));
    byId("left").addEventListener("click", () => this.curves.shift(-0.5));
    byId("right").addEventListener("click", () => this.curves.shift(0.5));
    byId("whole").addEventListener("click", () => this.curves.whole());
    byId("more").addEventListener("click", () => this.curves.more(1));
    byId("less").addEventListener("click", () => this.curves.more(-1));
    byId("drag").addEventListener("change", event => this.curves.drag(event.target.value));
    byId("forces").addEventListener("change", event =>
      byId("viewer").classList.toggle("no-forces", !event.target.checked));
    byId("axis").addEventListener("change", event => {
      const from = this.run.x[this.curves.axis];
      this.curves.change(event.target.value);
      this.put(interpolated(this.x, from, this.run.x[this.curves.axis]));
    });
    byId("run").addEventListener("change", event => this.choose(Number(event.target.value)));
    document.addEventListener("keydown", event => this.key(event));
    addEventListener("resize", () => {
      this.curves.fit();
      this.curves.later();
    });
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const {tagName, type} = event.target, slider = event.target === byId("slider");
    if (tagName === "SELECT" || (tagName === "INPUT" && !slider && type !== "checkbox")) return;
    if (event.key === " " && ["BUTTON", "INPUT", "SUMMARY"].includes(tagName) && !slider) return;
    const scrolls = !slider && event.target !== document.body && !event.target.closest("#viewer");
    const steps = {ArrowLeft: -1, ArrowRight: 1, PageUp: -10, PageDown: 10};
    if (event.key in steps && !scrolls && (slider || event.key.startsWith("Arrow"))) {
      this.step(steps[event.key]);
    } else if (event.key === " " && !scrolls) this.toggle();
    else if (event.key === "n") this.next(1);
    else if (event.key === "p") this.next(-1);
    else if (event.key === "+") this.curves.scale(0.5, this.x);
    else if (event.key === "-") this.curves.scale(2, this.x);
    else if (event.key === "0") this.curves.whole();
    else return;
    event.preventDefault();
  }

  // Go so many steps of the run further.
  step(by) {
    const axis = this.run.x[this.curves.axis], place = before(axis, this.x + 1e-12 * Math.abs(this.x));
    const to = Math.min(Math.max(place + by, 0), axis.length - 1);
    this.show_x(axis[to]);
  }

  // Put the pointer somewhere and show it: move the range if it is outside.
  show_x(x) {
    const {start, end} = this.curves.range;
    if (x < start || x > end) this.curves.zoom(x - (end - start) / 2, x + (end - start) / 2);
    this.put(x);
  }

  // Go to the next or the previous impact from the pointer.
  next(by) {
    const {impacts} = this.run, now = this.time();
    const later = impacts.findIndex(one => one.peak > now + 1e-9);
    const earlier = impacts.findLastIndex(one => one.peak < now - 1e-9);
    const number = by > 0 ? later : earlier;
    if (number < 0) {
      byId("mark").textContent = `No ${by > 0 ? "later" : "earlier"} impact.`;
      return;
    }
    this.open_mark("impacts", number);
  }

  // Open an impact down to its steps, or go to a dead centre.
  open_mark(kind, number) {
    const axis = this.run.x[this.curves.axis], {time} = this.run.x;
    const place = t => interpolated(1e3 * t, time, axis);
    if (kind === "ends") {
      const mark = this.run.ends[number];
      this.show_x(place(mark.at));
      byId("mark").textContent = `${mark.kind === "TDC" ? "Top" : "Bottom"} dead centre at ${
        inWords(1e3 * mark.at)} ms.`;
      return;
    }
    const mark = this.run.impacts[number], joint = this.run.scenery.joints
      .find(one => one.name === mark.joint);
    const about = Math.min(mark.to - mark.from, 4 * (mark.peak - mark.from) + 1e-4) + 1e-6;
    this.curves.zoom(place(mark.from - about), place(mark.from + 2 * about));
    this.put(place(mark.peak));
    byId("mark").textContent = `Impact ${number + 1} of ${this.run.impacts.length}: ${joint.label}, ` +
      `touching from ${inWords(1e3 * mark.from)} to ${inWords(1e3 * mark.to)} ms, ` +
      `largest force ${inWords(mark.force / 1e3)} kN at ${inWords(1e3 * mark.peak)} ms.`;
  }

  time() { return interpolated(this.x, this.run.x[this.curves.axis], this.run.seconds); }

  toggle() {
    this.playing = !this.playing;
    byId("play").textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) { this.seen = null; this.redraw(); return; }
    let last = performance.now();
    const tick = now => {
      if (!this.playing) return;
      const {start, end} = this.curves.range, seconds = Number(byId("speed").value);
      let x = this.x + (end - start) * (now - last) / 1e3 / seconds;
      last = now;
      if (x > end || x < start) { x = start; this.seen = null; }
      this.put(x);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  // Put the pointer somewhere on the axis.
  put(x) {
    const axis = this.run.x[this.curves.axis];
    this.x = Math.min(Math.max(x, axis[0]), axis[axis.length - 1]);
    this.redraw();
  }

  // The range has changed: the slider covers what is shown.
  follow() {
    const {start, end} = this.curves.range, slider = byId("slider");
    slider.min = start;
    slider.max = end;
    slider.value = this.x;
    this.curves.point(this.x);
  }

  redraw() {
    if (!this.mechanism || !this.joints) return;
    const axis = this.run.x[this.curves.axis], [place, share] = locate(axis, this.x);
    const since = this.playing && this.seen !== null ? this.seen + 1 : place;
    this.seen = this.playing ? place : null;
    this.curves.point(this.x);
    this.mechanism.show(place, share, since);
    for (const joint of this.joints) joint.show(place, share, since);
    this.surfaces.show(place, share);
    const milliseconds = at(this.run.x.time, place, share), degrees = at(this.run.x.angle, place, share);
    const words = `${inWords(milliseconds)} ms, crank ${degrees.toFixed(2)}°`;
    byId("clock").textContent = words;
    const slider = byId("slider");
    slider.value = this.x;
    slider.setAttribute("aria-valuetext", words);
    document.documentElement.dataset.time = String(milliseconds);
  }
}

open(() => new Player(JSON.parse(byId("page-data").textContent)).open());
