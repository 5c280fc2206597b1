"""Texts in columns, as a terminal shows them, and notes about texts wider than their column."""

import re
from collections.abc import Iterable, Sequence

__all__ = ["Notes", "columns"]


def columns(
    rows: Iterable[Sequence[str]], indent: int = 0, *, right: bool = False, gap: int = 2
) -> list[str]:
    """Return rows of equally many cells as lines, their columns under each other.

    A heading, a row with its first cell alone, may be wider than the first column.

    Args:
        rows: the head's first, if there is one.
        right: whether the columns but for the first one end under each other.
        gap: blanks between columns.

    >>> columns([("", "a"), ("stroke", "26 mm")])
    ['        a', 'stroke  26 mm']
    """
    cells = [tuple(row) for row in rows]
    in_columns = [row for row in cells if any(row[1:])] or cells
    widths = [max(map(len, column)) for column in zip(*in_columns, strict=True)]
    return [
        " " * indent
        + (" " * gap)
        .join(
            cell.rjust(width) if right and column else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        .rstrip()
        for row in cells
    ]


class Notes:
    """Texts that did not fit in their columns, in the order of their numbers."""

    def __init__(self) -> None:
        self._texts: list[str] = []

    @property
    def lines(self) -> list[str]:
        """Numbers and texts, a line each."""
        return [f"[{number}] {text}" for number, text in enumerate(self._texts, start=1)]

    def cell(self, text: str, width: int) -> str:
        """Return a text of at most this width, or the number of its note.

        >>> notes = Notes()
        >>> notes.cell("dry", 4), notes.cell("lubricated", 4), notes.lines
        ('dry', '[1]', ['[1] lubricated'])
        """
        return text if len(text) <= width else self._number(text.strip())

    def header(self, label: str, width: int) -> tuple[str, str]:
        """Return a label in two lines of at most this width, or the number of its note.

        >>> Notes().header("rigid lubricated", 11), Notes().header("ideal", 11)
        (('rigid', 'lubricated'), ('', 'ideal'))
        """
        lines = [""]
        for word in re.findall(r"[^ _-]*[ _-]+|[^ _-]+", label):
            if len((lines[-1] + word).rstrip()) <= width:
                lines[-1] += word
            else:
                lines.append(word)
        first, *further = [line.rstrip() for line in lines if line] or [""]
        if len(further) > 1 or any(len(line) > width for line in (first, *further)):
            return "", self._number(label)
        return (first, further[0]) if further else ("", first)

    def _number(self, text: str) -> str:
        if text not in self._texts:
            self._texts.append(text)
        return f"[{self._texts.index(text) + 1}]"
