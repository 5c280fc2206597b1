"""The live part of a page: the library, our script, data as text that no browser runs."""

import base64
import hashlib
import html
import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from exu_press.installation.versions import version_of
from exu_press.plots.typesetting import typeset
from fe_models.array_file import cache_folder, load_arrays, save_arrays

__all__ = [
    "Live",
    "cached_figures",
    "data_element",
    "document_of",
    "escape",
    "has_library",
    "scripts",
    "styles",
]

HERE = Path(__file__).parent / "static"


@dataclass(frozen=True)
class Live:
    """A part of a page with scripts.

    Attributes:
        body: HTML, with the data in it.
        scripts: that the browser runs, in this order, and no others.
        style: CSS.
    """

    body: str
    scripts: Sequence[str]
    style: str

    @property
    def policy(self) -> str:
        """The page's content security policy: these scripts alone, and no request to anywhere."""
        hashes = [base64.b64encode(hashlib.sha256(s.encode()).digest()) for s in self.scripts]
        allowed = " ".join(f"'sha256-{digest.decode()}'" for digest in hashes)
        return (
            f"default-src 'none'; script-src {allowed}; style-src 'unsafe-inline'; "
            "img-src data: blob:; font-src data:; form-action 'none'; base-uri 'none'"
        )


def escape(text: str) -> str:
    """Return a text as HTML has it, with the signs that units are printed with."""
    return html.escape(typeset(text))


def has_library() -> bool:
    """Return whether the extra `page` is installed."""
    return find_spec("bokeh") is not None


def document_of(figures: Sequence[Any]) -> dict[str, Any]:
    """Return figures of Bokeh as the page's data have them: their document, ids and names."""
    from bokeh.document import Document

    document = Document()
    with document.models.freeze():  # models are collected once, not once a figure
        for figure in figures:
            document.add_root(figure)
    return {
        "documents": {"page": document.to_json(deferred=False)},
        "roots": [figure.id for figure in figures],
        "names": [figure.name for figure in figures],
    }


def cached_figures(function: str, *arguments: Any) -> dict[str, Any]:
    """Return the document of a function of `exu_press.page.figures`, from a cache on disk.

    Its empty figures are the same in every page; to load Bokeh and make them takes two seconds.
    """
    source = Path(__file__).with_name("figures.py").read_text(encoding="utf-8")
    made_of = json.dumps([function, arguments, version_of("bokeh"), source])
    digest = hashlib.sha256(made_of.encode()).hexdigest()
    file = cache_folder("pages") / f"{function}-{digest[:32]}.npz"
    stored = load_arrays(file)
    if stored is not None:
        document: dict[str, Any] = json.loads(bytes(stored["text"]))
        return document
    document = getattr(import_module("exu_press.page.figures"), function)(*arguments)
    text = np.frombuffer(json.dumps(document).encode(), dtype=np.uint8)
    with suppress(OSError):  # the next page makes them again
        save_arrays({"text": text}, file)
    return document


@cache
def _library() -> str:
    package = find_spec("bokeh")
    assert package is not None and package.origin is not None
    path = Path(package.origin).parent / "server" / "static" / "js" / "bokeh.min.js"
    return _inline(path.read_text(encoding="utf-8"))


def scripts(*names: str) -> list[str]:
    """Return the library and our own script, made of files of this package."""
    parts = "\n".join((HERE / f"{name}.js").read_text(encoding="utf-8") for name in names)
    return [_library(), _inline(f'"use strict";\n(() => {{\n{parts}\n}})();\n')]


@cache
def styles() -> str:
    """Return the styles of live parts."""
    return (HERE / "page.css").read_text(encoding="utf-8")


def data_element(name: str, data: Any) -> str:
    """Return data as an element of the page; no text in it can end the element.

    >>> data_element("a", "</script>")
    '<script type="application/json" id="a">"\\\\u003c/script>"</script>'
    """
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for letter, code in (("<", "\\u003c"), ("\u2028", "\\u2028"), ("\u2029", "\\u2029")):
        text = text.replace(letter, code)
    return f'<script type="application/json" id="{name}">{text}</script>'


def _inline(script: str) -> str:
    """Return a script that can stand inside a page."""
    return script.replace("</script", "<\\/script").replace("<!--", "<\\!--")
