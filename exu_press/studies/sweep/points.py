"""Where a study's runs lie: grids, lists and Latin hypercubes of scene keys."""

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

from exu_press.errors import InputError

__all__ = ["MOST_RUNS", "Points", "flat", "grid", "listed", "sample"]

Points = tuple[dict[str, Any], ...]

MOST_RUNS = 100_000
"""Runs of one study."""


def grid(values: Mapping[str, Sequence[Any]]) -> Points:
    """Return every combination; the last key runs fastest.

    >>> grid({"speed_rpm": [200, 300], "crank_pin": ["dry"]})
    ({'speed_rpm': 200, 'crank_pin': 'dry'}, {'speed_rpm': 300, 'crank_pin': 'dry'})
    """
    _check(values, "grid")
    number = math.prod(len(each) for each in values.values())
    _check_number("grid", number)
    return tuple(
        dict(zip(values, each, strict=True)) for each in itertools.product(*values.values())
    )


def listed(values: Mapping[str, Sequence[Any]]) -> Points:
    """Return the first values of all keys, the second ones, and so on.

    >>> listed({"speed_rpm": [200, 300], "crank_pin": ["dry", "ideal"]})
    ({'speed_rpm': 200, 'crank_pin': 'dry'}, {'speed_rpm': 300, 'crank_pin': 'ideal'})
    """
    _check(values, "list")
    lengths = {key: len(each) for key, each in values.items()}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{key} has {length}" for key, length in lengths.items())
        raise InputError(f"[list]: {told}; allowed are lists of one length")
    _check_number("list", next(iter(lengths.values())))
    return tuple(
        dict(zip(values, each, strict=True)) for each in zip(*values.values(), strict=True)
    )


def sample(table: Mapping[str, Any]) -> Points:
    """Return a Latin hypercube between key = [low, high], of n points, the same for one seed.

    Source: McKay, Beckman, Conover, Technometrics 21 (1979) 239-245; made by SciPy.
    """
    ranges = {key: each for key, each in table.items() if key not in ("n", "seed")}
    number, seed = (_whole(table, name, low) for name, low in (("n", 1), ("seed", 0)))
    _check(ranges, "sample")
    for key, each in ranges.items():
        numbers = all(isinstance(x, (int, float)) and not isinstance(x, bool) for x in each)
        if not (len(each) == 2 and numbers and -math.inf < each[0] < each[1] < math.inf):
            raise InputError(f"sample.{key} = {each!r}: allowed is [low, high], low < high")
    _check_number("sample", number)
    from scipy.stats import qmc

    unit = qmc.LatinHypercube(len(ranges), rng=seed).random(number)
    low, high = zip(*ranges.values(), strict=True)
    return tuple(
        dict(zip(ranges, map(float, row), strict=True)) for row in qmc.scale(unit, low, high)
    )


def flat(table: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return nested tables as one, names joined by a dot: TOML's a.b is its "a.b"."""
    found: dict[str, Any] = {}
    for name, value in table.items():
        inner = (
            flat(value, f"{prefix}{name}.")
            if isinstance(value, Mapping)
            else {prefix + name: value}
        )
        for key in inner:
            if key in found:
                raise InputError(f"{key}: given twice")
        found |= inner
    return found


def _check(values: Mapping[str, Any], table: str) -> None:
    """Raise InputError unless every key has a list of values."""
    if not values:
        raise InputError(f"[{table}]: empty; allowed is at least one key of the scene")
    for key, each in values.items():
        if not isinstance(each, Sequence) or isinstance(each, str) or not each:
            raise InputError(f"{table}.{key} = {each!r}: allowed is a list with at least one value")


def _check_number(table: str, number: int) -> None:
    if number > MOST_RUNS:
        raise InputError(f"[{table}]: {number} runs; allowed are at most {MOST_RUNS}")


def _whole(table: Mapping[str, Any], name: str, low: int) -> int:
    value = table.get(name)
    if not isinstance(value, int) or isinstance(value, bool) or value < low:
        raise InputError(f"sample.{name} = {value!r}: allowed is a whole number >= {low}")
    return value
