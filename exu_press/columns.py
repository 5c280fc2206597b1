"""Texts in columns, as a terminal shows them."""

from collections.abc import Iterable, Sequence

__all__ = ["columns"]


def columns(rows: Iterable[Sequence[str]], indent: int = 0) -> list[str]:
    """Return rows of equally many cells as lines, their columns under each other.

    >>> columns([("", "a"), ("stroke", "26 mm")])
    ['        a', 'stroke  26 mm']
    """
    cells = [tuple(row) for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return [
        " " * indent
        + "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in cells
    ]
