// Curves over one axis: panels of the library, filled for the range that is shown.

class Curves {
  constructor(data, told) {
    this.data = data;
    this.told = told;  // called with x when the pointer is put somewhere
    this.axis = "time";
    this.panels = [];
    this.units = new Map();
    for (const group of data.groups) for (const one of group.curves) this.units.set(one.name, one);
  }

  async open() {
    const {data} = this;
    const roots = Object.fromEntries(data.roots.map((id, number) => [id, `figure-${number}`]));
    data.names.forEach((name, number) => {
      const strip = name === "marks";
      const panel = strip ? byId("strip") : this.head(number);
      const target = element("div", {id: `figure-${number}`, class: "figure"});
      const cursor = element("div", {class: "cursor"});
      const plot = element("div", {class: "plot"});
      plot.append(target, cursor);
      panel.append(plot);
      this.panels.push({number, strip, panel, target, cursor, name: null, log: false});
      if (!strip) byId("panels").append(panel);
    });
    this.show(Math.min(data.first.length, data.names.length - 1));
    const views = await Bokeh.embed.embed_items(data.documents, [{docid: "page", root_ids: data.roots, roots}]);
    this.document = Bokeh.documents[0];
    for (const panel of this.panels) {
      panel.figure = this.model(data.names[panel.number]);
      panel.view = this.view(views, panel.figure);
      this.listen(panel);
    }
    this.range = this.model("x-range");
    this.range.change.connect(() => this.later());
    this.runs = data.runs;
    for (const run of this.runs) {
      const time = await block(run.time);
      run.x = {time: time.map(t => 1e3 * t), angle: await block(run.angle)};
      run.seconds = time;
    }
    for (const panel of this.panels) panel.figure.below[0].visible = panel.strip;
    follow(dark => this.colour(dark));
    this.fit();
    this.marks();
    for (const panel of this.shown) await this.choose(panel, panel.select.value);
    this.whole();
  }

  model(name) { return this.document.get_model_by_name(name); }

  view(views, figure) {
    for (const manager of views) {
      const found = manager.get_by_id ? manager.get_by_id(figure.id) : null;
      if (found) return found;
    }
    return Bokeh.index.get_by_id(figure.id);
  }

  get shown() { return this.panels.filter(panel => !panel.strip && !panel.panel.hidden); }

  get main() { return this.data.runs[this.mainRun ?? 0]; }

  get x() { return this.main.x[this.axis]; }

  // Return the head of a panel: which curve, log or linear, the values at the pointer.
  head(number) {
    const panel = element("div", {class: "panel", id: `panel-${number}`});
    const bar = element("div", {class: "bar head"});
    const select = element("select", {"aria-label": `curve ${number + 1}`});
    for (const group of this.data.groups) {
      const members = element("optgroup", {label: group.label});
      for (const one of group.curves) {
        const unit = one.unit ? `, ${one.unit}` : "";
        const words = group.label === "Mechanism" ? "" : `${group.label}: `;
        members.append(element("option", {value: one.name}, `${words}${one.label}${unit}`));
      }
      select.append(members);
    }
    const first = this.data.first[number] ?? this.data.first[0];
    select.value = first;
    const log = element("label");
    const box = element("input", {type: "checkbox", "aria-label": `curve ${number + 1}: log`});
    log.append(box, " log");
    const values = element("output", {class: "values"});
    bar.append(select, log, values);
    panel.append(bar);
    select.addEventListener("change", () => this.choose(this.panels[number], select.value));
    box.addEventListener("change", () => {
      this.panels[number].log = box.checked;
      this.fill(this.panels[number]);
    });
    queueMicrotask(() => Object.assign(this.panels[number], {select, values}));
    return panel;
  }

  // Show so many panels.
  show(count) {
    this.panels.filter(panel => !panel.strip).forEach((panel, number) => {
      panel.panel.hidden = number >= count;
    });
  }

  async more(change) {
    const count = Math.min(Math.max(this.shown.length + change, 1), this.panels.length - 1);
    this.show(count);
    this.fit();
    await Promise.all(this.shown.filter(p => p.name === null)
      .map(p => this.choose(p, p.select.value)));
    this.later();
  }

  async choose(panel, name) {
    panel.name = name;
    panel.target.setAttribute("role", "img");
    panel.target.setAttribute("aria-label", this.units.get(name).label);
    panel.curves = await Promise.all(this.data.runs.map(run => curve(run, name)));
    if (panel.name !== name) return;
    this.fill(panel);
    this.changed?.();
  }

