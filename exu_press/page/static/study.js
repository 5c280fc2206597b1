// A study: its runs as points, as lines over all keys, and in the table; one of them opens everywhere.

const PALE_TO_DARK = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#9fda3a"];
const GROUPS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];

// So many points are drawn small.
const MANY = 3000;

// Over all keys, of many runs, so many lines are drawn, evenly chosen.
const MOST_LINES = 1500;

// A text that the library takes as it stands: two dollars would begin a formula.
const asText = text => String(text).replaceAll("$$", "$\u200b$");

class Study {
  constructor(data) {
    this.data = data;
    this.columns = new Map();
    this.kept = new Map();  // column -> [low, high] of the runs that stay, 0 to 1
    this.chosen = null;
  }

  async open() {
    const {data} = this;
    const roots = Object.fromEntries(data.roots.map((id, k) => [id, ["points", "parallel"][k]]));
    const views = await Bokeh.embed.embed_items(data.documents,
      [{docid: "page", root_ids: data.roots, roots}]);
    this.document = Bokeh.documents[0];
    for (const column of data.columns) {
      const values = await block(column.values);
      const numbers = values.filter(v => isFinite(v));
      const least = numbers.reduce((a, b) => Math.min(a, b), Infinity);
      const largest = numbers.reduce((a, b) => Math.max(a, b), -Infinity);
      this.columns.set(column.name, {
        ...column, values, least, largest,
        different: [...new Set(numbers)].sort((a, b) => a - b),
        low: column.low ? await block(column.low) : values,
        high: column.high ? await block(column.high) : values,
      });
    }
    this.count = data.told.length;
    this.points = this.model("points");
    this.parallel = this.model("parallel");
    this.pointsView = views[0].get_by_id(this.points.id);
    this.parallelView = views[0].get_by_id(this.parallel.id);
    this.choices();
    this.listen();
    follow(dark => {
      const ink = paintFigure(this.points, dark);
      paintFigure(this.parallel, dark);
      this.model("parallel-labels").glyph.text_color = {value: ink};
    });
    if (this.count > MANY) {
      for (const name of ["runs", "others"]) this.model(`glyphs-${name}`).glyph.size = {value: 2};
    }
    byId("keys-beside").hidden = data.side.length < 3;
    this.axes();
    this.whole();
    this.table();
  }

  model(name) { return this.document.get_model_by_name(name); }

  choices() {
    for (const [name, none] of [["across", false], ["up", false], ["colour", true]]) {
      const select = byId(name);
      if (none) select.append(element("option", {value: ""}, "one for all"));
      for (const column of this.data.columns) {
        select.append(element("option", {value: column.name}, column.head));
      }
    }
    byId("across").value = this.data.across;
    byId("up").value = this.data.up;
    byId("colour").value = this.data.colour;
  }

  get across() { return this.columns.get(byId("across").value); }

  get up() { return this.columns.get(byId("up").value); }

  // Return a value on an axis that may be logarithmic.
  scaled(value, log) { return log ? (value > 0 ? Math.log10(value) : NaN) : value; }

  colour(run) {
    const column = this.columns.get(byId("colour").value);
    if (!column) return GROUPS[0];
    const value = column.values[run];
    if (!isFinite(value)) return "#888888";
    const {different} = column;
    if (column.texts.length || different.length <= GROUPS.length) {
      return GROUPS[different.indexOf(value) % GROUPS.length];
    }
    const share = (value - column.least) / (column.largest - column.least || 1);
    return PALE_TO_DARK[Math.min(Math.floor(share * PALE_TO_DARK.length), PALE_TO_DARK.length - 1)];
  }

  // Return a value of a column in words.
  words(column, run) {
    const value = column.values[run];
    if (!isFinite(value)) return "-";
    return column.texts.length ? column.texts[value] : inWords(value);
  }

  stays(run) {
    for (const [name, [low, high]] of this.kept) {
      const share = this.share(this.columns.get(name), run);
      if (!(share >= low - 1e-9 && share <= high + 1e-9)) return false;
    }
    return true;
  }

  share(column, run) {
    const width = column.largest - column.least;
    return width > 0 ? (column.values[run] - column.least) / width : 0.5;
  }

