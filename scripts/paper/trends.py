"""What a series does, in the paper's words."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

__all__ = ["LEAST_CHANGE", "TRENDS", "follows"]

LEAST_CHANGE = 0.02
"""Of the largest value: a smaller change is none."""

NEGLIGIBLE = 0.1
"""Largest share of time that may be called so."""

Series = Sequence[float]


def follows(stated: str, values: Series) -> bool:
    """Return whether values in the sweep's order do what is stated, a key of TRENDS."""
    return TRENDS[stated](values)


def _rises(values: Series) -> bool:
    """No step falls by more than the least change, and the whole rises by more."""
    least = LEAST_CHANGE * max(abs(value) for value in values)
    steps = [b - a for a, b in pairwise(values)]
    return min(steps) >= -least and values[-1] - values[0] > least


def _falls(values: Series) -> bool:
    return _rises([-value for value in values])


def _rises_then_falls(values: Series) -> bool:
    """The largest lies inside, above both ends by more than the least change."""
    least = LEAST_CHANGE * max(abs(value) for value in values)
    return max(values[1:-1]) - max(values[0], values[-1]) > least


def _falls_then_rises(values: Series) -> bool:
    return _rises_then_falls([-value for value in values])


def _negligible(values: Series) -> bool:
    return max(values) <= NEGLIGIBLE


TRENDS: Mapping[str, Callable[[Series], bool]] = {
    "rises": _rises,
    "falls": _falls,
    "rises, then falls": _rises_then_falls,
    "falls, then rises": _falls_then_rises,
    "negligible": _negligible,
}
