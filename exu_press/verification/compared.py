"""A run's quantities with their stated errors beside those of a more accurate run."""

from collections.abc import Iterator
from dataclasses import dataclass

from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.info import Error
from exu_press.verification.reading import smoothed, unbalanced

__all__ = ["Compared", "compared"]

NOTHING = 1e-6
"""Over a figure: smaller errors are no matter of tolerances."""

UNSURE = 2.0
"""Times the error of reading a reference: it cannot tell less."""


@dataclass(frozen=True)
class Compared:
    """One figure of both.

    Attributes:
        name: dotted.
        value: of the run, in the figure's unit.
        true: of the more accurate one.
        reading: error of `true` by its reading.
        told: what the run states.
    """

    name: str
    value: float
    true: float
    reading: float
    told: Error

    @property
    def off(self) -> float:
        """The true error, in the figure's unit, as far as the reference can tell."""
        return abs(self.value - self.true)

    @property
    def covered(self) -> bool:
        """Return whether the stated error covers the true one."""
        low = self.told["low"] - UNSURE * self.reading
        high = self.told["high"] + UNSURE * self.reading
        return low <= self.true <= high or self.off <= NOTHING * abs(self.value)

    @property
    def ratio(self) -> float | None:
        """The stated over the true error; None where the reference cannot tell it."""
        least = max(NOTHING * abs(self.value), UNSURE * self.reading)
        return self.told["error"] / self.off if self.off > least else None


def compared(result: Result, reference: Result) -> Iterator[Compared]:
    """Yield every figure that both have.

    Args:
        result: with its errors.
        reference: the same scene, more accurate; its errors are not looked at.
    """
    declared = quantities_of(result.scene)
    here, there = numbers_of(result, declared), numbers_of(reference, declared)
    reads = [numbers_of(changed(reference), declared) for changed in (smoothed, unbalanced)]
    for name, told in result.info["errors"].items():
        if name in there:
            reading = max(abs(there[name] - read[name]) for read in reads)
            yield Compared(name, here[name], there[name], reading, told)
