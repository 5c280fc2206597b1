"""How a key of a scene varies: values, a range or a normal distribution."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError, error_prefix
from exu_press.schema.checks import key
from exu_press.schema.table import Table, table_from

__all__ = ["Key", "Normal", "Range", "Values", "key_from", "keys_from"]

FORMS = (
    "[value, ...], {low = a, high = b}, {low = a, high = b, log = true}, "
    "{mean = m, deviation = s}, with low and high where it is truncated"
)


@dataclasses.dataclass(frozen=True)
class Values:
    """A list of values of any type.

    Attributes:
        values: at least one.
    """

    values: tuple[Any, ...]

    @property
    def ends(self) -> tuple[Any, ...]:
        """Values at which a scene is checked."""
        return self.values

    def plain(self) -> list[Any]:
        """Return the variation in the form of the file."""
        return list(self.values)


@dataclasses.dataclass(frozen=True)
class Range(Table):
    """Numbers between two bounds, equally likely (by their logarithms with `log`).

    Raises:
        InputError: low is not below high, or not positive with log.
    """

    low: float = key(0.0, "lower bound")
    high: float = key(1.0, "upper bound")
    log: bool = key(False, "equally likely by its logarithm")

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.low < self.high or (self.log and not self.low > 0.0):
            allowed = "0 < low < high" if self.log else "low < high"
            raise InputError(f"low = {self.low:g}, high = {self.high:g}: allowed is {allowed}")

    @property
    def ends(self) -> tuple[float, float]:
        """Values at which a scene is checked."""
        return self.low, self.high

    def quantile(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the quantiles of shares between 0 and 1.

        >>> Range(low=1.0, high=100.0, log=True).quantile(np.array([0.5])).round(12)
        array([10.])
        """
        if self.log:
            return np.asarray(self.low * (self.high / self.low) ** share)
        return np.asarray(self.low + share * (self.high - self.low))

    def share(self, value: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shares of the distribution below values: the inverse of `quantile`."""
        if self.log:
            return np.asarray(np.log(value / self.low) / math.log(self.high / self.low))
        return np.asarray((value - self.low) / (self.high - self.low))

    def plain(self) -> dict[str, Any]:
        """Return the variation in the form of the file."""
        return {"low": self.low, "high": self.high} | ({"log": True} if self.log else {})


@dataclasses.dataclass(frozen=True)
class Normal(Table):
    """A normal distribution, truncated where bounds are given.

    Raises:
        InputError: low is not below high, or the mean is not between them.
    """

    mean: float = key(0.0, "mean before it is truncated")
    deviation: float = key(1.0, "standard deviation before it is truncated", above=0)
    low: float | None = key(None, "lower bound")
    high: float | None = key(None, "upper bound")

    def __post_init__(self) -> None:
        super().__post_init__()
        low, high = self._bounds
        if not low < self.mean < high:
            raise InputError(
                f"mean = {self.mean:g}, low = {low:g}, high = {high:g}: allowed is "
                "low < mean < high"
            )

    @property
    def ends(self) -> tuple[float, float]:
        """Values at which a scene is checked: the bounds, else those that hold all but 1e-4."""
        low, high = self.quantile(np.array([5e-5, 1.0 - 5e-5]))
        return (
            float(low) if self.low is None else self.low,
            float(high) if self.high is None else self.high,
        )

    def quantile(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the quantiles of shares between 0 and 1."""
        return np.asarray(self._distribution.ppf(share), dtype=float)

    def share(self, value: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shares of the distribution below values: the inverse of `quantile`."""
        return np.asarray(self._distribution.cdf(value), dtype=float)

    def plain(self) -> dict[str, Any]:
        """Return the variation in the form of the file."""
        bounds = {name: getattr(self, name) for name in ("low", "high")}
        finite = {name: bound for name, bound in bounds.items() if bound is not None}
        return {"mean": self.mean, "deviation": self.deviation, **finite}

    @property
    def _distribution(self) -> Any:
        from scipy.stats import truncnorm

        low, high = ((bound - self.mean) / self.deviation for bound in self._bounds)
        return truncnorm(low, high, loc=self.mean, scale=self.deviation)

    @property
    def _bounds(self) -> tuple[float, float]:
        return (
            -math.inf if self.low is None else self.low,
            math.inf if self.high is None else self.high,
        )


Key = Values | Range | Normal

NAMES = ({"low", "high"}, {"mean", "deviation"})
"""Keys by which a table is a range or a distribution, not a table of the scene."""


def keys_from(table: Mapping[str, Any], prefix: str = "") -> dict[str, Key]:
    """Return how keys vary, by dotted names; a nested table a.b is the key "a.b".

    >>> keys_from({"film": {"viscosity": [0.1, 0.2]}})
    {'film.viscosity': Values(values=(0.1, 0.2))}

    Raises:
        InputError: a key is given twice, or varies in no allowed way.
    """
    keys: dict[str, Key] = {}
    for name, value in table.items():
        if isinstance(value, Mapping) and value and not any(n & set(value) for n in NAMES):
            inner = keys_from(value, f"{prefix}{name}.")
        else:
            inner = {prefix + name: key_from(prefix + name, value)}
        for dotted in inner:
            if dotted in keys:
                raise InputError(f"keys.{dotted}: given twice")
        keys |= inner
    return keys


def key_from(name: str, value: Any) -> Key:
    """Return how one key varies."""
    if isinstance(value, (Values, Range, Normal)):
        return value
    with error_prefix(f"keys.{name}: "):
        if isinstance(value, Mapping) and NAMES[0] <= set(value) <= NAMES[0] | {"log"}:
            return table_from(Range, "", value)
        if isinstance(value, Mapping) and NAMES[1] <= set(value):
            return table_from(Normal, "", value)
    if isinstance(value, Sequence) and not isinstance(value, str) and value:
        return Values(tuple(value))
    raise InputError(f"keys.{name} = {value!r:.200}: allowed is {FORMS}")
