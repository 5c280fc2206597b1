"""Texts in columns, as a terminal shows them."""

from collections.abc import Iterable, Sequence

__all__ = ["columns"]


def columns(
    rows: Iterable[Sequence[str]], indent: int = 0, *, right: bool = False, gap: int = 2
) -> list[str]:
    """Return rows of equally many cells as lines, their columns under each other.

    Args:
        rows: the head's first, if there is one.
        right: whether the columns but for the first one end under each other.
        gap: blanks between columns.

    >>> columns([("", "a"), ("stroke", "26 mm")])
    ['        a', 'stroke  26 mm']
    """
    cells = [tuple(row) for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
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
