"""Further observations of a quantity: means over other windows, samples at other rates.

A scene asks for them by [output] readings; their names follow, as peak_acceleration.mean_500us.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import lru_cache, partial
from typing import Any

from exu_press.quantities.quantity import Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene
from exu_press.scene.readings import DEGREES, SECONDS, Readings

__all__ = ["find_observed", "with_observed"]

MEAN, RATE = "mean_1ms", "1khz"
"""In the names of the quantities of every scene, of which these are further observations."""

OBSERVED = re.compile(r"(.*)(?:(mean)_(\d+)([a-z]+)|(differentiated)_(\d+)(hz|khz))")
RATES = {"khz": 1e3, "hz": 1.0}


def with_observed(declared: Iterable[Quantity], scene: Scene) -> Iterator[Quantity]:
    """Yield quantities, each with the further observations of it that a scene asks for."""
    readings = None if scene.output is None else scene.output.readings
    for quantity in declared:
        yield quantity
        if readings is not None and quantity.observe is not None:
            yield from (_observation(quantity, label) for label in _labels(quantity, readings))


def _labels(quantity: Quantity, readings: Readings) -> list[str]:
    return readings.windows if MEAN in quantity.name else readings.rates


def find_observed(declared: Iterable[Quantity], name: str) -> Quantity | None:
    """Return the quantity of a name that is a further observation of another one."""
    match = OBSERVED.fullmatch(name)
    if match is None:
        return None
    prefix, mean, window, unit, _, rate, per_second = match.groups()
    if (unit not in {**SECONDS, **DEGREES}) if mean else (per_second not in RATES):
        return None
    usual = f"{prefix}{MEAN}" if mean else f"{prefix}differentiated_{RATE}"
    for quantity in declared:
        if quantity.name == usual and quantity.observe is not None:
            return _observation(quantity, f"{window}{unit}" if mean else f"{rate}{per_second}")
    return None


@lru_cache(maxsize=256)
def _observation(quantity: Quantity, label: str) -> Quantity:
    """Return a quantity of 1 ms or 1 kHz with another window or rate, as "500us" or "5khz"."""
    number, unit = re.fullmatch(r"(\d+)([a-z]+)", label).groups()  # type: ignore[union-attr]
    is_mean = MEAN in quantity.name
    unit_words = {"khz": "kHz", "hz": "Hz", "mdeg": "mdeg of the crank", "deg": "deg of the crank"}
    words, usual = f"{number} {unit_words.get(unit, unit)}", "1 ms" if is_mean else "1 kHz"
    return replace(
        quantity,
        name=quantity.name.replace(
            MEAN if is_mean else RATE, f"mean_{label}" if is_mean else label
        ),
        meaning=quantity.meaning.replace(usual, words),
        title=quantity.title.replace(usual, words) if usual in quantity.title else "",
        upper_bound="",
        read=partial(_read, quantity, float(number), unit),
        observe=None,
    )


def _read(quantity: Quantity, number: float, unit: str, run: Reading, owner: str) -> Any:
    """Return the value with a window or at a rate."""
    if unit in DEGREES:
        width = number * DEGREES[unit] / (6.0 * run.run.scene.speed_rpm)
    else:
        width = number * {**SECONDS, **RATES}[unit]
    assert quantity.observe is not None
    return quantity.observe(width, run, owner)
