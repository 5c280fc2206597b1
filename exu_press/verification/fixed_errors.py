"""Errors of figures that no tolerance makes smaller."""

from collections.abc import Collection
from typing import NamedTuple

from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.verification.reading import read_a_revolution_earlier, with_next_temperatures

__all__ = ["FixedError", "fixed_errors"]


class FixedError(NamedTuple):
    """An error over its figure, what it comes from, and the cure."""

    relative: float
    cause: str
    cure: str


def fixed_errors(result: Result, names: Collection[str]) -> dict[str, FixedError]:
    """Return the fixed errors of figures that are not zero, each the larger one of its two."""
    declared = {name: q for name, q in quantities_of(result.scene).items() if name in names}
    values = numbers_of(result, declared)
    later = [
        numbers_of(read(result), declared)
        for read in (read_a_revolution_earlier, with_next_temperatures)
    ]
    fixed = {}
    for name, value in values.items():
        law = declared[name].quantity.law_error(result.scene, declared[name].owner, value)
        warming = max(abs(value - numbers.get(name, value)) for numbers in later)
        if value:
            fixed[name] = max(
                FixedError(law / abs(value), "the table of its film law", "another film law"),
                FixedError(
                    warming / abs(value), "oil that still warms", "more revolutions of settle"
                ),
            )
    return fixed
