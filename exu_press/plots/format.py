"""How pictures are drawn: file format, width on paper, style file; for one command or block."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import FORMATS

__all__ = ["PictureFormat", "drawn_as", "picture_format"]

UNITS = {"mm": 1.0 / 25.4, "cm": 1.0 / 2.54, "in": 1.0}
"""Units of a width -> inch."""

NARROWEST, WIDEST = 2.0, 20.0
"""Widths, inch."""

ONE_COLUMN = 5.2
"""inch; panels of a narrower figure stand below each other."""


@dataclass(frozen=True)
class PictureFormat:
    """How pictures are drawn.

    Attributes:
        ending: of their files.
        width: of a figure on paper, inch; None: as a screen shows it.
        style: a matplotlib style file, whose settings go before ours; or None.
        everything: whether all pictures of a run are drawn, beside those of its motion and forces.
    """

    ending: str = FORMATS[0]
    width: float | None = None
    style: Path | None = None
    everything: bool = False

    @classmethod
    def from_texts(
        cls, form: str, width: str | None, style: str | None, pictures: str
    ) -> "PictureFormat":
        """Return what the options of a command mean.

        Args:
            form: png, svg or pdf.
            width: with its unit, as in 84mm.
            style: path of a style file.
            pictures: "default" or "all".

        Raises:
            InputError: one of them is not allowed.
        """
        ending = f".{form.removeprefix('.').lower()}"
        if ending not in FORMATS:
            allowed = ", ".join(known.removeprefix(".") for known in FORMATS)
            raise InputError(f"--format {form}: allowed are {allowed}")
        path = None if style is None else Path(style)
        if path is not None and not path.is_file():
            raise InputError(f"--style {style}: no such file; allowed is a matplotlib style file")
        return cls(ending, None if width is None else _inches(width), path, pictures == "all")

    @property
    def stacks(self) -> bool:
        """Return whether panels stand below each other."""
        return self.width is not None and self.width < ONE_COLUMN


def _inches(text: str) -> float:
    unit = text[-2:]
    try:
        width = float(text[:-2]) * UNITS[unit]
    except (ValueError, KeyError):
        raise InputError(f"--width {text}: allowed is a number with mm, cm or in") from None
    if not NARROWEST <= width <= WIDEST:
        raise InputError(f"--width {text}: allowed are {NARROWEST:g} to {WIDEST:g} inch")
    return width


_FORMAT: ContextVar[PictureFormat] = ContextVar("format")


def picture_format() -> PictureFormat:
    """Return how pictures are drawn here."""
    return _FORMAT.get(PictureFormat())


@contextmanager
def drawn_as(chosen: PictureFormat) -> Iterator[None]:
    """Draw the pictures of a block in a format."""
    token = _FORMAT.set(chosen)
    try:
        yield
    finally:
        _FORMAT.reset(token)
