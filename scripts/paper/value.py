"""A figure between the bounds that are known of it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from exu_press.quantities.uncertain import uncertain

__all__ = ["Value", "distance", "product"]

SHOWN = 1e-3
"""Of a figure, the least error that is shown."""


@dataclass(frozen=True)
class Value:
    """A figure.

    Attributes:
        value: SI.
        low, high: what it may be.
        determined: False where the scene does not determine it: other runs lie between the bounds.
    """

    value: float
    low: float
    high: float
    determined: bool = True

    @property
    def error(self) -> float:
        """How far it may be off."""
        return max(self.high - self.value, self.value - self.low)

    def over(self, aim: float) -> "Value":
        """Return the ratio to a positive number."""
        return Value(self.value / aim, self.low / aim, self.high / aim, self.determined)

    def apart(self, other: "Value") -> bool:
        """Return whether the two differ by more than both errors."""
        return self.low > other.high or self.high < other.low

    def text(self, scale: float = 1.0) -> str:
        """Return value and error in words, the bounds alone of what is not determined.

        An error of less than SHOWN is shown as that much: no comparison here needs more digits.

        >>> Value(21.89, 21.69, 22.09).text(), Value(5.0, 4.3, 9.0, False).text()
        ('21.89 +- 0.20', '4.30 to 9.00')
        """
        told = {
            "error": self.error and max(self.error, SHOWN * abs(self.value)),
            "determined": self.determined,
            "low": self.low,
            "high": self.high,
        }
        return uncertain(self.value, told, scale).removesuffix(", not determined")


def product(one: Value, other: Value, power: float = 1.0) -> Value:
    """Return the product of two positive figures, the other one to a power."""
    return Value(
        one.value * other.value**power,
        one.low * other.low**power,
        one.high * other.high**power,
        one.determined and other.determined,
    )


def distance(values: Sequence[Value | None], aims: Sequence[float]) -> Value | None:
    """Return the root mean square of the logarithms of values over aims; None with one missing.

    Errors of the values add up as independent ones do.

    >>> distance([Value(2.0, 1.9, 2.1), Value(0.5, 0.5, 0.5)], [1.0, 1.0]).value == math.log(2.0)
    True
    """
    known = [value for value in values if value is not None]
    if not known or len(known) < len(values):
        return None
    logs = [math.log(value.value / aim) for value, aim in zip(known, aims, strict=True)]
    size = math.sqrt(sum(x * x for x in logs) / len(logs))
    parts = [x * v.error / v.value for x, v in zip(logs, known, strict=True)]
    error = math.hypot(*parts) / (len(logs) * size)
    return Value(size, max(0.0, size - error), size + error, all(v.determined for v in known))
