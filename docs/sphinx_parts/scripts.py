"""The gallery: every script of scripts/gallery/ as a page, with what it prints."""

import ast
from pathlib import Path
from shutil import rmtree

from PIL import Image, ImageDraw

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "out" / "gallery"
NUMBERS = ROOT / "out" / "gallery_numbers.png"
"""Stands for scripts that end in numbers."""

HEAD = """Gallery
=======

One question each, in at most 40 lines on the library alone, as they lie in ``scripts/gallery/``.
The numbers are those that they printed when this site was built; a test holds them.
"""


def gallery_sources() -> Path:
    """Return a directory with the scripts, each with the title that Sphinx-Gallery wants."""
    rmtree(SOURCES, ignore_errors=True)
    SOURCES.mkdir(parents=True)
    numbers = Image.new("RGB", (400, 280), "white")
    ImageDraw.Draw(numbers).text((70, 110), "prints numbers", fill="#555555", font_size=40)
    numbers.save(NUMBERS)
    (SOURCES / "GALLERY_HEADER.rst").write_text(HEAD, encoding="utf-8")
    for script in sorted((ROOT / "scripts" / "gallery").glob("*.py")):
        text = script.read_text(encoding="utf-8")
        docstring = ast.get_docstring(ast.parse(text)) or script.stem
        code = text.split('"""', 2)[2]
        title, _, rest = docstring.partition("\n")
        title = title.rstrip(".")
        page = "\n".join(['"""', title, "=" * len(title), rest, '"""'])
        (SOURCES / script.name).write_text(page + code, encoding="utf-8")
    return SOURCES
