"""The worn depth of a surface over the angle on it: a smooth periodic function of a table."""

import math
from bisect import bisect_right
from collections.abc import Sequence

__all__ = ["Profile", "profile"]

WHOLE = 2.0 * math.pi

FINE = 8
"""Places within each interval of a table at which its sharpest bend is looked for."""


class Profile:
    """A periodic cubic spline w(angle): two derivatives are continuous, as Newton's method asks.

    Attributes:
        mean: of w around the surface, m.
        sharpest: the least w + w'' around the surface, m.
    """

    def __init__(
        self, knots: Sequence[float], pieces: Sequence[Sequence[float]], mean: float
    ) -> None:
        """Take a spline's pieces; `profile` makes them of a table.

        Args:
            knots: the first angle of each piece, rad, within one turn.
            pieces: by knot: w, w', w'' / 2 and w''' / 6 there, m and rad.
            mean: of w, m.
        """
        self._knots = [float(knot) for knot in knots]
        self._pieces = [tuple([float(value) for value in piece]) for piece in pieces]
        self.mean = mean
        ends = [*self._knots[1:], self._knots[0] + WHOLE]
        least = math.inf
        for knot, end in zip(self._knots, ends, strict=True):
            for i in range(FINE):
                depth, _, bend = self.derivatives(knot + (end - knot) * i / FINE)
                least = min(least, depth + bend)
        self.sharpest = least

    def derivatives(self, angle: float) -> tuple[float, float, float]:
        """Return w (m), w' and w'' (m/rad, m/rad^2) at an angle (rad); NaN at no number."""
        if not -1e12 < angle < 1e12:
            return math.nan, math.nan, math.nan
        first = self._knots[0]
        beyond = (angle - first) % WHOLE
        i = bisect_right(self._knots, first + beyond) - 1
        a, b, c, d = self._pieces[i]
        s = first + beyond - self._knots[i]
        return a + s * (b + s * (c + s * d)), b + s * (2.0 * c + 3.0 * s * d), 2.0 * c + 6.0 * d * s


def profile(angles: Sequence[float], depths: Sequence[float], less: float = 0.0) -> Profile:
    r"""Return the smooth periodic profile through a table of depths.

    .. math::
        w(\varphi_i) = w_i, \qquad w(\varphi + 2\pi) = w(\varphi)

    Parameters
    ----------
    angles : on the surface, increasing, within one turn [rad]; at least three
    depths : as many [m]
    less : taken off all depths [m]

    Returns
    -------
    The profile; equal depths give a constant to the last digit.

    Notes
    -----
    Range: depths far below the radius, that change little from one angle to the next: a cubic
    spline swings over a step.

    Examples
    --------
    >>> dent = profile([0.0, 2.0, 4.0], [1e-5, 0.0, 0.0])
    >>> [round(value * 1e6, 3) for value in dent.derivatives(2.0 * math.pi)][:1]
    [10.0]
    >>> profile([0.0, 2.0, 4.0], [1e-5, 1e-5, 1e-5]).derivatives(1.0)
    (1e-05, 0.0, 0.0)
    """
    least, most = min(depths), max(depths)
    if least == most:
        return Profile([angles[0]], [[least - less, 0.0, 0.0, 0.0]], least - less)
    from scipy.interpolate import CubicSpline  # type: ignore[import-untyped, unused-ignore]

    closed = [*angles, angles[0] + WHOLE]
    spline = CubicSpline(closed, [*depths, depths[0]], bc_type="periodic")
    mean = float(spline.integrate(closed[0], closed[-1])) / WHOLE
    pieces = [[a - less, b, c, d] for d, c, b, a in spline.c.T.tolist()]
    return Profile(list(angles), pieces, mean - less)
