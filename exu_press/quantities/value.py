"""The value of a quantity, with its error where that is known."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from exu_press.quantities.catalogue import QuantityAt, quantities_of, quantity_of
from exu_press.quantities.kind import COUNT
from exu_press.quantities.reading import Reading
from exu_press.quantities.uncertain import uncertain
from exu_press.result import Result

__all__ = ["Value", "numbers_of", "value_of", "values_of"]


@dataclass(frozen=True)
class Value:
    """One quantity of one run.

    Attributes:
        name: full.
        value: in SI, None where the run is too short to have it.
        unit: SI.
        error: absolute; None where none was asked for.
        low: least value that it may have, or None.
        high: largest value that it may have, or None.
        determined: whether the scene determines it; None where no error was asked for.
    """

    name: str
    value: float | int | None
    unit: str
    error: float | None = None
    low: float | None = None
    high: float | None = None
    determined: bool | None = None

    def __str__(self) -> str:
        """Return value, error and unit as people write them."""
        return f"{uncertain(self.value, self.to_dict())} {self.unit}".strip()

    def to_dict(self) -> dict[str, Any]:
        """Return the entry of summary.json."""
        entries = ("value", "unit", "error", "low", "high", "determined")
        return {entry: getattr(self, entry) for entry in entries}


def value_of(result: Result, name: str, run: Reading | None = None) -> Value:
    """Return one quantity of a run by its full name.

    Raises:
        InputError: the run's scene has no such quantity.
    """
    run = Reading(result) if run is None else run
    return _value(result, quantity_of(result.scene, name), run)


def values_of(result: Result, run: Reading | None = None) -> dict[str, Value]:
    """Return every quantity of a run by its full name."""
    run = Reading(result) if run is None else run
    return {
        name: _value(result, placed, run) for name, placed in quantities_of(result.scene).items()
    }


def numbers_of(result: Result, declared: Mapping[str, QuantityAt]) -> dict[str, float]:
    """Return the values of quantities of a run by name; those that it is too short for left out."""
    run = Reading(result)
    values = {name: _read(result, placed, run) for name, placed in declared.items()}
    return {name: float(value) for name, value in values.items() if value is not None}


def _value(result: Result, placed: QuantityAt, run: Reading) -> Value:
    stated: Any = result.info.get("errors", {}).get(placed.name, {})
    return Value(placed.name, _read(result, placed, run), placed.quantity.unit, **stated)


def _read(result: Result, placed: QuantityAt, run: Reading) -> float | int | None:
    """Return a quantity's value, as it was read before channels were left out."""
    stored = result.info.get("figures", {"quantities": {}})["quantities"]
    if placed.name not in stored:
        if placed not in result.read:
            result.read[placed] = placed.read(run)
        value_read: float | int | None = result.read[placed]
        return value_read
    value = stored[placed.name]
    return int(value) if value is not None and placed.quantity.kind is COUNT else value