  // Make the panels as high as the window has room for.
  fit() {
    const room = (innerHeight - 230) / Math.max(this.shown.length, 1) - 36;
    const height = Math.round(Math.min(Math.max(room, 100), 190));
    for (const panel of this.panels) if (!panel.strip) panel.figure.height = height;
  }

  // Fill all panels once before the next picture.
  later() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      for (const panel of this.shown) this.fill(panel);
      this.changed?.();
    });
  }

  // Fill a panel for the range that is shown.
  fill(panel) {
    if (!panel.curves || !this.range) return;
    const {start, end} = this.range, pixels = Math.max(200, Math.round(panel.view.frame.bbox.width));
    const {factor} = this.units.get(panel.name), n = panel.number;
    let least = Infinity, largest = -Infinity, tiniest = Infinity;
    this.data.runs.forEach((run, r) => {
      const x = run.x[this.axis], y = panel.curves[r];
      const drawn = y ? thin(x, y, start, end, pixels, factor, panel.log)
        : {x: [], y: [], least: Infinity, largest: -Infinity, tiniest: Infinity};
      this.model(`curve-${n}-${r}`).data = {x: drawn.x, y: drawn.y};
      least = Math.min(least, drawn.least);
      largest = Math.max(largest, drawn.largest);
      tiniest = Math.min(tiniest, drawn.tiniest);
      const [low, high] = this.peak(panel, run, r, factor);
      if (low <= high) {
        least = Math.min(least, low);
        largest = Math.max(largest, high);
      }
    });
    if (!(largest >= least)) [least, largest] = [0, 1];
    const scale = panel.log ? "log" : "linear";
    if (panel.log) {
      const bottom = Math.max(isFinite(tiniest) ? tiniest : largest / 10, largest * 1e-8) || 1e-12;
      this.model(`log-${n}`).setv({start: bottom / 1.5, end: Math.max(largest, bottom) * 2});
    } else {
      const margin = 0.08 * (largest - least) || 0.08 * Math.abs(largest) || 1;
      this.model(`linear-${n}`).setv({start: least - margin, end: largest + margin});
    }
    if (panel.scale !== scale) {
      panel.scale = scale;
      for (const one of [...panel.figure.renderers, ...panel.figure.center]) {
        if (one.tags?.[0] === "log" || one.tags?.[0] === "linear") one.visible = one.tags[0] === scale;
      }
      this.model(`linear-axis-${n}`).visible = !panel.log;
      this.model(`log-axis-${n}`).visible = panel.log;
    }
  }

  // Mark the peak that a quantity states, with its error; return its bounds where it is shown.
  peak(panel, run, r, factor) {
    const peak = run.peaks[panel.name];
    const source = this.model(`peak-${panel.number}-${r}`);
    const none = {x: [], y: [], low: [], high: [], left: [], right: []};
    if (!peak) { source.data = none; return [NaN, NaN]; }
    const x = interpolated(1e3 * peak.at, run.x.time, run.x[this.axis]);
    const sign = panel.log ? Math.sign(peak.value) || 1 : 1;
    const [a, b] = [peak.low ?? peak.value, peak.high ?? peak.value].map(v => sign * factor * v);
    const ends = run.x[this.axis];
    const low = Math.min(a, b), high = Math.max(a, b);
    source.data = {
      x: [x], y: [sign * factor * peak.value], low: [low], high: [high],
      left: [ends[0]], right: [ends[ends.length - 1]],
    };
    return x >= this.range.start && x <= this.range.end ? [low, high] : [NaN, NaN];
  }

  // Put impacts and dead centres of the main run into the strip.
  marks() {
    const {impacts, ends, horizon, settled} = this.main, {time} = this.main.x;
    const place = t => interpolated(1e3 * t, time, this.x);
    const numbers = list => list.map((_, k) => k);
    this.model("marks-impacts").data = {
      x: impacts.map(one => place(one.peak)), y: impacts.map(() => 0), mark: numbers(impacts),
    };
    this.model("marks-ends").data = {
      x: ends.map(one => place(one.at)), y: ends.map(() => 1), mark: numbers(ends),
    };
    for (const panel of this.panels.filter(p => !p.strip)) {
      const beyond = this.model(`horizon-${panel.number}`);
      beyond.visible = horizon !== null;
      if (horizon !== null) beyond.left = place(horizon);
      const start = this.model(`start-${panel.number}`);
      start.visible = settled > 0;
      if (settled > 0) start.right = place(settled);
    }
  }

  // Show a part of the axis.
  zoom(low, high) {
    const [begin, end] = this.ends(), least = (end - begin) * 1e-9;
    const width = Math.min(Math.max(high - low, least), end - begin);
    const start = Math.min(Math.max(low, begin), end - width);
    this.range.setv({start, end: start + width, bounds: null});
  }

  whole() { this.zoom(...this.ends()); }

  ends() {
    const all = this.data.runs.map(run => run.x[this.axis]);
    return [Math.min(...all.map(x => x[0])), Math.max(...all.map(x => x[x.length - 1]))];
  }

  // Zoom about a place by a factor.
  scale(factor, about) {
    const {start, end} = this.range;
    const middle = about >= start && about <= end ? about : (start + end) / 2;
    this.zoom(middle - factor * (middle - start), middle + factor * (end - middle));
  }

  shift(share) {
    const {start, end} = this.range, by = share * (end - start);
    this.zoom(start + by, end + by);
  }

  // Change the axis and keep what is shown.
  change(axis) {
    const from = this.x, shown = [this.range.start, this.range.end];
    this.axis = axis;
    for (const panel of this.panels) {
      const ticker = this.model(`ticker-${this.data.names[panel.number]}`);
      ticker.mantissas = axis === "angle" ? [1, 1.5, 3, 4.5, 9] : [1, 2, 5];
    }
    this.marks();
    this.zoom(...shown.map(x => interpolated(x, from, this.x)));
    this.later();
  }

  // Choose what dragging does: "zoom" or "pan".
  drag(how) {
    for (const panel of this.panels) {
      const name = this.data.names[panel.number];
      panel.figure.toolbar.active_drag = this.model(`${how}-${name}`);
    }
  }

  // Follow mouse, finger and clicks on a panel.
  listen(panel) {
    const place = event => {
      const box = panel.target.getBoundingClientRect(), {left, right} = panel.view.frame.bbox;
      const pixel = event.clientX - box.left;
      if (pixel < left || pixel > right) return null;
      return panel.view.frame.x_scale.invert(pixel);
    };
    const put = event => {
      const x = place(event);
      if (x !== null) this.told(x);
    };
    panel.target.addEventListener("mousemove", event => { if (!event.buttons) put(event); });
    panel.target.addEventListener("click", put);
    panel.target.addEventListener("dblclick", () => this.whole());
    if (!panel.strip) return;
    for (const kind of ["impacts", "ends"]) {
      const source = this.model(`marks-${kind}`);
      source.selected.properties.indices.change.connect(() => {
        const [first] = source.selected.indices;
        if (first === undefined) return;
        source.selected.indices = [];
        this.clicked?.(kind, first);
      });
    }
  }

  // Put the pointer's lines and values; x is on the axis of the main run.
  point(x) {
    for (const panel of this.panels) {
      if (panel.panel.hidden || !panel.view) continue;
      const {left, right} = panel.view.frame.bbox, pixel = panel.view.frame.x_scale.compute(x);
      const inside = pixel >= left - 1 && pixel <= right + 1;
      panel.cursor.style.visibility = inside ? "visible" : "hidden";
      panel.cursor.style.transform = `translateX(${pixel}px)`;
      if (panel.strip || !panel.curves) continue;
      const {unit, factor} = this.units.get(panel.name);
      const texts = this.data.runs.map((run, r) => {
        const y = panel.curves[r], axis = run.x[this.axis];
        if (!y || x < axis[0] - 1e-9 || x > axis[axis.length - 1] + 1e-9) return null;
        return factor * interpolated(x, axis, y);
      });
      this.values(panel, texts, unit);
    }
  }

  values(panel, texts, unit) {
    const many = this.data.runs.length > 1;
    while (panel.values.childElementCount < texts.length) {
      const one = element("span", {class: "value"});
      if (many) one.style.setProperty("--run", this.data.runs[panel.values.childElementCount].colour);
      panel.values.append(one);
    }
    texts.forEach((value, r) => {
      panel.values.children[r].textContent = `${inWords(value)} ${unit}`;
    });
  }

  // Light or dark.
  colour(dark) {
    for (const {figure} of this.panels) {
      paintFigure(figure, dark);
      for (const one of figure.renderers) {
        if (one.tags?.length !== 3) continue;
        const {colour} = this.data.runs[one.tags[2]], shown = (dark && BRIGHT[colour]) || colour;
        if (one.glyph.line_color?.value) one.glyph.line_color = {value: shown};
      }
    }
  }
}
