"""The film of a bearing of finite width, and film laws from tables of Reynolds' equation.

It is solved for all directions of the two speeds, rotation and squeeze together.
"""

import math
from bisect import bisect_right
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Literal

from exu_press.laws.film.contract import AROUND, AT_REST, OUTSIDE, FilmForce, FilmLaw
from exu_press.laws.parameters import demand

__all__ = ["finite", "interpolation_table", "tabulated_law"]

_Patch = tuple[float, ...]  # 16 coefficients, the power of x outside, that of y inside

_Table = tuple[list[float], list[float], list[list[tuple[_Patch, _Patch]]]]

Drag = Callable[[float], tuple[float, float]]
"""j(eps) and dj by eps."""


def finite(length_to_diameter: float) -> FilmLaw:
    r"""Film of a bearing of any width from L/D = 0.1 to 4, under rotation and squeeze together.

    ln E and m of `tabulated_law` over -ln(1 - eps), L/D and the direction of the two speeds.

    Parameters
    ----------
    length_to_diameter : L/D of the bearing [-], 0.1 to 4

    Returns
    -------
    The law, f in 1/s, for 0 <= eps < 1; NaN outside. Beyond eps = 0.9997 by the power laws
    reached there.

    Raises
    ------
    InputError : L/D is not in 0.1 to 4

    Notes
    -----
    Cavitation: Swift and Stieber (p >= 0, zero gradient where the film breaks), oil supplied at
    ambient pressure along the widest gap as in [1]_ and [2]_; when the journal leaves the wall
    that line gives way (`reynolds.supply_line`). Below eps = 0.03 the supply line fades, since
    there the widest gap loses its meaning, and at eps = 0 the film is an isotropic damper.

    Accuracy: against [1]_, eps = 0.1 to 0.99 and L/D = 1/8 to 1, 0.1 % on average and 0.9 % at
    most in load, 0.1 deg in attitude; squeeze 0.1 % and 0.8 %. Against [3]_ between the knots
    0.02 % and 1 %; [3]_ itself is within 0.3 % of a grid twice as fine.

    Rotation and squeeze do not add up. The sum of the two forces, which [1]_ and MBDyn's
    hydrodynamic plain bearing use, is 14 % off on average and 29 % at most when closing; when
    opening it misses that the film of rotation is drawn apart and is off by half on the median,
    by up to 80 times near the wall (L/D = 0.25 to 2, eps = 0.1 to 0.95, all directions).

    Examples
    --------
    Butenschoen's B/D = 1, eps = 0.5: So = |f| / (2 omega) = 0.8903, attitude angle 56.705 deg:

    >>> import math
    >>> f_r, f_t, *_ = finite(1.0)(0.5, 0.0, 0.5)
    >>> round(math.hypot(f_r, f_t) / 2, 3), round(math.degrees(math.atan2(f_t, -f_r)), 1)
    (0.89, 56.7)

    References
    ----------
    .. [1] Butenschoen, H.-J. Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter
       instationaerer Belastung. Dissertation, Karlsruhe, 1976.
    .. [2] Raimondi, A. A., and J. Boyd. "A Solution for the Finite Journal Bearing and Its
       Application to Analysis and Design." ASLE Trans. 1 (1958): 159-209.
    .. [3] `reynolds.solve_reynolds`, tabulated by scripts/tabulate_finite_film.py.
    """
    demand(
        0.1 <= length_to_diameter <= 4.0,
        "length_to_diameter",
        length_to_diameter,
        "0.1 <= length_to_diameter <= 4; narrower: short, wider: pi_film",
        "Reynolds' equation, tabulated",
    )
    table = Path(__file__).with_name("finite_bearing.npz")
    return tabulated_law(interpolation_table(table, "ratio", length_to_diameter))


