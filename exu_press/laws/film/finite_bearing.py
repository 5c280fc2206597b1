"""The film of a bearing of finite width, rotation and squeeze together, from a table."""

from pathlib import Path

from exu_press.laws.film.contract import FilmLaw
from exu_press.laws.film.tabulated import interpolation_table, tabulated_law
from exu_press.laws.parameters import demand

__all__ = ["finite"]

TABLE = Path(__file__).with_name("finite_bearing.npz")


def finite(length_to_diameter: float) -> FilmLaw:
    r"""Film of a bearing of any width from L/D = 0.1 to 4, under rotation and squeeze together.

    ln E and m of `tabulated` over -ln(1 - eps), L/D and the direction of the two speeds.

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
    return tabulated_law(interpolation_table(TABLE, "ratio", length_to_diameter))
