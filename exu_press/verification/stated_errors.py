"""Stated errors of a run's quantities beside their true ones, from a more accurate run."""

from collections.abc import Iterator
from dataclasses import dataclass

from exu_press.quantities import quantities_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.result.info import Error
from exu_press.verification.reading import add_energy_residual, average_neighbours

__all__ = ["StatedError", "compare_errors"]

NOTHING = 1e-6
"""Relative error below which errors do not follow from tolerances."""

UNCERTAIN = 2.0
"""Errors of reading a reference within which its value is uncertain."""


@dataclass(frozen=True)
class StatedError:
    """Stated and true error of one quantity.

    Attributes:
        name: dotted.
        value: of the run, in the quantity's unit.
        reference: of the more accurate run.
        reading_error: of `reference`.
    """

    name: str
    value: float
    reference: float
    reading_error: float
    stated: Error

    @property
    def true_error(self) -> float:
        """Difference from the reference, in the quantity's unit."""
        return abs(self.value - self.reference)

    @property
    def is_covered(self) -> bool:
        """Return whether the stated error covers the true one."""
        low = self.stated["low"] - UNCERTAIN * self.reading_error
        high = self.stated["high"] + UNCERTAIN * self.reading_error
        return low <= self.reference <= high or self.true_error <= NOTHING * abs(self.value)

    @property
    def ratio(self) -> float | None:
        """Stated over true error; None where the true one is below the reference's uncertainty."""
        least = max(NOTHING * abs(self.value), UNCERTAIN * self.reading_error)
        return self.stated["error"] / self.true_error if self.true_error > least else None


def compare_errors(result: Result, reference: Result) -> Iterator[StatedError]:
    """Yield stated and true error of every quantity that both runs have."""
    declared = quantities_of(result.scene)
    values, references = numbers_of(result, declared), numbers_of(reference, declared)
    transforms = average_neighbours, add_energy_residual
    rereadings = [numbers_of(transform(reference), declared) for transform in transforms]
    for name, stated in result.info["errors"].items():
        if name in references:
            reading_error = max(abs(references[name] - reread[name]) for reread in rereadings)
            yield StatedError(name, values[name], references[name], reading_error, stated)