def tabulated_law(table: _Table, drag: Drag | None = None) -> FilmLaw:
    r"""Film law from an interpolated table of ln E and m.

    .. math::
        f_r = -E\, (a + m b), \qquad f_t = s E\, (b - m a), \qquad
        a = \dot\varepsilon,\quad b = \tfrac12 s\, \varepsilon W,\quad
        s = \sqrt{1 - \varepsilon^2}

    A film is of first degree in its two speeds, so E and m depend on eps and the direction of
    (a, b) alone. E (a^2 + b^2) is the dissipated power, whatever m is: with ln E tabulated the law
    cannot feed energy in. The direction is (arctan(a/b) + arctan(2 eps_dot / (eps W))) / 2.

    Parameters
    ----------
    table : from `interpolation_table`
    drag : j(eps) of the sheared film and its derivative; a journal's unless given

    Returns
    -------
    The law, f in 1/s, for 0 <= eps < 1; NaN outside. Beyond the last tabulated eps by the power
    laws reached there.
    """
    xs, ys, patches = table
    y_low, y_per = ys[0], (len(ys) - 1) / (ys[-1] - ys[0])
    last = len(ys) - 2

    def law(eps: float, eps_dot: float, eps_w: float) -> FilmForce:
        if not 0.0 <= eps < 1.0 or not math.isfinite(abs(eps_dot) + abs(eps_w)):
            return OUTSIDE
        if abs(eps_dot) + abs(eps_w) < AT_REST:
            eps_dot = AT_REST
        s2 = (1.0 - eps) * (1.0 + eps)
        s = math.sqrt(s2)
        u = 0.5 * abs(eps_w)
        sign = math.copysign(1.0, eps_w)
        rho = math.hypot(eps_dot, u)
        c, d = u / rho, eps_dot / rho  # the table depends on the direction alone
        q = s2 * c * c + d * d
        y = 0.5 * (math.atan2(d, c) + math.atan2(d, s * c))
        dy = 0.5 * (1.0 + s / q) / rho  # along c for eps_dot, against d for eps_w / 2
        dy_eps = 0.5 * eps * c * d / (s * q)

        x = -math.log1p(-eps)
        i = bisect_right(xs, x) - 1
        j = min(int((y - y_low) * y_per), last)
        x -= xs[i]
        y -= ys[j]
        ln_e, m = patches[i][j]
        g, g_x, g_y = _cubic(ln_e, x, y)
        m0, m_x, m_y = _cubic(m, x, y)
        e = math.exp(g)
        if drag is None:
            shear = AROUND / s
            shear_eps = AROUND / s * eps / s2
        else:
            shear, shear_eps = drag(eps)

        x_eps = 1.0 / (1.0 - eps)
        g_eps = g_x * x_eps + g_y * dy_eps
        m_eps = m_x * x_eps + m_y * dy_eps
        g_y *= dy
        m_y *= dy
        a, b = eps_dot, s * u
        f_r = -e * (a + m0 * b)
        f_t = s * e * (b - m0 * a)
        b_eps = -eps * u / s
        return (
            f_r,
            sign * f_t,
            f_r * g_eps - e * (m0 * b_eps + m_eps * b),
            f_r * g_y * c - e * (1.0 + m_y * c * b),
            0.5 * sign * (-f_r * g_y * d - e * (m0 * s - m_y * d * b)),
            sign * (f_t * (g_eps - eps / s2) + s * e * (b_eps - m_eps * a)),
            sign * (f_t * g_y * c - s * e * (m0 + m_y * c * a)),
            0.5 * (-f_t * g_y * d + s * e * (s + m_y * d * a)),
            shear,
            shear_eps,
        )

    return law


def _cubic(p: _Patch, x: float, y: float) -> tuple[float, float, float]:
    """A bicubic patch and its two slopes."""
    p0, p1, p2, p3, q0, q1, q2, q3, r0, r1, r2, r3, s0, s1, s2, s3 = p
    a = ((p3 * y + p2) * y + p1) * y + p0
    b = ((q3 * y + q2) * y + q1) * y + q0
    c = ((r3 * y + r2) * y + r1) * y + r0
    d = ((s3 * y + s2) * y + s1) * y + s0
    y3 = 3.0 * y
    return (
        ((d * x + c) * x + b) * x + a,
        (3.0 * d * x + 2.0 * c) * x + b,
        (((s3 * y3 + 2.0 * s2) * y + s1) * x + (r3 * y3 + 2.0 * r2) * y + r1) * x * x
        + ((q3 * y3 + 2.0 * q2) * y + q1) * x
        + (p3 * y3 + 2.0 * p2) * y
        + p1,
    )


@lru_cache(maxsize=32)  # a scene is made, checked and changed with the same bearing
def interpolation_table(file: Path, over: str, at: float) -> _Table:
    """Return knots of -ln(1 - eps) and of the direction, and the patches of ln E and m between.

    Both are bicubic splines, twice differentiable.

    Args:
        file: an npz with the arrays log_e and m over a shape, "eps" and "turn".
        over: name of the array of shapes.
        at: the shape that is wanted; between those of the table by a spline over its logarithm.
    """
    import numpy as np  # the law itself is plain floats

    from exu_press.numerics.piecewise import evaluate, spline

    table = np.load(file)
    x, y, shape = -np.log1p(-table["eps"]), table["turn"], np.log(table[over])

    def patches(name: str, ends: Literal["clamped", "natural"]) -> list[list[_Patch]]:
        over_shape = spline(shape, np.moveaxis(table[name].astype(float), 0, -1))
        along_y = spline(y, evaluate(shape, over_shape, math.log(at)), ends)
        rows = np.moveaxis(along_y, 1, -1)  # power of y, interval of y, x
        both = spline(x, rows)  # power of x, power of y, interval of y, interval of x
        last = evaluate(x, both, x[-1], derivative=1)
        flat = np.zeros_like(last)
        beyond = np.stack([rows[..., -1], last, flat, flat])  # straight on from the last knot
        c = np.concatenate([both, beyond[..., np.newaxis]], axis=-1).transpose(3, 2, 0, 1)
        return [[tuple(p.ravel().tolist()) for p in row] for row in c]

    ln_e, m = patches("log_e", "clamped"), patches("m", "natural")
    return (
        x.tolist(),
        y.tolist(),
        [list(zip(*rows, strict=True)) for rows in zip(ln_e, m, strict=True)],
    )
