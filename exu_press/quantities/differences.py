"""Differences between runs: real ones, and those within the errors of their quantities."""

import textwrap
from collections.abc import Iterator, Mapping
from itertools import combinations

from exu_press.result import Result
from exu_press.result.info import Error

__all__ = ["difference_lines"]

WIDTH = 100


def difference_lines(results: Mapping[str, Result]) -> list[str]:
    """Return in which quantities two runs may be the same, pair by pair, where errors are known."""
    lines = []
    for (name, one), (other_name, other) in combinations(results.items(), 2):
        told = [run.info.get("errors", {}) for run in (one, other)]
        unknown = [
            label for label, errors in zip((name, other_name), told, strict=True) if not errors
        ]
        if len(unknown) == 2:
            continue
        if unknown:
            said = f"{unknown[0]} has no errors, so that no difference is sure"
        else:
            unsure = list(_unsure(*told))
            said = "all differences exceed their errors"
            said += f", except in {', '.join(unsure)}" * bool(unsure)
        lines += textwrap.wrap(f"{name}, {other_name}: {said}", WIDTH, subsequent_indent="  ")
    return lines


def _unsure(one: Mapping[str, Error], other: Mapping[str, Error]) -> Iterator[str]:
    """Yield the quantities whose bounds overlap, but are not exactly the same."""
    for name, a in one.items():
        b = other.get(name)
        if b is None or a == b:
            continue
        if a["low"] <= b["high"] and b["low"] <= a["high"]:
            yield name
