// Light and dark.

// Colours that are too dark for a dark page, and what they become.
const BRIGHT = {"#0072B2": "#4aa8e8", "#009E73": "#2fc79b", "#D55E00": "#f07f2e"};

// Give figures the page's colours now and whenever they change; return whether it is dark.
function follow(paint) {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", event => paint(event.matches));
  paint(dark.matches);
}

function paintFigure(figure, dark) {
  const [ground, ink, faint] = dark ? ["#15181c", "#d9dde1", "#30363d"]
    : ["#ffffff", "#1c1c1c", "#e3e3e3"];
  figure.setv({background_fill_color: ground, border_fill_color: ground, outline_line_color: faint});
  for (const axis of [...figure.below, ...figure.left]) {
    axis.setv({
      major_label_text_color: ink, axis_line_color: ink, major_tick_line_color: ink,
      minor_tick_line_color: faint, axis_label_text_color: ink,
    });
  }
  for (const grid of figure.center) {
    if (grid.type.endsWith("Grid")) grid.grid_line_color = faint;
  }
  return ink;
}

// Open a page: run what it does, and say so where it fails.
function open(work) {
  const began = performance.now();
  byId("viewer").hidden = false;
  work().then(() => {
    document.documentElement.dataset.ready = String(Math.round(performance.now() - began));
  }).catch(error => {
    console.error(error);
    const told = byId("failed");
    told.hidden = false;
    told.textContent = `The live part of this page cannot be shown (${error.message}). ` +
      "The pictures below show the same.";
    document.documentElement.classList.add("show-pictures");
  });
}
