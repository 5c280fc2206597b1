"""A film that goes on where the asperities of the two surfaces already touch."""

import math

from exu_press.laws.film.contract import FilmForce, FilmLaw
from exu_press.laws.film.plane_pad import PadFilm, PadLaw
from exu_press.laws.parameters import demand, positive

__all__ = ["effective_ratio", "pad_with_asperities", "with_asperities"]

_STEEPNESS = 2.0


def with_asperities(law: FilmLaw, onset_ratio: float) -> FilmLaw:
    r"""Film law for every eccentricity ratio, beyond 1 too, through a gap that stays open.

    .. math::
        g = 1 - \varepsilon \to \tilde g = \begin{cases}
        g & g \ge \eta \\
        \eta\, (1 - \tfrac12 \arctan 2t), \quad t = (\eta - g)/\eta & g < \eta \end{cases}

    The gap is the true one, bit by bit, until the asperities touch (eta = h_on / c); from there
    it closes ever more slowly and never below 0.215 eta: 0.446 eta is left at eps = 1. Its
    first and second derivatives have no jump, so neither have force, damping and stiffness.
    The film sees tilde eps = 1 - tilde g and the speeds T (eps_dot, eps W), T = (d tilde
    eps/d eps, tilde eps/eps), and acts through the same T on the journal: virtual power is kept,
    so the film dissipates exactly what `law` does in the effective gap, and it fades out as the
    surfaces sink into each other: the radial force as T, the radial damping as T^2. The drag is
    that of the effective gap.

    Contact acts in parallel, from the same onset: the joint adds its normal force at penetration
    e - c + h_on (times c: eps - 1 + eta), which is zero with zero slope where this gap departs
    from the true one. Film and contact then share the load, contact ever more of it.

    Parameters
    ----------
    law : a film law for 0 <= eps < 1
    onset_ratio : eta = h_on / c [-], the gap at which asperities touch over the radial clearance,
        0 < eta < 1; h_on is about three times the combined rms roughness of both surfaces

    Returns
    -------
    The law, f in 1/s, for every eps >= 0.

    Raises
    ------
    InputError : onset_ratio is not between 0 and 1

    Notes
    -----
    Range: any eps; up to 1 - eta it is `law` itself. Beyond, it is a choice of this package that
    keeps the film regular, not a measured flow between rough surfaces.

    Examples
    --------
    >>> from exu_press.laws.film.long_bearing import pi_film
    >>> smooth, rough = pi_film(), with_asperities(pi_film(), 0.02)
    >>> smooth(0.98, 1.0, 2.0) == rough(0.98, 1.0, 2.0)
    True
    >>> round(rough(1.0, 1.0, 0.0)[0] / rough(0.98, 1.0, 0.0)[0], 3)
    0.133

    References
    ----------
    .. [1] Patir, N., and H. S. Cheng. "An Average Flow Model for Determining Effects of
       Three-Dimensional Roughness on Partial Hydrodynamic Lubrication." J. Lubr. Technol. 100,
       no. 1 (1978): 12-17. The mean gap of rough surfaces stays open; contact from h = 3 sigma.
    .. [2] MBDyn, module-hydrodynamic_plain_bearing: film and asperity contact in parallel.
    """
    demand(
        0.0 < onset_ratio < 1.0,
        "onset_ratio",
        onset_ratio,
        "0 < h_on / c < 1",
        "Patir and Cheng 1978: h_on = 3 sigma",
    )
    onset = 1.0 - onset_ratio

    def mixed_law(eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        if not eps > onset:
            return law(eps, eps_dot, eps_w)
        effective, slope, bend = effective_ratio(eps, onset_ratio)
        ratio = effective / eps
        d_ratio = (slope - ratio) / eps
        f_r, f_t, r_eps, r_dot, r_w, t_eps, t_dot, t_w, shear, shear_eps = law(
            effective, slope * eps_dot, ratio * eps_w
        )
        d_dot, d_w = bend * eps_dot, d_ratio * eps_w
        return (
            slope * f_r,
            ratio * f_t,
            bend * f_r + slope * (slope * r_eps + d_dot * r_dot + d_w * r_w),
            slope * slope * r_dot,
            slope * ratio * r_w,
            d_ratio * f_t + ratio * (slope * t_eps + d_dot * t_dot + d_w * t_w),
            ratio * slope * t_dot,
            ratio * ratio * t_w,
            shear,
            slope * shear_eps,
        )

    return mixed_law


def pad_with_asperities(law: PadLaw, onset: float) -> PadLaw:
    r"""Film of a plane pad for every gap, negative ones too, through a gap that stays open.

    Each end's gap below the onset is that of `with_asperities`, and the film acts through its slope
    on the end: virtual power is kept. Contact acts in parallel, from the same onset.

    Parameters
    ----------
    law : of `plane_pad`
    onset : gap at which asperities touch [m], positive

    Examples
    --------
    >>> from exu_press.laws.film.plane_pad import plane_pad
    >>> smooth = plane_pad(0.3, 0.1)
    >>> rough = pad_with_asperities(smooth, 2e-6)
    >>> smooth(2e-6, 1e-5, -1e-3, 0.0, 1.0) == rough(2e-6, 1e-5, -1e-3, 0.0, 1.0)
    True
    >>> rough(-1e-6, 1e-5, -1e-3, 0.0, 1.0)[0] > 0.0
    True
    """
    positive(onset=onset)

    def mixed_law(h_1: float, h_2: float, rate_1: float, rate_2: float, sliding: float) -> PadFilm:
        if h_1 >= onset and h_2 >= onset:
            return law(h_1, h_2, rate_1, rate_2, sliding)
        open_1, slope_1, bend_1 = _open_gap(h_1, onset)
        open_2, slope_2, bend_2 = _open_gap(h_2, onset)
        f = law(open_1, open_2, slope_1 * rate_1, slope_2 * rate_2, sliding)
        more_1, more_2 = bend_1 * rate_1, bend_2 * rate_2
        film = [slope_1 * f[0], slope_2 * f[1], f[2]]
        for row, factor in ((3, slope_1), (8, slope_2), (13, 1.0)):
            by_1, by_2, by_rate_1, by_rate_2, by_sliding = f[row : row + 5]
            film += [
                factor * (by_1 * slope_1 + by_rate_1 * more_1),
                factor * (by_2 * slope_2 + by_rate_2 * more_2),
                factor * by_rate_1 * slope_1,
                factor * by_rate_2 * slope_2,
                factor * by_sliding,
            ]
        film[3] += bend_1 * f[0]
        film[9] += bend_2 * f[1]
        return tuple(film)

    return mixed_law


def _open_gap(gap: float, onset: float) -> tuple[float, float, float]:
    """Return the gap that stays open, and its first and second derivative by the true one."""
    if gap >= onset:
        return gap, 1.0, 0.0
    t = _STEEPNESS * (onset - gap) / onset
    slope = 1.0 / (1.0 + t * t)
    opened = onset * (1.0 - math.atan(t) / _STEEPNESS)
    return opened, slope, 2.0 * _STEEPNESS * t * slope * slope / onset


def effective_ratio(eps: float, onset_ratio: float) -> tuple[float, float, float]:
    """Return tilde eps of `with_asperities` beyond the onset, and its two derivatives by eps."""
    onset = 1.0 - onset_ratio
    t = _STEEPNESS * (eps - onset) / onset_ratio
    slope = 1.0 / (1.0 + t * t)
    bend = -2.0 * _STEEPNESS * t * slope * slope / onset_ratio
    return onset + onset_ratio * math.atan(t) / _STEEPNESS, slope, bend
