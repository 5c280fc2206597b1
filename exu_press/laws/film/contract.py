"""The form of every film law: a function of three floats with force, drag and derivatives."""

import math
from collections.abc import Callable
from typing import Final

from exu_press.laws.parameters import positive

__all__ = ["AROUND", "AT_REST", "OUTSIDE", "FilmForce", "FilmLaw", "dissipated_power", "film_scale"]

FilmForce = tuple[float, float, float, float, float, float, float, float, float, float]
"""f_r, f_t, then df_r and df_t by eps, eps_dot and eps_w: three of f_r first, then three of f_t.

Last the drag of the sheared film: j, the integral of 1 / h around the bearing, and dj by eps. The
moments P c (-j (omega_J - omega_B) - eps f_t / 2) on the journal and P c (j (omega_J - omega_B) -
eps f_t / 2) on the bearing go with it: shear of the rotation, and of the pressure flow.
"""

FilmLaw = Callable[[float, float, float], FilmForce]
"""law(eps, eps_dot, eps_w), eps_dot and eps_w = eps (omega_J + omega_B - 2 gamma_dot) in 1/s."""

OUTSIDE: FilmForce = (math.nan,) * 10
"""The response to an eccentricity ratio that has no film: the integrator then halves its step."""

AROUND: Final = 2.0 * math.pi
"""j of a centred journal: Petroff's. At an eccentricity it is 2 pi / sqrt(1 - eps^2), with the gap
full of oil all round, also where its pressure is ambient: as Raimondi and Boyd 1958, Butenschoen
1976 and DIN 31652 have it."""

AT_REST = 1e-100
"""Below this speed [1/s] a film is at rest and has its derivatives towards closing."""


def film_scale(viscosity: float, length: float, radius: float, clearance: float) -> float:
    r"""Scale of a film force, the P of P f.

    .. math:: P = \frac{\mu L R^3}{c^2}

    Parameters
    ----------
    viscosity : dynamic viscosity mu [Pa s]
    length : length L of the bearing [m]
    radius : radius R of the journal [m]
    clearance : radial clearance c [m]

    Returns
    -------
    P [N s]; the force on the journal is P (f_r e_r + f_t e_t), e_r pointing from the bearing's
    centre to the journal's and e_t a quarter turn counter-clockwise from it.

    Raises
    ------
    InputError : one of the four is not positive and finite

    Examples
    --------
    >>> round(film_scale(viscosity=0.4, length=0.1, radius=0.07, clearance=1e-4), 9)
    1372.0
    """
    positive(viscosity=viscosity, length=length, radius=radius, clearance=clearance)
    return viscosity * length * radius**3 / clearance**2


def dissipated_power(force: FilmForce, eps_dot: float, eps_w: float) -> float:
    r"""Power that a film's pressure takes out of its mechanism, divided by P c.

    .. math:: D = -f_r \dot\varepsilon + \tfrac12 f_t\, \varepsilon W \ge 0   \quad [1/s^2]

    It is all the power of the pressure: the force's, and that of the couple e f_t which the two
    surfaces share in halves (e f_t / 2 against each one's rotation). The shear of the rotation
    takes j (omega_J - omega_B)^2 on top.

    Examples
    --------
    >>> from exu_press.laws.film.long_bearing import pi_film
    >>> round(dissipated_power(pi_film()(0.0, 1.0, 0.0), 1.0, 0.0) / math.pi, 12)
    6.0
    """
    return 0.5 * force[1] * eps_w - force[0] * eps_dot
