"""Where the slider turns: its lowest position in every stroke."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

__all__ = ["DeadCentre", "bottom_dead_centres"]

Array = NDArray[np.float64]

REACH = np.pi / 2
"""A stroke's lowest position is looked for this far before and behind the crank's lowest one, rad:
clearances shift it by degrees."""


@dataclass(frozen=True)
class DeadCentre:
    """The slider's lowest position in one stroke.

    Attributes:
        time: s.
        crank_angle: from top dead centre, going on over revolutions, rad.
        position: m.
    """

    time: float
    crank_angle: float
    position: float


def bottom_dead_centres(
    time: Array, crank_angle: Array, position: Array, velocity: Array
) -> list[DeadCentre]:
    """Return the lowest position of every stroke that a record holds.

    Args:
        time: (n,), s, increasing.
        crank_angle: (n,) from top dead centre, rad, increasing.
        position: (n,), m; interpolated between steps by cubic Hermite polynomials.
        velocity: (n,), m/s.
    """
    first = np.ceil((crank_angle[0] - np.pi + REACH) / (2 * np.pi) - 1e-9)
    last = np.floor((crank_angle[-1] - np.pi - REACH) / (2 * np.pi) + 1e-9)
    strokes = np.round((crank_angle - np.pi) / (2 * np.pi))
    near = np.abs(crank_angle - np.pi - 2 * np.pi * strokes) <= REACH
    near &= (strokes >= first) & (strokes <= last)
    found = []
    for stroke in np.split(np.flatnonzero(near), np.flatnonzero(np.diff(strokes[near])) + 1):
        if len(stroke):
            lowest = int(stroke[np.argmin(position[stroke])])
            instant, height = _minimum(time, position, velocity, lowest)
            angle = float(np.interp(instant, time, crank_angle))
            found.append(DeadCentre(instant, angle, height))
    return found


def _minimum(time: Array, position: Array, velocity: Array, lowest: int) -> tuple[float, float]:
    """Return instant and position of the minimum about the lowest sample."""
    about = slice(max(0, lowest - 1), lowest + 2)
    best = float(time[lowest]), float(position[lowest])
    if len(time[about]) < 2:
        return best
    curve = CubicHermiteSpline(time[about], position[about], velocity[about])
    turns = curve.derivative().roots(extrapolate=False)
    turns = turns[np.isfinite(turns)]
    return min([best, *zip(turns.tolist(), curve(turns).tolist(), strict=True)], key=lambda p: p[1])
