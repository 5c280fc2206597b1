"""Elastic part of the normal contact: force and energy against penetration.

References
----------
.. [1] K. L. Johnson, Contact Mechanics, Cambridge University Press 1985, section 4.2.
.. [2] C.-S. Liu, K. Zhang, R. Yang, The FEM analysis and approximate model for cylindrical joints
   with clearances, Mechanism and Machine Theory 42 (2007) 183-197.
.. [3] Z. F. Bai, Y. Zhao, J. Chen, A nonlinear contact force model for revolute joint with
   clearance, J. Mechanics 29 (2013) 653-660.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import asinh, pi, sinh, sqrt

from exu_press.laws.contact_parameters import demand, positive

__all__ = ["Stiffness", "cylindrical", "hertz", "hertz_stiffness"]


@dataclass(frozen=True, slots=True)
class Stiffness:
    """An elastic contact, for penetration > 0.

    force: penetration [m] -> (force [N], its derivative [N/m]); energy: penetration [m] -> [J].
    """

    force: Callable[[float], tuple[float, float]]
    energy: Callable[[float], float]


def hertz_stiffness(radius: float, modulus: float) -> float:
    """Hertz's point contact (Eq. 26; [1]_): K = 4/3 E sqrt(R), in N/m^1.5.

    radius: equivalent [m], 1/R = 1/R_1 + 1/R_2, a hollow surface counted negative;
    modulus: equivalent [Pa], 1/E = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2. InputError unless both are
    positive.

    Steel sphere of 10 mm radius on steel plate:

    >>> f"{hertz_stiffness(0.01, 207e9 / (2 * (1 - 0.3**2))):.4e}"
    '1.5165e+10'
    """
    positive(radius=radius, modulus=modulus)
    return 4.0 / 3.0 * modulus * sqrt(radius)


def hertz(stiffness: float, exponent: float = 1.5) -> Stiffness:
    """F = K delta^n (elastic part of Eq. 23; [1]_), with the energy K delta^(n+1) / (n+1).

    stiffness: K [N/m^n] > 0; exponent: n >= 1 (1.5 point contact, 1 linear). InputError outside.

    >>> force, slope = hertz(2.5545e10).force(10e-6)
    >>> round(force, 3), round(slope / 1e6, 3)
    (807.804, 121.171)
    """
    positive(stiffness=stiffness)
    demand(
        1.0 <= exponent <= 10.0, "exponent", exponent, "1 <= exponent <= 10: finite slope at touch"
    )
    n_minus_1, n_plus_1 = exponent - 1.0, exponent + 1.0

    def force(penetration: float) -> tuple[float, float]:
        secant = stiffness * penetration**n_minus_1
        return secant * penetration, exponent * secant

    def energy(penetration: float) -> float:
        return float(stiffness * penetration**n_plus_1 / n_plus_1)

    return Stiffness(force, energy)


def cylindrical(modulus: float, length: float, clearance: float) -> Stiffness:
    """Journal in a bearing almost its own size: conformal line contact [2]_.

        F = pi/2 L E delta sqrt(delta / (2 (c + delta)))

    modulus: E [Pa], equivalent as in `hertz_stiffness`; length: L [m]; clearance: c [m], bearing
    radius less journal radius. An elastic foundation held against finite elements in [2]_; its
    slope is the stiffness of [3]_. At delta >> c it is a closely fitting pin of constant stiffness,
    at delta << c it goes with delta^1.5. InputError unless all three are positive.
    Energy: with delta = c sinh^2 t

        pi L E c^2 / sqrt(2) (3 t/8 - sinh(2 t)/4 + sinh(4 t)/32),

    and its power series in delta / c where those terms cancel.

    >>> bearing = cylindrical(modulus=113.7e9, length=0.1, clearance=50e-6)
    >>> [round(bearing.force(depth)[0]) for depth in (1e-6, 10e-6, 100e-6)]
    [1768, 51557, 1031145]
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
        t = asinh(sqrt(ratio))
        bracket = 0.375 * t - 0.25 * sinh(2.0 * t) + sinh(4.0 * t) / 32.0
        return 2.0 * scale * clearance**2 * bracket

    return Stiffness(force, energy)
