"""The film between a ball and its socket, rotation and squeeze together, from a table."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from exu_press.laws.film.asperities import effective_ratio, with_asperities
from exu_press.laws.film.contract import FilmLaw
from exu_press.laws.film.finite_bearing import interpolation_table, tabulated_law
from exu_press.laws.parameters import demand

__all__ = ["NARROWEST_CAP", "WIDEST_CAP", "BallFilm", "ball", "socket_drag"]

TABLE = Path(__file__).with_name("ball.npz")

NARROWEST_CAP, WIDEST_CAP = 0.25 * math.pi, 0.5 * math.pi
"""rad"""

SMALL = 0.05
"""Eccentricity ratio below which the drag's integrals are summed up by powers of it."""


class BallFilm(NamedTuple):
    """A ball's film: a film law, and the drag of a ball that spins in its film.

    Attributes:
        law: film law; its drag is that of a rotation across the eccentricity.
        spin: eps -> j of a rotation about the eccentricity, and dj by eps.
    """

    law: FilmLaw
    spin: Callable[[float], tuple[float, float]]


def ball(cap_angle: float = WIDEST_CAP, onset_ratio: float | None = None) -> BallFilm:
    r"""Film of a ball in a socket of two caps, cup and retainer, under rotation and squeeze.

    .. math::
        \nabla \cdot (h^3 \nabla p) = -12 \mu\, \mathbf v \cdot \mathbf r, \qquad
        h = 1 - \boldsymbol\varepsilon \cdot \mathbf r, \qquad
        \mathbf v = \dot{\boldsymbol\varepsilon}
        - \tfrac12 (\boldsymbol\omega_J + \boldsymbol\omega_B) \times \boldsymbol\varepsilon

    on the unit sphere. Rotation and squeeze enter through v alone, so the film has the two speeds
    of a journal's, eps_dot along the eccentricity and eps W = -2 v_t across it. The scale P of
    its force is `film_scale` with the radius for the length, P = mu R^4 / c^2, and so is that of
    its drag.

    Parameters
    ----------
    cap_angle : beta [rad], from a cap's middle to its edge, pi/4 to pi/2; with pi/2 the two caps
        are hemispheres and cover the ball
    onset_ratio : h_on / c where asperities share the load, as `with_asperities` has it [-]; None
        for smooth surfaces

    Returns
    -------
    The law, f in 1/s, for 0 <= eps < 1, NaN outside, or for every eps with an onset; and the drag.

    Raises
    ------
    InputError : cap_angle is not in pi/4 to pi/2, or onset_ratio not in 0 to 1

    Notes
    -----
    The cap that bears the load faces it: its middle lies in the direction in which the film
    presses. So sockets are built, and so the mobility method takes them [1]_. A socket that stands
    still while its load turns around it is not meant. p = 0 at the cap's edge, where the oil comes
    in; Swift and Stieber's cavitation inside. The other cap is full of oil without pressure.

    Squeeze alone has the closed form (eps_dot > 0; an opening film is that of -eps)

    .. math::
        p = \frac{3 \dot\varepsilon}{\varepsilon}
        \left[(1 - \varepsilon\cos\psi)^{-2} - (1 - \varepsilon\cos\beta)^{-2}\right], \quad
        f_r = -2\pi \int_0^\beta p \sin\psi\cos\psi\, d\psi

    with f_r = -4 pi eps_dot at eps = 0 and beta = pi/2, and f_r -> -6 pi eps_dot / (1 - eps).

    Accuracy: squeeze within 0.5 % of the closed form. Between the knots the law is within 0.2 % of
    `facing_load` [3]_ for most states, and within 3 % where the film closes or slides
    (scripts/tabulate_ball_film.py --check). Where a ball leaves the wall almost straight, its weak
    force changes its direction within a few degrees of the motion, and the table smooths it.
    Curvature is left out, of order c / R.

    Examples
    --------
    >>> film = ball().law
    >>> round(film(0.0, 1.0, 0.0)[0] / math.pi, 2)
    -4.01

    References
    ----------
    .. [1] Goenka, P. K., and J. F. Booker. "Spherical Bearings: Static and Dynamic Analysis via
       the Finite Element Method." J. Lubr. Technol. 102, no. 3 (1980): 308-318.
    .. [2] Pinkus, O., and B. Sternlicht. Theory of Hydrodynamic Lubrication. McGraw-Hill, 1961.
    .. [3] scripts/tabulation/reynolds_sphere.py, tabulated by scripts/tabulate_ball_film.py.
    """
    demand(
        NARROWEST_CAP - 1e-9 <= cap_angle <= WIDEST_CAP + 1e-9,
        "cap_angle",
        cap_angle,
        "pi/4 <= cap_angle <= pi/2",
        "Reynolds' equation, tabulated",
    )
    across, spin = socket_drag(cap_angle)
    law = tabulated_law(interpolation_table(TABLE, "angle", cap_angle), across)
    if onset_ratio is None:
        return BallFilm(law, spin)
    onset = 1.0 - onset_ratio

    def mixed_spin(eps: float) -> tuple[float, float]:
        if not eps > onset:
            return spin(eps)
        effective, slope, _ = effective_ratio(eps, onset_ratio)
        j, d_j = spin(effective)
        return j, slope * d_j

    return BallFilm(with_asperities(law, onset_ratio), mixed_spin)


