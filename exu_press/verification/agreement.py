"""Whether two runs have the same figures: in all digits, or within both of their errors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from exu_press.quantities import quantities_of, values_of
from exu_press.quantities.uncertain import uncertain
from exu_press.quantities.value import Value
from exu_press.result import Result

__all__ = ["Agreement", "agreement"]


@dataclass(frozen=True)
class Agreement:
    """How the figures of two runs compare.

    Attributes:
        identical: names of figures that are equal in all digits.
        within: names of others whose bounds overlap.
        different: name of a figure that does not agree -> both values in words.
    """

    identical: Sequence[str]
    within: Sequence[str]
    different: Mapping[str, str]

    @property
    def agrees(self) -> bool:
        """Return whether all figures agree."""
        return not self.different


def agreement(first: Result, second: Result) -> Agreement:
    """Compare all quantities of two runs that may have errors: none of cost, and no residual."""
    identical, within, different = [], [], {}
    declared = {**quantities_of(first.scene), **quantities_of(second.scene)}
    values, repeated = values_of(first), values_of(second)
    for name, placed in declared.items():
        if not placed.quantity.kind.has_error:
            continue
        a, b = values.get(name), repeated.get(name)
        if a is not None and b is not None and a.value == b.value:
            identical.append(name)
        elif a is not None and b is not None and _overlap(a, b):
            within.append(name)
        else:
            different[name] = f"{_text(a)} before, {_text(b)} now"
    return Agreement(identical, within, different)


def _overlap(first: Value, second: Value) -> bool:
    """Return whether the bounds of two values overlap."""
    bounds = first.low, first.high, second.low, second.high
    low, high, second_low, second_high = bounds
    if low is None or high is None or second_low is None or second_high is None:
        return False
    return low <= second_high and second_low <= high


def _text(value: Value | None) -> str:
    if value is None:
        return "none"
    stated = None if value.error is None else value.to_dict()
    return f"{uncertain(value.value, stated, 1.0, 10)} {value.unit}".strip()
