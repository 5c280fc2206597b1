"""The error of the bodies' velocities in one step; compiled like the joints."""

import math

from exu_press.integrate.scales import FoundScales
from exu_press.integrate.share import Share
from exu_press.integrate.tuning import Tuning

__all__ = ["BodyError", "squares"]


def squares(scales: FoundScales, vector: list[float]) -> list[float]:
    """Return the squares of each body's kinetic norm of a vector over all coordinates."""
    found: list[float] = []
    i = 0
    inertias, ends, masses = scales.inertias, scales.ends, scales.masses
    for body in range(len(ends)):
        twice_energy = 0.0
        while i < ends[body]:
            twice_energy += inertias[i] * vector[i] * vector[i]
            i += 1
        mass = masses[body]
        found.append(twice_energy / mass if mass > 0.0 else 0.0)
    return found


class BodyError:
    """Tells from the accelerations at three instants what a step missed; 1 is what it may.

    h^3 |second derivative of the acceleration| / 6 against what velocities may be off by; the
    largest of all bodies, in the kinetic norm sqrt(|dx|^2 + (J/m) dphi^2).

    Attributes:
        change: of the accelerations' rate, by the step last tried, in SI over seconds.
    """

    def __init__(
        self,
        accelerations: list[float],
        share: Share,
        scales: FoundScales,
        tuning: Tuning,
        spectral_radius: float,
    ) -> None:
        """Take the bodies and the scales.

        Args:
            accelerations: of all coordinates, at the beginning of the first step.
            share: what a velocity may be off by in one step, over the scale of speeds.
            scales: of the motion, which knows the bodies.
            tuning: numbers.
            spectral_radius: at infinity, of generalized-alpha.
        """
        self._scales, self._share = scales, share
        self._noise = tuning.rounding * scales.length / (1.0 - min(spectral_radius, 0.95)) ** 2
        self._constant = tuning.velocity_constant
        self._before = self._now = accelerations
        self._rate_before: list[float] = []  # none before the first step
        self._rate: list[float] = []
        self.change: list[float] = []

    def tried(self, now: list[float], step: float) -> float:
        """Return the error of a step (s) that ends with these accelerations."""
        self._now = now
        before, last = self._before, self._rate_before
        self._rate = rate = [(now[i] - before[i]) / step for i in range(len(now))]
        if last:
            self.change = [rate[i] - last[i] for i in range(len(rate))]
        else:
            part = step * self._part_changed(rate)
            self.change = [part * value for value in rate]
        return self.error(self.change, step)

    def _part_changed(self, rate: list[float]) -> float:
        """Return the rate of the accelerations, in the first step, over them: at most one a step.

        What it changes by within the step is not known yet: as much as the accelerations do.
        """
        change, largest = self._largest(rate), self.largest()
        return change / largest if change > 0.0 else 0.0

    def error(self, change: list[float], step: float) -> float:
        """Return the error that goes with a change of the accelerations' rate."""
        limit = max(self._share.at(step) * self._scales.speed, self._constant * self._noise / step)
        return self._constant * step * step * self._largest(change) / limit

    def of_jump(self) -> float:
        """Return the largest change of an acceleration in the step last tried, m/s^2."""
        return self._largest([a - b for a, b in zip(self._now, self._before, strict=True)])

    def largest(self) -> float:
        """Return the largest acceleration at the two ends of the step last tried, m/s^2."""
        return max(self._largest(self._now), self._largest(self._before))

    def offset(self, step: float) -> float:
        """Return what velocities that constraints prescribe are off by at each instant, m/s.

        They follow from two positions: h^2 |rate of the acceleration| / 12.
        """
        return step * step * self._largest(self._rate) / 12.0

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._rate_before = self._now, self._rate

    def _largest(self, vector: list[float]) -> float:
        """Return the largest kinetic norm of a body; what has no say may be no number."""
        largest = 0.0
        for square in squares(self._scales, vector):
            largest = max(largest, square)
        return math.sqrt(largest)
