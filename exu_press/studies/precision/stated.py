"""Stated against true error of every figure of a scene, at several tolerances."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from exu_press.quantities.catalogue import PEAK_ACCELERATION
from exu_press.scene import Scene
from exu_press.verification.simulate import simulate
from exu_press.verification.stated_errors import compare_errors

__all__ = ["StatedErrors", "stated_errors"]


@dataclass(frozen=True)
class StatedErrors:
    """The stated errors of one run.

    Attributes:
        figures: that are compared.
        covered: how many of them are stated well enough.
        ratio: of stated and true error in the median; None where there are next to no errors.
        errors: stated and true error over the figure, of all figures with an error.
        peak: the same of the peak acceleration, None where there is next to none.
    """

    case: str
    tolerance: float
    figures: int
    covered: int
    ratio: float | None
    errors: tuple[tuple[float, float], ...]
    peak: tuple[float, float] | None


def stated_errors(
    case: str, scene: Scene, tolerances: Sequence[float], reference: float
) -> list[StatedErrors]:
    """Return the stated errors of runs, against a run at the reference's tolerance."""
    true = simulate(scene.replace({"solver.tolerance": reference}))
    if not true.completed:
        return []
    entries = []
    for tolerance in tolerances:
        run = simulate(scene.replace({"solver.tolerance": tolerance}), errors=True, beside=False)
        if not run.completed:
            continue
        every = list(compare_errors(run, true))
        shares = {
            comparison.name: (
                comparison.stated["error"] / abs(comparison.value),
                comparison.true_error / abs(comparison.value),
            )
            for comparison in every
            if comparison.value and comparison.ratio is not None
        }
        ratios = [comparison.ratio for comparison in every if comparison.ratio is not None]
        entries.append(
            StatedErrors(
                case=case,
                tolerance=tolerance,
                figures=len(every),
                covered=sum(comparison.is_covered for comparison in every),
                ratio=median(ratios) if ratios else None,
                errors=tuple(shares.values()),
                peak=shares.get(PEAK_ACCELERATION.name),
            )
        )
    return entries
