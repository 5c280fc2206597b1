"""A page in a notebook's cell, as a file, or in the browser."""

import html
import webbrowser
from dataclasses import dataclass
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import check_writable, replacing

__all__ = ["ALL", "Page", "Span", "check_page", "open_file", "write_page"]

Span = tuple[float | None, float | None]
"""Begin and end, s; None: those of the record."""

ALL: Span = (None, None)


CELL = 900
"""Height of a page in a notebook's cell, pixels."""


@dataclass(frozen=True)
class Page:
    """A report as one HTML text; a notebook shows it.

    Attributes:
        text: HTML with everything in it.
    """

    text: str

    def save(self, path: str | Path) -> Path:
        """Write it as a file; an existing one is replaced when the new one is complete."""
        return write_page(self.text, Path(path))

    def _repr_html_(self) -> str:
        """Return the page in a frame of its own, apart from the notebook's scripts and styles."""
        inner = html.escape(self.text, quote=True)
        return (
            f'<iframe srcdoc="{inner}" style="width: 100%; height: {CELL}px; border: 0" '
            'sandbox="allow-scripts allow-downloads" title="exu_press"></iframe>'
        )

    def __repr__(self) -> str:
        return f"Page({len(self.text) / 1e6:.1f} MB; save(path) writes it)"


def write_page(text: str, target: Path) -> Path:
    """Write a page; see `check_page`."""
    check_page(target)
    with replacing(target) as partial:
        partial.write_text(text, encoding="utf-8")
    return target


def check_page(target: Path) -> None:
    """Raise InputError unless a page can be written under this name."""
    if target.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"--out {target}: allowed is a name ending in .html")
    check_writable(target)


def open_file(path: Path) -> None:
    """Open a page in the browser.

    Raises:
        InputError: there is no browser that can be opened from here.
    """
    try:
        opened = webbrowser.open(path.resolve().as_uri())
    except webbrowser.Error:
        opened = False
    if not opened:
        raise InputError(
            f"view: no browser can be opened here; open {path} in one, "
            "or use --save FILE.mp4, FILE.gif or FILE.png"
        )
