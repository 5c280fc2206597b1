"""Whether ours is the paper's, as far as our errors let it be said."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

from paper.value import Value

__all__ = ["AGREES_WITHIN", "TRENDS", "agreement", "followed"]

AGREES_WITHIN = 0.25
"""Largest deviation of a ratio from 1 that is called agreement."""

LEAST_CHANGE = 0.02
"""Of the largest value: a smaller change is none."""

NEGLIGIBLE = 0.1
"""Largest share of time that may be called so."""

Bounds = Sequence[float]


def agreement(value: Value | None, published: float) -> str:
    """Return "agrees" or "differs", "open" where the error decides it, "no run" without a value."""
    if value is None:
        return "no run"
    ratio = value.over(published)
    if abs(ratio.low - 1.0) <= AGREES_WITHIN and abs(ratio.high - 1.0) <= AGREES_WITHIN:
        return "agrees"
    meets = ratio.low <= 1.0 + AGREES_WITHIN and ratio.high >= 1.0 - AGREES_WITHIN
    return "open" if meets else "differs"


def followed(stated: str, values: Sequence[Value | None]) -> str:
    """Return "trend" where values in the sweep's order do what is stated, else as `agreement`.

    Args:
        stated: a key of TRENDS.
        values: of the runs.
    """
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return "no run"
    low, high = [value.low for value in known], [value.high for value in known]
    margin = TRENDS[stated]
    if margin(low, high) >= 0.0:
        return "trend"
    return "open" if margin(high, low) >= 0.0 else "differs"


def _rises(low: Bounds, high: Bounds) -> float:
    """No step falls by more than the least change, and the whole rises by more."""
    least = LEAST_CHANGE * max(abs(value) for value in (*low, *high))
    steps = [after - before for (before, _), (_, after) in pairwise(zip(high, low, strict=True))]
    return min(min(steps) + least, low[-1] - high[0] - least)


def _falls(low: Bounds, high: Bounds) -> float:
    return _rises([-value for value in high], [-value for value in low])


def _rises_then_falls(low: Bounds, high: Bounds) -> float:
    """The largest lies inside, above both ends by more than the least change."""
    least = LEAST_CHANGE * max(abs(value) for value in (*low, *high))
    return max(low[1:-1]) - max(high[0], high[-1]) - least


def _falls_then_rises(low: Bounds, high: Bounds) -> float:
    return _rises_then_falls([-value for value in high], [-value for value in low])


def _negligible(low: Bounds, high: Bounds) -> float:
    return NEGLIGIBLE - max(high)


TRENDS: Mapping[str, Callable[[Bounds, Bounds], float]] = {
    "rises": _rises,
    "falls": _falls,
    "rises, then falls": _rises_then_falls,
    "falls, then rises": _falls_then_rises,
    "negligible": _negligible,
}
"""By the paper's words: by how much values between bounds do so at least; at most with the bounds
the other way round."""
