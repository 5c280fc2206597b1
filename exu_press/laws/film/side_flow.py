"""Side flow: oil that leaves a bearing at its two ends."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

from exu_press.laws.parameters import demand, positive
from exu_press.numerics.arrays import Array

__all__ = ["SideFlow", "finite_flow", "no_flow", "short_flow"]

SideFlow = Callable[[Array, Array, Array], Array]
"""flow(eps, eps_dot, eps_w) over L R c, (n,), 1/s; the arguments are those of a film law."""


def no_flow(length_to_diameter: float) -> SideFlow:
    """Side flow of a long bearing: none, as nothing in it flows along the axis.

    Examples
    --------
    >>> no_flow(4.0)(np.array([0.5]), np.array([0.0]), np.array([0.5]))
    array([0.])
    """
    return lambda eps, eps_dot, eps_w: np.zeros_like(eps)


def short_flow(length_to_diameter: float) -> SideFlow:
    r"""Side flow of a short bearing, from which all leaves that its pressure displaces.

    .. math::
        \frac{Q}{L R c} = \int \max(0,\ \dot\varepsilon \cos\theta - u \sin\theta)\, d\theta
        = 2 \sqrt{\dot\varepsilon^2 + u^2}, \qquad u = \tfrac12 \varepsilon W

    Parameters
    ----------
    length_to_diameter : L/D of the bearing [-], positive; the flow does not depend on it

    Returns
    -------
    The flow over L R c [1/s] at eps, eps_dot, eps_w.

    Raises
    ------
    InputError : L/D is not positive

    Notes
    -----
    Range: L/D <= 0.5; above it `finite_flow` has less. The viscosity cancels: the pressure is in
    proportion to it, and the flow to the pressure over it.

    Examples
    --------
    Ocvirk's flow of steady rotation is eps omega R c L:

    >>> short_flow(0.25)(np.array([0.5]), np.array([0.0]), np.array([0.5]))
    array([0.5])

    References
    ----------
    .. [1] Ocvirk, F. W. "Short-Bearing Approximation for Full Journal Bearings." NACA TN 2808,
       1952.
    """
    positive(length_to_diameter=length_to_diameter)
    return lambda eps, eps_dot, eps_w: 2.0 * np.hypot(eps_dot, 0.5 * eps_w)


def finite_flow(length_to_diameter: float) -> SideFlow:
    r"""Side flow of a bearing of any width from L/D = 0.1 to 4.

    .. math::
        \frac{Q}{L R c} = 2 \psi \sqrt{\dot\varepsilon^2 + u^2}, \qquad u = \tfrac12 \varepsilon W

    psi <= 1 is the share of the oil that the pressure displaces and that leaves at the ends; the
    rest flows around the bearing. It is tabulated over eps, L/D and the direction of the two
    speeds, with the supply line of `finite`.

    Parameters
    ----------
    length_to_diameter : L/D of the bearing [-], 0.1 to 4

    Returns
    -------
    The flow over L R c [1/s] at eps, eps_dot, eps_w; below eps = 0.01 and beyond 0.9997 psi is the
    one reached there. NaN for NaN.

    Raises
    ------
    InputError : L/D is not in 0.1 to 4

    Notes
    -----
    Oil that enters by a supply pressure is not counted. Accuracy: against [1]_ at L/D = 1/2 and 1,
    eps = 0.1 to 0.97, 0.7 %.

    Examples
    --------
    Raimondi and Boyd's L/D = 1, eps = 0.6: Q / (R c N L) = 4.33 and Q_s / Q = 0.680, 2.944
    together; over L R c omega that is 0.4686:

    >>> float(finite_flow(1.0)(np.array([0.6]), np.array([0.0]), np.array([0.6]))[0].round(3))
    0.468

    References
    ----------
    .. [1] Raimondi, A. A., and J. Boyd. "A Solution for the Finite Journal Bearing and Its
       Application to Analysis and Design." ASLE Trans. 1 (1958): 159-209.
    .. [2] `reynolds.solve_reynolds`, tabulated by scripts/tabulate_side_flow.py.
    """
    demand(
        0.1 <= length_to_diameter <= 4.0,
        "length_to_diameter",
        length_to_diameter,
        "0.1 <= length_to_diameter <= 4; narrower: short",
        "Reynolds' equation, tabulated",
    )
    from scipy.interpolate import RectBivariateSpline  # only where oil warms

    from exu_press.numerics.piecewise import evaluate, spline

    table = np.load(Path(__file__).with_name("side_flow.npz"))
    over_ratio = spline(np.log(table["ratio"]), np.moveaxis(table["share"].astype(float), 0, -1))
    shares = evaluate(np.log(table["ratio"]), over_ratio, math.log(length_to_diameter))
    knots = -np.log1p(-table["eps"])
    share = RectBivariateSpline(knots, table["turn"], shares)

    def flow(eps: Array, eps_dot: Array, eps_w: Array) -> Array:
        inside = np.clip(eps, table["eps"][0], table["eps"][-1])
        u = 0.5 * np.abs(eps_w)
        squeezed = np.sqrt((1.0 - inside) * (1.0 + inside)) * u
        turn = 0.5 * (np.arctan2(eps_dot, u) + np.arctan2(eps_dot, squeezed))
        psi = share(-np.log1p(-inside), turn, grid=False)
        return np.asarray(2.0 * psi * np.hypot(eps_dot, u))

    return flow
