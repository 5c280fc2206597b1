"""The film of a long bearing: no axial flow, pressure on the converging half alone (Gumbel)."""

import math

from exu_press.laws.film.contract import AROUND, AT_REST, OUTSIDE, FilmForce, FilmLaw

__all__ = ["pi_film", "pinkus"]


def pinkus() -> FilmLaw:
    r"""Pinkus and Sternlicht's film of a long bearing, with the sign of |eps_dot| corrected.

    .. math::
        f_r = -\frac{24\, \varepsilon S}{(2+\varepsilon^2) s^3}
        - \frac{6 \pi X \dot\varepsilon}{s^3}, \qquad
        f_t = \frac{6 \pi X\, \varepsilon W}{(2+\varepsilon^2) s}, \qquad
        X = 1 + \frac{3\, \varepsilon \dot\varepsilon}{2 S + 3\, \varepsilon |\dot\varepsilon|}

    with s = sqrt(1 - eps^2) and S = s sqrt(eps_dot^2 + (eps W)^2 / 4). This is the paper's Eq. 35
    (k = S / (eps |eps_dot|), X = (k+3)/(k+1.5) closing and k/(k+1.5) opening) made regular at
    eps = 0 and at eps_dot = 0. The paper prints eps_dot for |eps_dot| in Eq. 35a: that form jumps
    at eps_dot = 0 and feeds energy in, and nothing here can reach it.

    Returns
    -------
    The law, f in 1/s, for 0 <= eps < 1; NaN outside.

    Notes
    -----
    Cavitation: Gumbel's half film. S and X approximate the exact integral (`pi_film`): closing
    4 % off on average and 8.7 % at most (squeeze alone at eps = 0.27); opening 26 % up to
    eps = 0.8, and from 0.9 on a multiple of a small force. For L/D > 2, see `pi_film`.

    Examples
    --------
    At eps = 0 an isotropic damper, f_r = -6 pi eps_dot:

    >>> f_r, f_t, *_ = pinkus()(0.0, 1.0, 0.0)
    >>> round(f_r / math.pi, 12), f_t
    (-6.0, 0.0)

    References
    ----------
    .. [1] Pinkus, O., and B. Sternlicht. Theory of Hydrodynamic Lubrication. McGraw-Hill, 1961.
    .. [2] Flores, P., et al. "Dynamic Behaviour of Planar Rigid Multi-Body Systems Including
       Revolute Joints with Clearance." Proc. IMechE K 221 (2007): 161-174.
    """

    def law(eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        if not 0.0 <= eps < 1.0 or not math.isfinite(abs(eps_dot) + abs(eps_w)):
            return OUTSIDE
        if abs(eps_dot) + abs(eps_w) < AT_REST:
            eps_dot = AT_REST
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        n = 2.0 + eps * eps
        rho = math.hypot(eps_dot, 0.5 * eps_w)
        d = s * rho + 1.5 * eps * abs(eps_dot)
        x = 1.0 + 1.5 * eps * eps_dot / d
        k = 1.5 / (d * d)  # of x's derivatives, in which d's cancel to
        dx_eps = k * rho / s * eps_dot
        k *= 0.25 * eps * s / rho * eps_w
        dx_dot, dx_w = k * eps_w, -k * eps_dot

        wedge = 24.0 * eps / (n * s2)  # times S / s
        squeeze = 6.0 * math.pi / (s2 * s)
        turn = 6.0 * math.pi / (n * s)
        drag, push = turn * eps_w, squeeze * eps_dot
        d_wedge = 24.0 / (n * s2) * (1.0 + 2.0 * eps * eps * (1.0 / s2 - 1.0 / n))
        return (
            -wedge * rho - push * x,
            drag * x,
            -d_wedge * rho - push * (3.0 * eps / s2 * x + dx_eps),
            -wedge * eps_dot / rho - squeeze * x - push * dx_dot,
            -0.25 * wedge * eps_w / rho - push * dx_w,
            drag * (eps * (1.0 / s2 - 2.0 / n) * x + dx_eps),
            drag * dx_dot,
            turn * x + drag * dx_w,
            AROUND / s,
            AROUND / s * eps / s2,
        )

    return law


def pi_film() -> FilmLaw:
    r"""Exact half film of a long bearing under rotation and squeeze together.

    .. math::
        f_r = -\frac{12\, \varepsilon S}{s^3} - \frac{6 \pi X \dot\varepsilon}{s^3}, \qquad
        f_t = \frac{6 \pi X w}{s}, \qquad
        X = 1 + \frac{2}{\pi} \arctan\frac{\varepsilon \dot\varepsilon}{S}

    with s = sqrt(1 - eps^2), w = eps W / (2 + eps^2) and S = s sqrt(eps_dot^2 + w^2): the integral
    of Sommerfeld's periodic pressure over the half circle between its zeros.

    Returns
    -------
    The law, f in 1/s, for 0 <= eps < 1; NaN outside.

    Notes
    -----
    Cavitation: Gumbel's half film. Agrees with direct integration of Reynolds' equation to
    rounding. Smooth everywhere except at rest. For L/D > 2: against `finite` it overestimates
    rotation and closing at L/D = 2 by 50 % at eps = 0.1 and 10 % at 0.9, and at L/D = 4 lies
    within 15 %.

    Examples
    --------
    Steady rotation at eps = 0.5: f_r = -12 eps^2 W / ((2 + eps^2) (1 - eps^2)), W = 1:

    >>> f_r, f_t, *_ = pi_film()(0.5, 0.0, 0.5)
    >>> round(f_r, 6), round(f_t, 6)
    (-1.777778, 4.836798)

    References
    ----------
    .. [1] Sommerfeld, A. "Zur hydrodynamischen Theorie der Schmiermittelreibung." Z. Math. Phys.
       50 (1904): 97-155.
    .. [2] Pinkus, O., and B. Sternlicht. Theory of Hydrodynamic Lubrication. McGraw-Hill, 1961.
    """

    def law(eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        if not 0.0 <= eps < 1.0 or not math.isfinite(abs(eps_dot) + abs(eps_w)):
            return OUTSIDE
        if abs(eps_dot) + abs(eps_w) < AT_REST:
            eps_dot = AT_REST
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        n = 2.0 + eps * eps
        w = eps_w / n
        rho = math.hypot(eps_dot, w)
        u, v = w / rho, eps_dot / rho
        big_s = s * rho
        dw_eps = -2.0 * eps * w / n
        ds_eps = -eps * rho / s + s * u * dw_eps

        q = s2 * u * u + v * v
        x = 1.0 + 2.0 / math.pi * math.atan2(eps * v, s)
        gain = 2.0 / math.pi * eps * s * u / (q * rho)
        dx_w = -gain * v
        dx_eps = 2.0 / math.pi * v / (s * q) + dx_w * dw_eps
        dx_dot = gain * u

        wedge = 12.0 * eps / (s2 * s)
        squeeze = 6.0 * math.pi / (s2 * s)
        turn = 6.0 * math.pi / s
        f_r = -wedge * big_s - squeeze * eps_dot * x
        f_t = turn * w * x
        return (
            f_r,
            f_t,
            f_r * 3.0 * eps / s2
            - 12.0 * big_s / (s2 * s)
            - wedge * ds_eps
            - squeeze * eps_dot * dx_eps,
            -wedge * s * v - squeeze * (x + eps_dot * dx_dot),
            (-wedge * s * u - squeeze * eps_dot * dx_w) / n,
            f_t * eps / s2 + turn * (dw_eps * x + w * dx_eps),
            turn * w * dx_dot,
            turn * (x + w * dx_w) / n,
            AROUND / s,
            AROUND / s * eps / s2,
        )

    return law
