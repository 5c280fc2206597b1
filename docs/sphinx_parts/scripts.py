"""The gallery: every file of scripts/ as a page, with what it prints and the pictures it saves."""

import ast
import re
from pathlib import Path
from shutil import copy, rmtree
from typing import Any

from PIL import Image, ImageDraw

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "out" / "gallery"
NUMBERS = ROOT / "out" / "gallery_numbers.png"
"""Stands for scripts that end in numbers."""

LEFT_OUT = (
    "ablation",
    "benchmark_",
    "calibrate_",
    "dry_press_",
    "exudyn_",
    "fit_",
    "tabulate_",
    "flexible_",
    "six_bar_rod",
    "page_",
    "paper",
    "precision",
    "press_work_",
    "stability",
)
"""Beginnings of scripts that take minutes, need files beside them, or overwrite what the package
ships."""

HEAD = """Scripts
=======

One job each, on the library alone, as they lie in ``scripts/``. Here they ran in the reduced form
of ``--quick`` where they have one; without it they do the whole job. ``scripts/`` holds some
more, which measure run times or make what the package ships (film table, shapes of the crank).
"""


def gallery_sources() -> Path:
    """Return a directory with the scripts, each with the title that Sphinx-Gallery wants."""
    rmtree(SOURCES, ignore_errors=True)
    SOURCES.mkdir(parents=True)
    numbers = Image.new("RGB", (400, 280), "white")
    ImageDraw.Draw(numbers).text((70, 110), "prints numbers", fill="#555555", font_size=40)
    numbers.save(NUMBERS)
    (SOURCES / "GALLERY_HEADER.rst").write_text(HEAD, encoding="utf-8")
    for script in sorted((ROOT / "scripts").glob("*.py")):
        if script.name.startswith(LEFT_OUT):
            continue
        text = script.read_text(encoding="utf-8")
        told = ast.get_docstring(ast.parse(text)) or script.stem
        told = re.sub(r"Run with: (.+)", r"Run with: ``\1``", told)
        code = text.split('"""', 2)[2]
        title = script.stem
        page = "\n".join(['"""', title, "=" * len(title), "", told, '"""'])
        (SOURCES / script.name).write_text(page + code, encoding="utf-8")
    return SOURCES


def quick(gallery_conf: dict[str, Any], script_vars: dict[str, Any]) -> list[str]:
    """Return the arguments that a script gets here."""
    return ["--quick"] if "--quick" in Path(script_vars["src_file"]).read_text("utf-8") else []


class SavedPictures:
    """Collects the pictures that a script saved below out/."""

    def __init__(self) -> None:
        """Nothing is seen yet."""
        self.seen: set[Path] = set()

    def __repr__(self) -> str:
        """The same every time, so that nothing is rebuilt for it."""
        return "SavedPictures"

    def __call__(self, block: Any, block_vars: dict[str, Any], gallery_conf: Any) -> str:
        """Return the pictures' part of the page."""
        from sphinx_gallery.scrapers import figure_rst

        folder = Path(block_vars["src_file"]).parent / "out"
        new = [p for p in sorted(folder.rglob("*.png")) if p not in self.seen]
        self.seen.update(new)
        names = []
        for picture in new:
            names.append(next(block_vars["image_path_iterator"]))
            copy(picture, names[-1])
        return figure_rst(names, gallery_conf["src_dir"]) if names else ""
