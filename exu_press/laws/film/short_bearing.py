"""The film of a short bearing: axial flow alone, pressure on the converging half (Gumbel)."""

import math

from exu_press.laws.film.contract import AROUND, AT_REST, OUTSIDE, FilmForce, FilmLaw
from exu_press.laws.parameters import positive

__all__ = ["short"]


def short(length_to_diameter: float) -> FilmLaw:
    r"""Ocvirk's short bearing, exact half film under rotation and squeeze together.

    .. math::
        f_r = -4 (L/D)^2 (\dot\varepsilon J_{cc} - u J_{cs}), \qquad
        f_t = -4 (L/D)^2 (\dot\varepsilon J_{cs} - u J_{ss}), \qquad u = \tfrac12 \varepsilon W

    .. math::
        J_{cc}, J_{cs}, J_{ss} = \int
        \frac{\cos^2\theta,\ \sin\theta \cos\theta,\ \sin^2\theta}{(1-\varepsilon\cos\theta)^3}
        d\theta \quad\text{where}\quad \dot\varepsilon \cos\theta - u \sin\theta > 0

    Sommerfeld's substitution gives the three in closed form without a division by eps. The film
    ends where the integrand vanishes, so they are also the damping: df_r/deps_dot is
    -4 (L/D)^2 J_cc, and so on.

    Parameters
    ----------
    length_to_diameter : L/D of the bearing [-], positive; the law is meant for L/D <= 0.5

    Returns
    -------
    The law, f in 1/s, for 0 <= eps < 1; NaN outside.

    Raises
    ------
    InputError : L/D is not positive

    Notes
    -----
    Cavitation: Gumbel's half film, which for a short bearing is Swift and Stieber's too. It
    overestimates (against `finite`): at L/D = 0.25 by 3 % at eps = 0.1 and 40 % at eps = 0.9, at
    L/D = 0.5 by 10 % and 140 %. The opening force is a difference of large terms: it loses four
    digits at eps = 0.99 and ten at 0.9999.

    Examples
    --------
    Ocvirk's steady load at eps = 0.5, L/D = 0.5: f_r = -eps^2 W / (1 - eps^2)^2 and
    f_t = pi eps W / (4 (1 - eps^2)^1.5), W = 1:

    >>> f_r, f_t, *_ = short(0.5)(0.5, 0.0, 0.5)
    >>> round(f_r, 6), round(f_t, 6)
    (-0.444444, 0.6046)

    References
    ----------
    .. [1] Ocvirk, F. W. "Short-Bearing Approximation for Full Journal Bearings." NACA TN 2808,
       1952.
    .. [2] Childs, D., H. Moes, and H. van Leeuwen. "Journal Bearing Impedance Descriptions for
       Rotordynamic Applications." J. Lubr. Technol. 99, no. 2 (1977): 198-210.
    """
    positive(length_to_diameter=length_to_diameter)
    p = 4.0 * length_to_diameter**2

    def law(eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        if not 0.0 <= eps < 1.0 or not math.isfinite(abs(eps_dot) + abs(eps_w)):
            return OUTSIDE
        if abs(eps_dot) + abs(eps_w) < AT_REST:
            eps_dot = AT_REST
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        s3 = s2 * s
        half_w = 0.5 * eps_w
        rho = math.hypot(eps_dot, half_w)
        u, v = half_w / rho, eps_dot / rho  # the integrals depend on the direction alone
        u2, v2 = u * u, v * v
        q = s2 * u2 + v2
        dq = -2.0 * eps * u2 / q  # each d... is a derivative by eps; this one logarithmic
        arc = math.pi + 2.0 * math.atan2(eps * v, s)
        d_arc = 2.0 * v / (s * q)
        a = eps * s * v / q
        d_a = v * (s - eps * eps / s) / q - a * dq
        m = (s2 * u2 - v2) / q
        d_m = dq * (1.0 - m)
        b = a * m
        d_b = d_a * m + a * d_m

        j_cc = ((eps * eps + 0.5) * arc + 4.0 * a + b) / (s2 * s3)
        j_cs = -2.0 * eps * u2 * u / (q * q)
        j_ss = (0.5 * arc - b) / s3
        d_cc = (2.0 * eps * arc + (eps * eps + 0.5) * d_arc + 4.0 * d_a + d_b) / (s2 * s3)
        d_cc += 5.0 * eps / s2 * j_cc
        d_cs = -2.0 * u2 * u / (q * q) - 2.0 * j_cs * dq
        d_ss = (0.5 * d_arc - d_b) / s3 + 3.0 * eps / s2 * j_ss
        return (
            p * (half_w * j_cs - eps_dot * j_cc),
            p * (half_w * j_ss - eps_dot * j_cs),
            p * (half_w * d_cs - eps_dot * d_cc),
            -p * j_cc,
            0.5 * p * j_cs,
            p * (half_w * d_ss - eps_dot * d_cs),
            -p * j_cs,
            0.5 * p * j_ss,
            AROUND / s,
            AROUND / s * eps / s2,
        )

    return law