  // Fill both figures.
  fill() {
    const {across, up} = this, logX = byId("log-x").checked, logY = byId("log-y").checked;
    const runs = Array.from({length: this.count}, (_, run) => run);
    const groups = {
      runs: runs.filter(run => this.stays(run)), others: runs.filter(run => !this.stays(run)),
      chosen: this.chosen === null ? [] : [this.chosen],
    };
    this.x = runs.map(run => this.scaled(across.values[run], logX));
    this.y = runs.map(run => this.scaled(up.values[run], logY));
    const side = this.data.side.map(name => this.columns.get(name));
    for (const [group, members] of Object.entries(groups)) {
      const drawn = members.filter(run => isFinite(this.x[run]) && isFinite(this.y[run]));
      const end = (values, run) => values === up.values ? NaN : this.scaled(values[run], logY);
      this.model(`points-${group}`).data = {
        x: drawn.map(run => this.x[run]), y: drawn.map(run => this.y[run]),
        low: drawn.map(run => end(up.low, run)), high: drawn.map(run => end(up.high, run)),
        colour: drawn.map(run => this.colour(run)),
      };
      const every = Math.ceil(members.length / MOST_LINES);
      const lines = members.filter((_, k) => k % every === 0);
      this.model(`lines-${group}`).data = {
        xs: lines.map(() => side.map((_, k) => k)),
        ys: lines.map(run => side.map(column => this.share(column, run))),
        colour: lines.map(run => this.colour(run)),
      };
    }
    const marked = [...this.kept].map(([name, range]) => [this.data.side.indexOf(name), ...range]);
    this.model("parallel-kept").data = {
      x: marked.map(one => one[0]), low: marked.map(one => one[1]), high: marked.map(one => one[2]),
    };
    document.documentElement.dataset.kept = String(groups.runs.length);
    this.legend();
  }

  // Say what the colours are.
  legend() {
    const column = this.columns.get(byId("colour").value), legend = byId("legend");
    legend.replaceChildren();
    if (!column) return;
    const {different} = column;
    const few = column.texts.length || different.length <= GROUPS.length;
    const shown = few ? different : [different[0], different.at(-1)];
    for (const value of shown) {
      const run = column.values.indexOf(value);
      const one = element("span", {class: "value"}, this.words(column, run));
      one.style.setProperty("--run", this.colour(run));
      legend.append(one);
    }
    if (!few) legend.append(element("span", {}, "least and largest"));
  }

  // Draw the parallel axes with their names and ends.
  axes() {
    const side = this.data.side.map(name => this.columns.get(name)), x = [], y = [], text = [], align = [];
    const inwards = k => k === 0 ? "left" : k === side.length - 1 ? "right" : "center";
    side.forEach((column, k) => {
      const last = name => name.split(".").slice(-2).join(".");
      const end = value => column.texts.length ? column.texts[value] ?? "" : inWords(value);
      const label = last(column.name);
      x.push(k, k, k);
      y.push(k % 2 ? 1.185 : 1.12, 1.045, -0.05);
      text.push(asText(label), asText(end(column.largest)), asText(end(column.least)));
      align.push(inwards(k), "center", "center");
    });
    this.model("parallel-words").data = {x, y, text, align};
    this.model("parallel-axes").data = {
      x: side.map((_, k) => k), low: side.map(() => 0), high: side.map(() => 1),
    };
    this.model("parallel-x").setv({start: -0.5, end: side.length - 0.5});
  }

  // Show all points.
  whole() {
    this.fill();
    for (const [name, values] of [["points-x", this.x], ["points-y", this.y]]) {
      const known = values.filter(v => isFinite(v));
      let low = known.reduce((a, b) => Math.min(a, b), Infinity);
      let high = known.reduce((a, b) => Math.max(a, b), -Infinity);
      if (!(high >= low)) [low, high] = [0, 1];
      const margin = 0.06 * (high - low) || 0.06 * Math.abs(high) || 1;
      this.model(name).setv({start: low - margin, end: high + margin});
    }
    this.ticks();
  }

  // Say what stands at the axes: powers of ten, names of kinds, or numbers as they are.
  ticks() {
    for (const [axis, column, log, range] of [
      [this.points.below[0], this.across, byId("log-x").checked, this.model("points-x")],
      [this.points.left[0], this.up, byId("log-y").checked, this.model("points-y")],
    ]) {
      axis.axis_label = asText(column.head);
      this.own ??= new Map();
      if (!this.own.has(axis)) this.own.set(axis, axis.ticker);
      const labels = new Map();
      if (log) {
        for (let power = Math.floor(range.start); power <= range.end + 1; power++) {
          for (const part of range.end - range.start < 1.5 ? [1, 2, 3, 5, 7] : [1]) {
            labels.set(power + Math.log10(part), inWords(part * 10 ** power));
          }
        }
      } else column.texts.forEach((text, k) => labels.set(k, asText(text)));
      if (!labels.size) axis.setv({ticker: this.own.get(axis), major_label_overrides: labels});
      else {
        const Ticker = Bokeh.Models.get("FixedTicker");
        axis.setv({ticker: new Ticker({ticks: [...labels.keys()]}), major_label_overrides: labels});
      }
    }
  }

