"""The page of a run inside the site: run and written while the site is built."""

from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive

from exu_press import Scene, simulate
from exu_press.cli.options import scene_path
from exu_press.report.run_report import run_report

__all__ = ["setup"]

PAGES = {"press": ["film.law=finite", "film.viscosity=0.1"]}
"""Name of a page -> what is set in the shipped scene of the press."""


def setup(app: Any) -> dict[str, Any]:
    """Add the directive, and write the pages at the end."""
    app.add_directive("live-page", LivePage)
    app.connect("build-finished", write_pages)
    return {"parallel_read_safe": True}


class LivePage(Directive):
    """The page of one of PAGES, in a frame of its own."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the frame, and a link to the page alone."""
        name = self.arguments[0]
        if name not in PAGES:
            raise self.error(f"live-page {name}: allowed is one of {', '.join(PAGES)}")
        document = self.state.document.settings.env.docname
        up = "../" * document.count("/")
        address = f"{up}live/{name}.html"
        frame = (
            f'<iframe class="live-page" src="{address}" title="the page of a run" loading="lazy">'
            f'</iframe><p><a href="{address}">The page alone, in the whole window</a></p>'
        )
        return [nodes.raw("", frame, format="html")]


def write_pages(app: Any, exception: Exception | None) -> None:
    """Run the scenes and write their pages beside the site's."""
    if exception is not None or app.builder.format != "html":
        return
    folder = Path(app.outdir) / "live"
    folder.mkdir(exist_ok=True)
    for name, changes in PAGES.items():
        scene = Scene.load(scene_path("press"), changes)
        text = run_report(simulate(scene), "exu-press run press")
        (folder / f"{name}.html").write_text(text, encoding="utf-8")
