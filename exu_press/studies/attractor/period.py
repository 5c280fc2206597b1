"""The period of a motion in revolutions, as far as its error resolves it."""

from dataclasses import dataclass

import numpy as np

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array

__all__ = ["MOST", "Period", "period_of"]

MOST = 16
"""Revolutions up to which a period is looked for."""

SAME = 3.0
"""Times the error of a revolution: two nearer points are the same."""

APART = 10.0
"""Times the error: two points further apart are different."""

LARGEST = 0.01
"""Clearances: points further apart are not the same; with a larger error of a point, no period is
decided."""

SETTLED = 0.5
"""Ratio of the distances in the second and the first half of the points, below which the motion
still settles."""


@dataclass(frozen=True)
class Period:
    """The period of a motion.

    Attributes:
        revolutions: after which the motion repeats itself; None where there is no such number up to
            `most`, or it is undecided.
        is_decided: False where the error is too large, or the motion has not
            settled.
        why: it is undecided; empty otherwise.
        distances: (most,) largest distance of points 1, 2, ... revolutions apart.
        error: of a point.
        finer: factor on the tolerance that would decide it; 1.0 where it is decided.
    """

    revolutions: int | None
    is_decided: bool
    why: str
    most: int
    distances: Array
    error: float
    finer: float = 1.0

    def __str__(self) -> str:
        if not self.is_decided:
            return f"undecided ({self.why})"
        if self.revolutions is None:
            return f"none up to {self.most} revolutions"
        return f"{self.revolutions} revolution{'s' if self.revolutions > 1 else ''}"


def period_of(points: Array, error: float, most: int = MOST, *, diverging: bool = False) -> Period:
    """Return the period of a motion from its points in a section.

    >>> turn = np.array([[0.0], [1.0]] * 12)
    >>> str(period_of(turn, error=1e-3, most=4))
    '2 revolutions'

    Args:
        points: (n, k), one a revolution, after the transient; n at least 3 `most`.
        error: largest error of a point, in the same measure.
        most: revolutions.
        diverging: whether neighbouring motions are known to diverge: the motion then has no period,
            whatever points seem to repeat within their error.

    Raises:
        InputError: there are too few points.
    """
    if len(points) < 3 * most:
        raise InputError(
            f"{len(points)} revolutions in the section: allowed are at least {3 * most} for "
            f"periods up to {most}"
        )
    distances = np.array([_distance(points, n) for n in range(1, most + 1)])
    within = distances <= SAME * error

    def undecided_period(why: str, finer: float = 1.0) -> Period:
        return Period(None, False, why, most, distances, error, finer)

    same = np.flatnonzero(within & (distances <= LARGEST))
    if within.any() and diverging:
        finer = float(distances.min() / (APART * error))
        why = f"neighbours part, but points lie within their error of {error:.2g}"
        return undecided_period(why, finer)
    if within.any() and (error > LARGEST or not len(same)):
        why = f"points lie {distances.min():.2g} clearances apart, with an error of {error:.2g}"
        return undecided_period(
            why, (LARGEST if len(same) else float(distances.min()) / APART) / error
        )
    if len(same):
        return Period(int(same[0]) + 1, True, "", most, distances, error)
    nearest = int(np.argmin(distances))
    half = len(points) // 2
    if _distance(points[half:], nearest + 1) < SETTLED * _distance(points[:half], nearest + 1):
        return undecided_period("it still settles: skip more revolutions")
    if distances[nearest] < APART * error:
        why = f"points lie {distances[nearest]:.2g} apart, with an error of {error:.2g}"
        return undecided_period(why, float(distances[nearest] / (APART * error)))
    return Period(None, True, "", most, distances, error)


def _distance(points: Array, revolutions: int) -> float:
    """Return the largest distance of points that many revolutions apart."""
    apart = points[revolutions:] - points[:-revolutions]
    return float(np.sqrt((apart**2).sum(axis=1)).max(initial=0.0))
