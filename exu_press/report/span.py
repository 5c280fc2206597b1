"""Which part of a run's record a page shows."""

__all__ = ["ALL", "Span"]

Span = tuple[float | None, float | None]
"""Begin and end, s; None: those of the record."""

ALL: Span = (None, None)
