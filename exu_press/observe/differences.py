"""Which differences between runs are real, and which are within the errors of their figures."""

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

__all__ = ["difference_lines"]

Summary = Mapping[str, Any]


def difference_lines(summaries: Mapping[str, Summary]) -> list[str]:
    """Return what two runs do not differ in for sure, a line a pair with known errors.

    >>> told = {"error": 2.0, "determined": True, "low": 8.0, "high": 12.0}
    >>> other = {"error": 1.0, "determined": True, "low": 11.0, "high": 13.0}
    >>> difference_lines({"a": {"errors": {"stroke": told}}, "b": {"errors": {"stroke": other}}})
    ['a, b: differences are real but for stroke']
    """
    lines = []
    for (name, one), (other_name, other) in combinations(summaries.items(), 2):
        if not one.get("errors") or not other.get("errors"):
            continue
        unsure = list(_unsure(one["errors"], other["errors"]))
        but = f" but for {', '.join(unsure)}" if unsure else ""
        lines.append(f"{name}, {other_name}: differences are real{but}")
    return lines


def _unsure(one: Mapping[str, Any], other: Mapping[str, Any]) -> Iterator[str]:
    """Yield the figures whose bounds overlap; what is exactly the same is no difference."""
    for name, a in one.items():
        b = other.get(name)
        if b is None or name.startswith("press.") or a == b:
            continue
        if a["low"] <= b["high"] and b["low"] <= a["high"]:
            yield name