def socket_drag(
    cap_angle: float,
) -> tuple[Callable[[float], tuple[float, float]], Callable[[float], tuple[float, float]]]:
    r"""Drag of a ball that turns in a socket full of oil: j across, and along the eccentricity.

    .. math::
        j_{\perp} = \pi \int \frac{1 + x^2}{1 - \varepsilon x} dx, \qquad
        j_{\parallel} = 2 \pi \int \frac{1 - x^2}{1 - \varepsilon x} dx, \qquad
        \cos\beta \le \lvert x \rvert \le 1

    The couple on the ball is -P c j (omega_J - omega_B), by its parts across and along e.

    Parameters
    ----------
    cap_angle : beta of both caps, whose middles lie along the eccentricity [rad]

    Returns
    -------
    Two functions of eps, 0 <= eps < 1, each with its derivative by eps; NaN outside.

    Examples
    --------
    A ball in the middle of a closed socket has 8 pi / 3 about any axis:

    >>> [round(drag(0.0)[0] / math.pi, 6) for drag in socket_drag(0.5 * math.pi)]
    [2.666667, 2.666667]

    References
    ----------
    .. [1] Landau, L. D., and E. M. Lifshitz. Fluid Mechanics. Section 20, problem 1: two spheres
       about one centre, 8 pi mu R^4 / (3 c) for a thin gap.
    """
    low = math.cos(cap_angle) if cap_angle < WIDEST_CAP else 0.0
    width = 1.0 - low
    powers = [(1.0 - low ** (2 * k + 1)) / (2 * k + 1) for k in range(7)]

    def integrals(eps: float) -> tuple[float, float, float, float]:
        """Return integrals of 1 / (1 - eps^2 x^2) and x^2 times it over a cap, with derivatives."""
        if not 0.0 <= eps < 1.0:
            return (math.nan,) * 4
        square = eps * eps
        if eps < SMALL:
            plain = squared = d_plain = d_squared = 0.0
            for k in range(5, -1, -1):
                plain = plain * square + powers[k]
                squared = squared * square + powers[k + 1]
            for k in range(5, 0, -1):
                d_plain = d_plain * square + 2 * k * powers[k]
                d_squared = d_squared * square + 2 * k * powers[k + 1]
            return plain, squared, d_plain * eps, d_squared * eps
        plain = (math.atanh(eps) - math.atanh(eps * low)) / eps
        squared = (plain - width) / square
        slope = 1.0 / ((1.0 - eps) * (1.0 + eps)) - low / (1.0 - square * low * low)
        d_plain = (slope - plain) / eps
        return plain, squared, d_plain, (d_plain - 2.0 * eps * squared) / square

    def drag_across(eps: float) -> tuple[float, float]:
        plain, squared, d_plain, d_squared = integrals(eps)
        return 2.0 * math.pi * (plain + squared), 2.0 * math.pi * (d_plain + d_squared)

    def drag_along(eps: float) -> tuple[float, float]:
        plain, squared, d_plain, d_squared = integrals(eps)
        return 4.0 * math.pi * (plain - squared), 4.0 * math.pi * (d_plain - d_squared)

    return drag_across, drag_along