  listen() {
    for (const name of ["across", "up", "log-x", "log-y"]) {
      byId(name).addEventListener("change", () => this.whole());
    }
    byId("colour").addEventListener("change", () => this.fill());
    byId("whole").addEventListener("click", () => this.whole());
    byId("clear").addEventListener("click", () => { this.kept.clear(); this.fill(); });
    byId("drag").addEventListener("change", event => {
      this.points.toolbar.active_drag = this.model(`${event.target.value}-points`);
    });
    for (const name of ["points-x", "points-y"]) {
      this.model(name).change.connect(() => {
        if (byId("log-x").checked || byId("log-y").checked) {
          clearTimeout(this.waiting);
          this.waiting = setTimeout(() => this.ticks(), 50);
        }
      });
    }
    const points = byId("points");
    points.addEventListener("mousemove", event => {
      const run = this.nearest(event);
      byId("near").textContent = run === null ? "" : `run ${run}: ${this.across.head} = ${
        this.words(this.across, run)}; ${this.up.head} = ${this.words(this.up, run)}`;
    });
    points.addEventListener("click", event => {
      const run = this.nearest(event);
      if (run !== null) this.choose(run);
    });
    points.addEventListener("dblclick", () => this.whole());
    this.brush();
  }

  // Return the run whose point is next to the pointer, null if none is near.
  nearest(event) {
    const box = byId("points").getBoundingClientRect(), {frame} = this.pointsView;
    const px = event.clientX - box.left, py = event.clientY - box.top;
    let best = 14 ** 2, found = null;
    for (let run = 0; run < this.count; run++) {
      if (!isFinite(this.x[run]) || !isFinite(this.y[run])) continue;
      const dx = frame.x_scale.compute(this.x[run]) - px;
      const dy = frame.y_scale.compute(this.y[run]) - py;
      if (dx * dx + dy * dy < best) { best = dx * dx + dy * dy; found = run; }
    }
    return found;
  }

  // Choose ranges along the parallel axes; a click opens the nearest line.
  brush() {
    const target = byId("parallel"), {frame} = this.parallelView;
    const place = event => {
      const box = target.getBoundingClientRect();
      return [frame.x_scale.invert(event.clientX - box.left),
        frame.y_scale.invert(event.clientY - box.top)];
    };
    let begun = null;
    target.addEventListener("pointerdown", event => {
      begun = place(event);
      target.setPointerCapture(event.pointerId);
    });
    target.addEventListener("pointermove", event => {
      if (!begun) return;
      const [, y] = place(event), axis = Math.round(begun[0]);
      if (Math.abs(y - begun[1]) < 0.02 || !this.data.side[axis]) return;
      this.kept.set(this.data.side[axis], [Math.min(y, begun[1]), Math.max(y, begun[1])]);
      this.fill();
    });
    target.addEventListener("pointerup", event => {
      if (!begun) return;
      const [x, y] = place(event), moved = Math.abs(y - begun[1]) >= 0.02;
      begun = null;
      if (moved) return;
      const left = Math.min(Math.max(Math.floor(x), 0), Math.max(this.data.side.length - 2, 0));
      const [a, b] = [left, Math.min(left + 1, this.data.side.length - 1)]
        .map(k => this.columns.get(this.data.side[k]));
      let best = 0.05, found = null;
      for (let run = 0; run < this.count; run++) {
        if (!this.stays(run)) continue;
        const at = this.share(a, run) + (x - left) * (this.share(b, run) - this.share(a, run));
        if (Math.abs(at - y) < best) { best = Math.abs(at - y); found = run; }
      }
      if (found !== null) this.choose(found);
    });
  }

  // Make the rows of the table open their runs.
  table() {
    this.rows = [...document.querySelectorAll("#runs tbody tr")];
    this.rows.forEach((row, run) => {
      const head = row.firstElementChild, button = element("button", {type: "button"}, head.textContent);
      head.replaceChildren(button);
      row.addEventListener("click", () => this.choose(run));
    });
  }

  // Open a run: in the picture, over the keys, in the table, and in words.
  choose(run) {
    this.chosen = run;
    this.fill();
    this.rows.forEach((row, k) => row.classList.toggle("chosen", k === run));
    const words = element("p", {}, `Run ${run}`), list = element("dl", {class: "values-of-run"});
    for (const column of this.columns.values()) {
      list.append(element("dt", {}, column.head), element("dd", {}, this.words(column, run)));
    }
    byId("chosen").replaceChildren(words, element("code", {}, this.data.told[run]), list);
    document.documentElement.dataset.chosen = String(run);
  }
}

open(() => new Study(JSON.parse(byId("page-data").textContent)).open());
