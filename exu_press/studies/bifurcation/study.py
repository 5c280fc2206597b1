"""The study's file: one key that goes up and down, or two for a map of periods."""

import dataclasses
from itertools import pairwise
from types import MappingProxyType

from exu_press.errors import InputError
from exu_press.schema.checks import key
from exu_press.schema.table import Table
from exu_press.studies.attractor.lyapunov import BATCHES
from exu_press.studies.base import Study, Values

__all__ = ["FROM_THE_START", "Bifurcation", "LongRun"]

FROM_THE_START = "from the start"

ITS_OWN = "revolutions", "settle"
"""Keys of a scene in whose place a study has its own."""

WAYS = ("up and down", "up", "down", FROM_THE_START)


@dataclasses.dataclass(frozen=True)
class LongRun(Table):
    """The table [bifurcation]: how long each run is, and where it begins."""

    table = "bifurcation"

    skip: int = key(30, "revolutions of the transient at each value", at_least=1)
    revolutions: int = key(48, "revolutions in the section", at_least=2 * BATCHES)
    longest: int = key(8, "period up to which is looked for, revolutions", at_least=1)
    way: str = key("up and down", "which way the first key goes", choices=WAYS)


@dataclasses.dataclass(frozen=True)
class Bifurcation(Study):
    """A study file with one key or two, and its table [bifurcation].

    Raises:
        InputError: there are more keys than two, a key's values are no numbers that increase, or
            the runs are too short for the period asked.
    """

    plain_runs = False
    tables = MappingProxyType({"bifurcation": LongRun})

    bifurcation: LongRun = LongRun()

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.keys) > 2:
            raise InputError(
                f"[keys]: {', '.join(self.keys)}; allowed in a file for exu-press bifurcation is "
                "one key, or two for a map"
            )
        for name in self.keys:
            if name in ITS_OWN:
                raise InputError(
                    f"keys.{name}: bifurcation.skip and bifurcation.revolutions say how long runs "
                    "are; allowed is another key"
                )
            if not all(a < b for a, b in pairwise(self._numbers(name))):
                raise InputError(f"keys.{name}: allowed are numbers that increase")
        if self.bifurcation.revolutions < 3 * self.bifurcation.longest:
            raise InputError(
                f"bifurcation.revolutions = {self.bifurcation.revolutions}: allowed are at least "
                f"{3 * self.bifurcation.longest}, for periods up to {self.bifurcation.longest}"
            )

    @property
    def name(self) -> str:
        """The dotted name of the key that goes up and down: the first one."""
        return next(iter(self.keys))

    @property
    def values(self) -> tuple[float, ...]:
        """Its values."""
        return self._numbers(self.name)

    @property
    def second(self) -> str | None:
        """The dotted name of the second key, or None."""
        return list(self.keys)[1] if len(self.keys) == 2 else None

    @property
    def names(self) -> list[str]:
        """The dotted names of the keys, one or two."""
        return list(self.keys)

    @property
    def seconds(self) -> tuple[float | None, ...]:
        """Its values; None alone where there is no second key."""
        return (None,) if self.second is None else self._numbers(self.second)

    def point_at(self, value: float, second: float | None) -> dict[str, float]:
        """Return the keys at a point."""
        point = {self.name: value}
        if self.second is not None and second is not None:
            point[self.second] = second
        return point

    def _numbers(self, name: str) -> tuple[float, ...]:
        variation = self.keys[name]
        values = variation.values if isinstance(variation, Values) else ()
        numbers = tuple(
            v for v in values if isinstance(v, (int, float)) and not isinstance(v, bool)
        )
        if not numbers or len(numbers) < len(values):
            raise InputError(f"keys.{name} = {variation.plain()!r:.200}: allowed is [number, ...]")
        return numbers
