"""A force that is given over time, crank angle or a position: straight lines between points."""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

__all__ = ["REVOLUTION", "LoadCurve", "PulseClock", "blanking_pulse", "closing"]


REVOLUTION = 2.0 * math.pi


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
            self._x = (*self.places, self.places[0] + period)
            self._f = (*self.forces, self.forces[0])
            shifts = (-period, 0.0, period)
            self._corners = tuple(point + shift for shift in shifts for point in self.places)

    def __call__(self, x_value: float) -> float:
        """Return the force, N; of a place that is no number, none either."""
        x, f = self._x, self._f
        x_value = self._in_period(x_value)
        if x_value != x_value:
            return x_value
        if x_value <= x[0]:
            return f[0]
        if x_value >= x[-1]:
            return f[-1]
        after = bisect_right(x, x_value)
        fraction = (x_value - x[after - 1]) / (x[after] - x[after - 1])
        return f[after - 1] + fraction * (f[after] - f[after - 1])

    def corner_after(self, x: float, close: float = 0.0) -> float:
        """Return the next point, infinity after the last; points within `close` are skipped."""
        within = self._in_period(x)
        after = bisect_right(self._corners, within + close)
        return x + self._corners[after] - within if after < len(self._corners) else math.inf

    def corner_before(self, x: float, close: float = 0.0) -> float:
        """Return the point before, minus infinity before the first."""
        within = self._in_period(x)
        index = bisect_left(self._corners, within - close)
        return x + self._corners[index - 1] - within if index else -math.inf

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

    def _in_period(self, x: float) -> float:
        """Return x, in the period that begins with the first point."""
        if self.period is None:
            return x
        first = self.places[0]
        return first + (x - first) % self.period


class PulseClock:
    """Time since the beginning of a pulse that comes once a revolution of a crank of any speed.

    The pulse lasts a time, not an angle. An angle at its beginning or its end fixes its place. An
    end is foreseen from the speed at which the pulse begins.

    >>> clock = PulseClock(0.2, 3.0, at_end=False, now=2.0, speed=5.0)
    >>> clock.since_begin(0.0, 2.0, 5.0), clock.since_begin(0.3, 3.5, 5.0)
    (-0.2, 0.1)
    >>> clock.accept(0.3, 3.5, 5.0)  # it has begun, and goes on in time
    >>> round(clock.since_begin(0.35, 3.5, 0.0), 12)
    0.15
    """

    def __init__(
        self, duration: float, angle: float, *, at_end: bool, now: float, speed: float
    ) -> None:
        """Wait for the next pulse.

        Args:
            duration: of a pulse, s.
            angle: of the crank at its beginning or end, rad, in any revolution.
            at_end: whether that is at its end.
            now: the crank's angle at the start, rad.
            speed: its angular velocity there, rad/s.
        """
        self._duration, self._at_end = duration, at_end
        ends = angle if at_end else angle + speed * duration
        self._angle = angle + REVOLUTION * (
            math.floor((now - ends) / REVOLUTION) + 1.0
        )  # of the next pulse
        self._begun: float | None = None

    def since_begin(self, time: float, angle: float, speed: float) -> float:
        """Return the time since the pulse began, s; negative before, minus infinity at rest.

        Args:
            time: s.
            angle: of the crank, rad.
            speed: of the crank, rad/s.
        """
        if self._begun is not None:
            return time - self._begun
        if speed <= 0.0:
            return -math.inf
        elapsed = (angle - self._angle) / speed
        return elapsed + self._duration if self._at_end else elapsed

    def memory(self) -> tuple[float, float | None]:
        """Return the angle of the next pulse and when the pulse under way began."""
        return self._angle, self._begun

    def recall(self, memory: tuple[float, float | None]) -> None:
        """Take over another clock's memory."""
        self._angle, self._begun = memory

    def accept(self, time: float, angle: float, speed: float) -> None:
        """Keep the state at the end of a step."""
        elapsed = self.since_begin(time, angle, speed)
        if self._begun is None and elapsed >= 0.0:
            self._begun = time - elapsed
        if self._begun is not None and elapsed >= self._duration:
            self._begun = None
            self._angle += REVOLUTION


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
