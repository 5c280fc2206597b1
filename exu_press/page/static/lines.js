// Curves that zoom each by itself.

async function lines() {
  const data = JSON.parse(byId("page-data").textContent);
  const roots = Object.fromEntries(data.roots.map((id, k) => [id, `lines-${k}`]));
  const [views] = await Bokeh.embed.embed_items(data.documents,
    [{docid: "page", root_ids: data.roots, roots}]);
  data.roots.forEach((id, k) => {
    const view = views.get_by_id(id), target = byId(`lines-${k}`);
    follow(dark => paintFigure(view.model, dark));
    target.addEventListener("dblclick", () => view.reset());
    target.addEventListener("mousemove", event => {
      const box = target.getBoundingClientRect(), {x_scale, y_scale} = view.frame;
      const x = x_scale.invert(event.clientX - box.left), y = y_scale.invert(event.clientY - box.top);
      byId(`at-${k}`).textContent = `at ${inWords(x)}, ${inWords(y)}`;
    });
  });
}

open(lines);
