"""Which differences between runs are real, and which are within the errors of their figures."""

import textwrap
from collections.abc import Collection, Iterator, Mapping
from itertools import combinations
from typing import Any

__all__ = ["difference_lines"]

WIDTH = 100

Summary = Mapping[str, Any]


def difference_lines(summaries: Mapping[str, Summary]) -> list[str]:
    """Return what two runs do not differ in for sure, pair by pair, where any errors are known.

    >>> told = {"error": 2.0, "determined": True, "low": 8.0, "high": 12.0}
    >>> other = {"error": 1.0, "determined": True, "low": 11.0, "high": 13.0}
    >>> difference_lines({"a": {"errors": {"stroke": told}}, "b": {"errors": {"stroke": other}}})
    ['a, b: all differences exceed their errors, except in stroke']
    """
    lines = []
    for (name, one), (other_name, other) in combinations(summaries.items(), 2):
        unknown = [label for label in (name, other_name) if not summaries[label].get("errors")]
        if len(unknown) == 2:
            continue
        if unknown:
            said = f"nobody knows which differences are real, as {unknown[0]} has no errors"
        else:
            unsure = list(_unsure(one["errors"], other["errors"], _rounding(one, other)))
            said = "all differences exceed their errors"
            said += f", except in {', '.join(unsure)}" * bool(unsure)
        lines += textwrap.wrap(f"{name}, {other_name}: {said}", WIDTH, subsequent_indent="  ")
    return lines


def _rounding(*summaries: Summary) -> tuple[str, ...]:
    """Return the figures that are rounding: what a slider moves sideways in guides without play."""
    played = any("guide" in summary.get("scene", {}) for summary in summaries)
    return () if played else ("slider_tilt", "slider_lateral")


def _unsure(
    one: Mapping[str, Any], other: Mapping[str, Any], rounding: Collection[str]
) -> Iterator[str]:
    """Yield the figures whose bounds overlap; what is exactly the same is no difference."""
    for name, a in one.items():
        b = other.get(name)
        if b is None or name.startswith("press.") or name in rounding or a == b:
            continue
        if a["low"] <= b["high"] and b["low"] <= a["high"]:
            yield name
