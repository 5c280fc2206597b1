"""Crank angles at which a motion is sampled, revolution by revolution: a Poincare section."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Section"]

TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Section:
    """Crank angles at which every revolution is sampled.

    Attributes:
        angles: from 0 to 2 pi, rad, increasing.
        start: crank angle at which the run starts, rad.
    """

    angles: Sequence[float]
    start: float

    def next_sample(self, turned: float, near: float) -> float:
        """Return how far the crank turns from the start to its next sample, rad.

        >>> round(Section([1.0, 2.0], start=0.5).next_sample(0.5, 1e-9), 12)
        1.5

        Args:
            turned: since the start, rad.
            near: samples closer than this are passed, rad.
        """
        distances = [(angle - self.start - turned - near) % TURN + near for angle in self.angles]
        return turned + min(distances)

    def event_function(self, angle: float) -> float:
        """Return a number that changes its sign wherever the crank (angle in rad) is sampled."""
        return math.prod(math.sin(0.5 * (angle - sample)) for sample in self.angles)

    def samples(self, turned: float) -> tuple[Array, Array]:
        """Return the samples of a crank that has turned so far, rad.

        Returns:
            turned since the start at each of them, (m,), rad, increasing; and the number of its
            angle, (m,).
        """
        samples = sorted(
            (first + TURN * turn, number)
            for number, angle in enumerate(self.angles)
            for first in [(angle - self.start) % TURN]
            for turn in range(max(0, math.floor((turned - first) / TURN + 1e-9) + 1))
        )
        return np.array([at for at, _ in samples]), np.array([n for _, n in samples], dtype=int)
