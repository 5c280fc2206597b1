"""A force that is given over time, crank angle or a position: straight lines between points."""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

__all__ = ["LoadCurve", "blanking_pulse", "closing"]


class LoadCurve:
    """Straight lines through points; a periodic curve joins its last point to its first.

    Before the first and after the last point, the force of a curve without a period stays as it is
    there.

    Attributes:
        places: of the points, increasing.
        forces: at the points, N.
        period: after which the curve repeats itself, or None.

    >>> ramp = LoadCurve([0.0, 0.1], [0.0, 1e3])
    >>> ramp(0.05), ramp(0.2)
    (500.0, 1000.0)
    """

    def __init__(
        self, places: Sequence[float], forces: Sequence[float], period: float | None = None
    ) -> None:
        """Take points that have been checked; those of a period lie within one."""
        self.places, self.forces, self.period = tuple(places), tuple(forces), period
        if period is None:
            self._x, self._f = self.places, self.forces
            self._corners = self.places
        else:
            last, first = self.places[-1] - period, self.places[0] + period
            self._x = (last, *self.places, first)
            self._f = (self.forces[-1], *self.forces, self.forces[0])
            shifts = (-period, 0.0, period)
            self._corners = tuple(place + shift for shift in shifts for place in self.places)

    def __call__(self, place: float) -> float:
        """Return the force, N; of a place that is no number, none either."""
        x, f = self._x, self._f
        place = self._within(place)
        if place != place:
            return place
        if place <= x[0]:
            return f[0]
        if place >= x[-1]:
            return f[-1]
        after = bisect_right(x, place)
        part = (place - x[after - 1]) / (x[after] - x[after - 1])
        return f[after - 1] + part * (f[after] - f[after - 1])

    def corner_after(self, place: float, close: float = 0.0) -> float:
        """Return the next point's place, infinity behind the last; points `close` by are left."""
        within = self._within(place)
        after = bisect_right(self._corners, within + close)
        return place + self._corners[after] - within if after < len(self._corners) else math.inf

    def corner_before(self, place: float, close: float = 0.0) -> float:
        """Return the point before a place, minus infinity before the first."""
        within = self._within(place)
        before = bisect_left(self._corners, within - close)
        return place + self._corners[before - 1] - within if before else -math.inf

    @property
    def peak(self) -> float:
        """Largest magnitude, N."""
        return max(map(abs, self.forces))

    @property
    def steepest(self) -> float:
        """Largest magnitude of the slope, N per unit of the place."""
        return max(abs(self._slope(i)) for i in range(len(self._x) - 1))

    def _slope(self, i: int) -> float:
        width = self._x[i + 1] - self._x[i]
        return (self._f[i + 1] - self._f[i]) / width if width else 0.0

    def _within(self, place: float) -> float:
        """Return a place in the period that begins with the first point."""
        if self.period is None:
            return place
        first = self.places[0]
        return first + (place - first) % self.period


def closing(velocity: float, fade: float) -> float:
    r"""Part of a forming force that acts at a velocity of the ram: none where it opens.

    .. math::
        p = \begin{cases} 0 & v \ge 0 \\ t^2 (3 - 2t), \quad t = -v / v_f & -v_f < v < 0 \\
        1 & v \le -v_f \end{cases}

    Metal that is formed resists the ram and does not push it back. A force that resists, times p,
    takes out energy at every velocity, and it has no jump where the ram turns.

    Parameters
    ----------
    velocity : v of the ram [m/s], positive where it opens
    fade : v_f [m/s], positive

    Returns
    -------
    p [-].

    Notes
    -----
    Range: any velocity. The elastic part of the work, which the ram has back as tool and workpiece
    unload, is left out.

    Examples
    --------
    >>> [closing(velocity, 0.01) for velocity in (-0.2, -0.005, 0.0, 0.2)]
    [1.0, 0.5, 0.0, 0.0]

    References
    ----------
    .. [1] Lange, K. Handbook of Metal Forming. McGraw-Hill, 1985: forming energy is the area under
       the curve of force over stroke.
    """
    if velocity >= 0.0:
        return 0.0
    t = -velocity / fade
    return 1.0 if t >= 1.0 else t * t * (3.0 - 2.0 * t)  # also of no number


def blanking_pulse(peak: float, rise: float, fall: float) -> tuple[list[float], list[float]]:
    r"""Corners of the triangular blanking pulse (Eq. 36).

    .. math::
        F = F_{max} \begin{cases} t / (2 \tau) & 0 < t < 2 \tau \\
        (3 \tau - t) / \tau & 2 \tau \le t < 3 \tau \end{cases}

    The paper prints F_max / t^2 for the rise; F_max / (2 tau) is the triangle it draws.

    Parameters
    ----------
    peak : F_max [N]
    rise : 2 tau [s], positive
    fall : tau [s], positive

    Returns
    -------
    Times [s] and forces [N] of the corners, for a `LoadCurve`.

    Notes
    -----
    Range: any two durations; the paper's are two to one.

    Examples
    --------
    >>> blanking_pulse(10e3, rise=1e-3, fall=0.5e-3)
    ([0.0, 0.001, 0.0015], [0.0, 10000.0, 0.0])

    References
    ----------
    .. [1] The paper's Eq. 36 and Fig. 11 (`CITATION.cff`).
    """
    return [0.0, rise, rise + fall], [0.0, peak, 0.0]
