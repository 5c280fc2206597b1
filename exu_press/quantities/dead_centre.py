"""The bottom dead centre of every stroke."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from exu_press.mechanism import Mechanism
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import hermite
from exu_press.result import Result
from exu_press.result.windows import NEARLY
from exu_press.scene import mechanism_of

__all__ = [
    "DeadCentre",
    "behind_cut_centre",
    "bottom_dead_centres",
    "ideal_angles",
    "lowest",
    "lowest_of_strokes",
]

REACH = np.pi / 2
"""A stroke's dead centre is looked for this far before and behind the ideal one, rad: clearances
shift it by degrees."""


@dataclass(frozen=True)
class DeadCentre:
    """The slider's bottom dead centre in one stroke.

    Attributes:
        time: s.
        crank_angle: from top dead centre, going on over revolutions, rad.
        position: m.
    """

    time: float
    crank_angle: float
    position: float


def bottom_dead_centres(result: Result) -> list[DeadCentre]:
    """Return the lowest position of every stroke that a run holds; strokes are the crank's."""
    return lowest_of_strokes(
        result.time,
        result["crank_angle"],
        result["slider_position"],
        result["slider_velocity"],
        about=ideal_angles(mechanism_of(result.scene))[0],
    )


@lru_cache(maxsize=16)  # errors take six summaries of a scene, and this is most of a short one's
def ideal_angles(mechanism: Mechanism) -> tuple[float, float]:
    """Return the crank angles at which the ideal slider is lowest and highest, to 0.5 deg, rad."""
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    position = mechanism.ideal_slider(angle, speed=1.0)[0]
    return float(angle[np.argmin(position)]), float(angle[np.argmax(position)])


def behind_cut_centre(crank_angle: Array, about: float) -> int:
    """Return the first instant behind a dead centre that the record's beginning cuts.

    A run that begins on a dead centre has its start's transient there. 0 where none is cut, or
    where the record does not come to that dead centre again.

    Args:
        crank_angle: (n,), rad, increasing.
        about: crank angle of the ideal dead centre, rad.
    """
    first = float(crank_angle[0])
    past = (first - about + REACH) % (2.0 * np.pi)
    again = first - past + REACH + 2.0 * np.pi
    near = 2.0 * np.pi * NEARLY
    if not near < past < 2.0 * REACH or crank_angle[-1] < again - near:
        return 0
    return int(np.searchsorted(crank_angle, first - past + 2.0 * REACH))


def lowest_of_strokes(
    time: Array, crank_angle: Array, position: Array, velocity: Array, *, about: float
) -> list[DeadCentre]:
    """Return the lowest position of every stroke that a record holds.

    Args:
        time: (n,), s, increasing.
        crank_angle: (n,), rad, increasing.
        position: (n,), m; interpolated between steps by cubic Hermite polynomials.
        velocity: (n,), m/s.
        about: crank angle at which the ideal slider is lowest, rad.
    """
    first = np.ceil((crank_angle[0] - about + REACH) / (2 * np.pi) - NEARLY)
    last = np.floor((crank_angle[-1] - about - REACH) / (2 * np.pi) + NEARLY)
    strokes = np.round((crank_angle - about) / (2 * np.pi))
    near = np.abs(crank_angle - about - 2 * np.pi * strokes) <= REACH
    near &= (strokes >= first) & (strokes <= last)
    dead_centres = []
    for stroke in np.split(np.flatnonzero(near), np.flatnonzero(np.diff(strokes[near])) + 1):
        if len(stroke):
            at = slice(stroke[0], stroke[-1] + 1)
            instant, height = lowest(time[at], position[at], velocity[at])
            angle = float(np.interp(instant, time[at], crank_angle[at]))
            dead_centres.append(DeadCentre(instant, angle, height))
    return dead_centres


def lowest(time: Array, position: Array, velocity: Array) -> tuple[float, float]:
    """Return instant, s, and value, m, of the least position, by cubics between steps (n,)."""
    at = int(np.argmin(position))
    candidates = [(float(position[at]), float(time[at]))]
    time, position, velocity = (
        values[max(0, at - 1) : at + 2] for values in (time, position, velocity)
    )
    for start, length, (c0, c1, c2, c3) in zip(
        time[:-1], np.diff(time), hermite(time, position, velocity).T, strict=True
    ):
        turns = np.roots([3.0 * c3, 2.0 * c2, c1])
        for turn in turns[np.isreal(turns)].real:
            if 0.0 <= turn <= length:
                height = ((c3 * turn + c2) * turn + c1) * turn + c0
                candidates.append((float(height), float(start + turn)))
    height, instant = min(candidates)
    return instant, height
