// Which points of a curve to draw: first, lowest, highest and last in every pixel, which covers the
// same pixels as all of them (M4: Jugel et al., Proc. VLDB Endowment 7 (2014) 797-808).

// Return x and y of what is drawn between two values of x, and the least and largest y in between.
function thin(x, y, low, high, pixels, factor, positive) {
  const first = before(x, low), last = Math.min(before(x, high) + 1, x.length - 1);
  const shown = i => positive ? (y[i] ? Math.abs(y[i] * factor) : NaN) : y[i] * factor;
  const xs = [], ys = [];
  let least = Infinity, largest = -Infinity, tiniest = Infinity;
  const push = i => { xs.push(x[i]); ys.push(shown(i)); };
  const count = value => {
    if (value < least) least = value;
    if (value > largest) largest = value;
  };
  for (const edge of [low, high]) {
    const value = factor * interpolated(edge, x, y);
    if (edge >= x[0] && edge <= x[x.length - 1]) count(positive ? Math.abs(value) || NaN : value);
  }
  for (let i = first; i <= last; i++) {
    if (x[i] < low || x[i] > high) continue;
    const value = shown(i);
    count(value);
    if (value > 0 && value < tiniest) tiniest = value;
  }
  if (last - first <= 4 * pixels) {
    for (let i = first; i <= last; i++) push(i);
  } else {
    const width = (high - low) / pixels;
    for (let i = first; i <= last;) {
      const bin = Math.floor((x[i] - low) / width);
      let lowest = i, highest = i, end = i;
      while (end <= last && Math.floor((x[end] - low) / width) === bin) {
        if (y[end] < y[lowest]) lowest = end;
        if (y[end] > y[highest]) highest = end;
        end += 1;
      }
      const kept = [...new Set([i, lowest, highest, end - 1])].sort((a, b) => a - b);
      kept.forEach(push);
      i = end;
    }
  }
  return {x: xs, y: ys, least, largest, tiniest};
}
