"""Elastic part of the normal contact: force and energy against penetration.

Newton's method may try a penetration of any size, or one that is no number: the force is then
infinite or no number, and the step is repeated.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import asinh, inf, pi, sinh, sqrt

from exu_press.laws.parameters import demand, positive

__all__ = ["Stiffness", "cylindrical", "hertz", "hertz_stiffness"]

BEYOND = 1e27
"""m; its eleventh power is still a number."""

DEEPEST = 1e150
"""Penetration over clearance up to which the terms of the energy are numbers."""


@dataclass(frozen=True, slots=True)
class Stiffness:
    """An elastic contact, for penetration > 0.

    force: penetration [m] -> (force [N], its derivative [N/m]); energy: penetration [m] -> [J].
    """

    force: Callable[[float], tuple[float, float]]
    energy: Callable[[float], float]


def hertz_stiffness(radius: float, modulus: float) -> float:
    r"""Stiffness of Hertz's point contact (Eq. 26).

    .. math::
        K = \tfrac43 E \sqrt R, \qquad \frac1R = \frac1{R_1} + \frac1{R_2}, \qquad
        \frac1E = \frac{1 - \nu_1^2}{E_1} + \frac{1 - \nu_2^2}{E_2}

    Parameters
    ----------
    radius : equivalent radius R [m], positive; the radius of a hollow surface counts as negative
    modulus : equivalent modulus E [Pa], positive

    Returns
    -------
    K [N/m^1.5].

    Raises
    ------
    InputError : radius or modulus is not positive

    Notes
    -----
    Range: smooth elastic surfaces, and a contact area small against both radii.

    Examples
    --------
    A steel sphere of 10 mm radius on a steel plate:

    >>> f"{hertz_stiffness(0.01, 207e9 / (2 * (1 - 0.3**2))):.4e}"
    '1.5165e+10'

    References
    ----------
    .. [1] Johnson, K. L. Contact Mechanics. Cambridge University Press, 1985, section 4.2.
    """
    positive(radius=radius, modulus=modulus)
    return 4.0 / 3.0 * modulus * sqrt(radius)


def hertz(stiffness: float, exponent: float = 1.5) -> Stiffness:
    r"""Elastic force of a point contact, or of any power of the penetration (in Eq. 23).

    .. math::
        F = K \delta^n, \qquad U = \frac{K \delta^{n+1}}{n + 1}

    Parameters
    ----------
    stiffness : K [N/m^n], positive
    exponent : n [-], 1 <= n <= 10; 1.5 is a point contact, 1 a linear spring

    Returns
    -------
    The elastic part, for penetrations >= 0.

    Raises
    ------
    InputError : an argument is outside its range

    Notes
    -----
    Range: as `hertz_stiffness`. With n < 1 the slope would be infinite at first touch.

    Examples
    --------
    >>> force, slope = hertz(2.5545e10).force(10e-6)
    >>> round(force, 3), round(slope / 1e6, 3)
    (807.804, 121.171)

    References
    ----------
    .. [1] Johnson, K. L. Contact Mechanics. Cambridge University Press, 1985, section 4.2.
    """
    positive(stiffness=stiffness)
    demand(
        1.0 <= exponent <= 10.0, "exponent", exponent, "1 <= exponent <= 10: finite slope at touch"
    )
    n_minus_1, n_plus_1 = exponent - 1.0, exponent + 1.0

    def force(penetration: float) -> tuple[float, float]:
        secant = inf if penetration > BEYOND else stiffness * penetration**n_minus_1
        return secant * penetration, exponent * secant

    def energy(penetration: float) -> float:
        if penetration > BEYOND:
            return inf
        return float(stiffness * penetration**n_plus_1 / n_plus_1)

    return Stiffness(force, energy)


def cylindrical(modulus: float, length: float, clearance: float) -> Stiffness:
    r"""Journal in a bearing of almost its own size: conformal line contact.

    .. math::
        F = \tfrac{\pi}{2} L E \delta \sqrt{\frac{\delta}{2 (c + \delta)}}

    .. math::
        U = \frac{\pi L E c^2}{\sqrt 2} \left( \tfrac38 t - \tfrac14 \sinh 2t
        + \tfrac1{32} \sinh 4t \right), \qquad \delta = c \sinh^2 t

    Where the terms of the energy cancel, its power series in delta / c is used.

    Parameters
    ----------
    modulus : equivalent modulus E [Pa] as in `hertz_stiffness`, positive
    length : L [m], positive
    clearance : c [m], the bearing's radius less the journal's, positive

    Returns
    -------
    The elastic part, for penetrations >= 0.

    Raises
    ------
    InputError : an argument is not positive

    Notes
    -----
    Range: an elastic foundation, held against finite elements in [1]_; its slope is the stiffness
    of [2]_. At delta >> c it is a closely fitting pin of constant stiffness, at delta << c the
    force goes with delta^1.5.

    Examples
    --------
    >>> bearing = cylindrical(modulus=113.7e9, length=0.1, clearance=50e-6)
    >>> [round(bearing.force(depth)[0]) for depth in (1e-6, 10e-6, 100e-6)]
    [1768, 51557, 1031145]

    References
    ----------
    .. [1] Liu, C.-S., K. Zhang, and R. Yang. "The FEM Analysis and Approximate Model for
       Cylindrical Joints with Clearances." Mech. Mach. Theory 42 (2007): 183-197.
    .. [2] Bai, Z. F., Y. Zhao, and J. Chen. "A Nonlinear Contact Force Model for Revolute Joint
       with Clearance." J. Mech. 29 (2013): 653-660.
    """
    positive(modulus=modulus, length=length, clearance=clearance)
    scale = pi * length * modulus / (2.0 * sqrt(2.0))

    def force(penetration: float) -> tuple[float, float]:
        secant = scale * sqrt(penetration / (clearance + penetration))
        return secant * penetration, secant * (1.5 - 0.5 * penetration / (clearance + penetration))

    def energy(penetration: float) -> float:
        ratio = penetration / clearance
        if ratio < 0.02:
            series = 2 / 5 + ratio * (
                -1 / 7
                + ratio * (1 / 12 + ratio * (-5 / 88 + ratio * (35 / 832 - ratio * 21 / 640)))
            )
            return float(scale * clearance**2 * ratio**2.5 * series)
        if ratio > DEEPEST:
            return inf
        t = asinh(sqrt(ratio))
        bracket = 0.375 * t - 0.25 * sinh(2.0 * t) + sinh(4.0 * t) / 32.0
        return 2.0 * scale * clearance**2 * bracket

    return Stiffness(force, energy)
