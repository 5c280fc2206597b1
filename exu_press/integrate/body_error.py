"""The error of the bodies' velocities and accelerations in one step; compiled like the joints."""

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

    Velocities: h^3 |second derivative of the acceleration| / 6 against their limit. Accelerations,
    where they are near the body's own largest so far: what they do between two instants,
    h^2 |second derivative| / 8, against the tolerance times that largest, so that the peaks of
    impacts are met. Of each the largest of all bodies, in the kinetic norm
    sqrt(|dx|^2 + (J/m) dphi^2).

    Attributes:
        change: of the accelerations' rate, by the step last tried, in SI over seconds.
    """

    def __init__(
        self,
        accelerations: list[float],
        share: Share,
        tolerance: float,
        scales: FoundScales,
        tuning: Tuning,
        spectral_radius: float,
    ) -> None:
        """Take the bodies and the scales.

        Args:
            accelerations: of all coordinates, at the beginning of the first step.
            share: what a velocity may be off by in one step, over the scale of speeds.
            tolerance: what a peak may be off by, over itself, if that is at most `loosest_peak`.
            scales: of the motion, which knows the bodies.
            tuning: numbers.
            spectral_radius: at infinity, of generalized-alpha.
        """
        self._scales, self._share = scales, share
        self._noise = tuning.rounding * scales.length / (1.0 - min(spectral_radius, 0.95)) ** 2
        self._constant, self._finer = tuning.velocity_constant, tuning.finer_for_peaks**3
        self._near = tuning.near_peak * tuning.near_peak
        self._of_peak = min(tolerance, tuning.loosest_peak)
        self._before = self._now = accelerations
        self._rate_before: list[float] = []  # none before the first step
        self._rate: list[float] = []
        self._peaks_before = [0.0 for _ in scales.masses]  # squares of the largest so far
        self._peaks = self._peaks_before
        self._sizes = self._sizes_before = self._squares(accelerations)
        self._allowed: list[float] = []  # squares of what peaks may be off by, in the step tried
        self.change: list[float] = []

    def tried(self, now: list[float], step: float) -> float:
        """Return the error of a step (s) that ends with these accelerations."""
        self._now = now
        before, last = self._before, self._rate_before
        self._rate = rate = [(now[i] - before[i]) / step for i in range(len(now))]
        self._sizes, self._peaks, self._allowed = self._squares(now), [], []
        if last:
            self.change = [rate[i] - last[i] for i in range(len(rate))]
        else:
            part = step * self._part_changed(rate)
            self.change = [part * value for value in rate]
        usual = self._scales.acceleration * self._scales.acceleration
        for i, size in enumerate(self._sizes):
            self._peaks.append(max(size, self._peaks_before[i]))
            peak = max(self._peaks[i], usual)
            near = max(size, self._sizes_before[i]) >= self._near * peak
            self._allowed.append(self._of_peak * self._of_peak * peak if near else math.inf)
        return self.error(self.change, step)

    def _part_changed(self, rate: list[float]) -> float:
        """Return the rate of the accelerations, in the first step, over them: at most one a step.

        What it changes by within the step is not known yet: as much as the accelerations do.
        """
        largest = max(max(self._sizes, default=0.0), max(self._sizes_before, default=0.0))
        change = max(self._squares(rate), default=0.0)
        return math.sqrt(change / largest) if change > 0.0 else 0.0

    def error(self, change: list[float], step: float) -> float:
        """Return the error that goes with a change of the accelerations' rate."""
        sizes = self._squares(change)
        return max(self._of_velocities(sizes, step), self._of_peaks(sizes, step))

    def of_peaks(self, step: float) -> float:
        """Return the error of accelerations near their peaks, in the step last tried.

        Where constraints prescribe them too, and whatever makes them alternate.
        """
        return self._of_peaks(self._squares(self.change), step)

    def _of_velocities(self, sizes: list[float], step: float) -> float:
        """Return the velocities' error from squares of changes of the accelerations' rate."""
        limit = max(self._share.at(step) * self._scales.speed, self._constant * self._noise / step)
        largest = 0.0
        for size in sizes:  # what has no say may be no number, and is passed over
            largest = max(largest, size)
        return self._constant * step * step * math.sqrt(largest) / limit

    def _of_peaks(self, sizes: list[float], step: float) -> float:
        """Return the peaks' error, as the step's cube, from squares of changes of the rate.

        It is bounded by the velocities' error: an acceleration that jumps, as where a step that is
        changed ends the alternation of the longer ones before it, jumps in the shortest step too.
        """
        relative = 0.0
        rounding = (self._noise / (step * step)) ** 2
        for i in range(len(sizes)):
            relative = max(relative, sizes[i] / max(self._allowed[i], rounding))
        peaks = math.pow(0.125 * step * math.sqrt(relative), 1.5)
        return min(peaks, self._finer * self._of_velocities(sizes, step))

    def of_jump(self) -> float:
        """Return the largest change of an acceleration in the step last tried, m/s^2."""
        jump = [a - b for a, b in zip(self._now, self._before, strict=True)]
        return math.sqrt(max(self._squares(jump), default=0.0))

    def largest(self) -> float:
        """Return the largest acceleration at the two ends of the step last tried, m/s^2."""
        return math.sqrt(max([*self._sizes, *self._sizes_before], default=0.0))

    def offset(self, step: float) -> float:
        """Return what velocities that constraints prescribe are off by at each instant, m/s.

        They follow from two positions: h^2 |rate of the acceleration| / 12.
        """
        return step * step * math.sqrt(max(self._squares(self._rate), default=0.0)) / 12.0

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._rate_before = self._now, self._rate
        self._peaks_before, self._sizes_before = self._peaks, self._sizes

    def _squares(self, vector: list[float]) -> list[float]:
        """Return the squares of each body's kinetic norm."""
        return squares(self._scales, vector)
