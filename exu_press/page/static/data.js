// Data of the page: arrays are unpacked when they are first asked for.

const byId = name => document.getElementById(name);

function element(kind, attributes = {}, text = "") {
  const made = document.createElement(kind);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

const KINDS = {f4: Float32Array, f8: Float64Array, u4: Uint32Array, i2: Int16Array};

// Return the numbers of a block, column after column.
async function unpack(block) {
  const text = atob(byId(block.id).textContent);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const ordered = new Uint8Array(await new Response(stream).arrayBuffer());
  const Kind = KINDS[block.kind], size = Kind.BYTES_PER_ELEMENT, count = ordered.length / size;
  const bytes = new Uint8Array(ordered.length);
  for (let part = 0; part < size; part++) {
    const from = part * count;
    for (let i = 0; i < count; i++) bytes[i * size + part] = ordered[from + i];
  }
  return new Kind(bytes.buffer);
}

const unpacked = new Map();

function block(spec) {
  if (!unpacked.has(spec.id)) unpacked.set(spec.id, unpack(spec));
  return unpacked.get(spec.id);
}

// Return the columns of a run's channel, each an array; null where it has no such channel.
async function channel(run, name) {
  const spec = run.channels[name];
  if (!spec) return null;
  const all = await block(spec);
  return Array.from({length: spec.columns}, (_, k) =>
    all.subarray(k * spec.rows, (k + 1) * spec.rows));
}

// Return a curve of a run in SI units, null where the run does not have it.
async function curve(run, name) {
  const recipe = run.curves[name];
  if (!recipe) return null;
  run.made ??= new Map();
  if (run.made.has(name)) return run.made.get(name);
  const all = await channel(run, recipe.channel), columns = recipe.columns.map(k => all[k]);
  const {offset, factor} = recipe;
  const values = new Float64Array(columns[0].length);
  for (let i = 0; i < values.length; i++) {
    let value = columns[0][i];
    if (columns.length === 2) value = Math.hypot(value, columns[1][i]);
    else if (columns.length > 2) value = Math.hypot(...columns.map(column => column[i]));
    values[i] = offset + factor * value;
  }
  run.made.set(name, values);
  return values;
}

// Return the last place in increasing values that is not later than x, at least 0.
function before(values, x) {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= x) low = middle + 1; else high = middle;
  }
  return Math.max(0, low - 1);
}

// Return a value between two places, linear.
function at(values, place, share) {
  const next = Math.min(place + 1, values.length - 1);
  return values[place] + share * (values[next] - values[place]);
}

// Return place and share of x in increasing values.
function locate(values, x) {
  const place = before(values, x), next = Math.min(place + 1, values.length - 1);
  const width = values[next] - values[place];
  return [place, width > 0 ? Math.min(1, Math.max(0, (x - values[place]) / width)) : 0];
}

function interpolated(x, values, place) {
  const [i, share] = locate(values, x);
  return at(place, i, share);
}

function inWords(value) {
  if (value === null || !isFinite(value)) return "-";
  return String(Number(value.toPrecision(6)));
}
