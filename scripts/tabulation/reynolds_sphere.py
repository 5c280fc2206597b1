"""Reynolds' equation of a ball in its socket, solved numerically: what `ball` is tabulated from."""

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq  # type: ignore[import-untyped,unused-ignore]

from exu_press.laws.film.reynolds import obstacle
from exu_press.numerics.arrays import Array

__all__ = ["CapPressure", "facing_load", "solve_cap"]

FURTHEST = 0.7
"""Largest shift over the disk's radius: moved further, the grid's centre would leave too few angles
elsewhere."""

STEEPEST = 0.4999 * math.pi
"""rad between the load and v."""

NEAR_WALL = 0.95
"""Eccentricity ratio beyond which an opening film may bear a load in several directions."""


class CapPressure(NamedTuple):
    """Load [1/s] on a cap, and the pressure over 12 mu R^2 / c^2 [1/s] on half of it.

    Attributes:
        along: of the load, along the cap's axis.
        aside: across it, towards the side on which the ball is.
        directions: (3, n, m), from the ball's centre, along the axis, aside and across the plane.
        p: (n, m).
    """

    along: float
    aside: float
    directions: Array
    p: Array


def solve_cap(
    eps: float,
    v_along: float,
    v_aside: float,
    tilt: float,
    half_angle: float,
    cells: tuple[int, int] = (40, 20),
) -> CapPressure:
    r"""Load of the film between a ball and a cap, under rotation and squeeze.

    .. math::
        \nabla \cdot (h^3 \nabla p) = -\mathbf v \cdot \mathbf r, \qquad
        h = 1 - \boldsymbol\varepsilon \cdot \mathbf r, \qquad
        \mathbf v = \dot{\boldsymbol\varepsilon}
        - \tfrac12 (\boldsymbol\omega_J + \boldsymbol\omega_B) \times \boldsymbol\varepsilon

    on the unit sphere, p = 0 on the cap's edge, and Swift and Stieber's cavitation as in
    `solve_reynolds`. The operator keeps its form under conformal maps: the cap becomes the unit
    disk, the narrowest gap its centre, and a graded polar grid takes in both.

    Parameters
    ----------
    eps : eccentricity ratio [-], 0 to 1
    v_along, v_aside : v along the cap's axis, and aside, in the plane of axis and eccentricity
    tilt : angle from the axis to the eccentricity [rad], 0 to pi
    half_angle : of the cap, from its axis to its edge [rad]
    cells : from the centre to the edge, and half around; load good to 0.4 % with the default

    References
    ----------
    .. [1] Goenka, P. K., and J. F. Booker. "Spherical Bearings: Static and Dynamic Analysis via
       the Finite Element Method." J. Lubr. Technol. 102, no. 3 (1980): 308-318.
    """
    edge = math.tan(0.5 * half_angle)
    width = math.sqrt(2.0 * (1.0 - eps)) if eps < 1.0 else 0.0  # of the narrow gap
    n = math.tan(0.5 * min(tilt, math.pi - 1e-6)) / edge  # where it lies in the disk
    centre = min(n, 1.0 / n if n > 1.0 else 1.0, FURTHEST)
    stretch = 2.0 * edge * (1.0 - centre**2) / (1.0 + (edge * centre) ** 2)
    beside = abs(n - centre) / (1.0 + n * centre)
    fine = min(3.0, max(width / stretch, 0.5 * beside))
    rho = fine * np.sinh(np.linspace(0.0, 1.0, cells[0] + 1) * math.asinh(1.0 / fine))
    middle = 0.5 * (rho[1:] + rho[:-1])
    d_rho, d_phi = np.diff(rho), math.pi / cells[1]
    phi = (np.arange(cells[1]) + 0.5) * d_phi

    def on_sphere(z: Array) -> tuple[Array, Array]:
        """Return directions (3, ...) of points of the disk, and the area there by the disk's."""
        w = edge * (z + centre) / (1.0 + centre * z)
        slope = edge * (1.0 - centre**2) / np.abs(1.0 + centre * z) ** 2
        size = 1.0 + np.abs(w) ** 2
        return np.array([2.0 - size, 2.0 * w.real, 2.0 * w.imag]) / size, (2.0 * slope / size) ** 2

    def gap(z: Array) -> Array:
        """Return h."""
        x, y, _ = on_sphere(z)[0]
        return np.asarray(1.0 - eps * (math.cos(tilt) * x + math.sin(tilt) * y))

    turn = np.exp(1j * phi)
    outward = gap(np.outer(rho[1:-1], turn)) ** 3 * (rho[1:-1] / np.diff(middle))[:, None] * d_phi
    at_edge = gap(turn) ** 3 * d_phi / (1.0 - middle[-1])
    faces = np.exp(1j * d_phi * np.arange(1, cells[1]))
    around = gap(np.outer(middle, faces)) ** 3 * (d_rho / middle)[:, None] / d_phi
    diagonal = np.zeros((cells[0], cells[1]))
    diagonal[:-1] += outward
    diagonal[1:] += outward
    diagonal[-1] += at_edge
    diagonal[:, :-1] += around
    diagonal[:, 1:] += around
    directions, scale = on_sphere(np.outer(middle, turn))
    area = scale * (middle * d_rho)[:, None] * d_phi
    source = (v_along * directions[0] + v_aside * directions[1]) * area
    p = obstacle(diagonal, outward, around, source)
    load = 24.0 * p * area  # of both halves
    return CapPressure(
        float((load * directions[0]).sum()), float((load * directions[1]).sum()), directions, p
    )


def facing_load(
    eps: float,
    eps_dot: float,
    half_w: float,
    half_angle: float,
    cells: tuple[int, int] = (40, 20),
) -> tuple[float, float]:
    r"""f_r and f_t [1/s] of the film in a cap that faces the load, as a socket's cup does.

    The load's direction is that of the film's resultant, and follows from it: the angle from the
    eccentricity to the load is the one at which the cap's load has no part across its axis. Where a
    ball that leaves the wall has several, the one furthest from the eccentricity is taken.

    Parameters
    ----------
    eps, eps_dot : as for a film law
    half_w : eps W / 2 [1/s], not negative
    half_angle : of the cap [rad]
    cells : as for `solve_cap`
    """

    def load(tilt: float) -> tuple[float, float]:
        """Return the load across the cap's axis, and along it."""
        v_along = eps_dot * math.cos(tilt) + half_w * math.sin(tilt)
        v_aside = eps_dot * math.sin(tilt) - half_w * math.cos(tilt)
        found = solve_cap(eps, v_along, v_aside, tilt, half_angle, cells)
        return found.aside, found.along

    tilt = moving = math.atan2(half_w, eps_dot)
    if 0.0 < moving < math.pi:  # the film dissipates: the load is within a right angle
        low, high = max(0.0, moving - STEEPEST), min(math.pi, moving + STEEPEST)
        if eps > NEAR_WALL and eps_dot < 0.0:
            for angle in np.linspace(high, low, 25)[1:].tolist():
                if load(angle)[0] <= 0.0:
                    low = angle
                    break
                high = angle
        tilt = float(brentq(lambda angle: load(angle)[0], low, high, xtol=1e-4))
    along = load(tilt)[1]
    return -along * math.cos(tilt), along * math.sin(tilt)
