"""Reynolds' equation of a finite bearing, solved numerically; the source of `finite`'s tables."""

import math
from typing import Any, NamedTuple

import numpy as np
from scipy.linalg import solveh_banded  # type: ignore[import-untyped,unused-ignore]

from exu_press.numerics.arrays import Array

__all__ = ["Pressure", "obstacle", "solve_reynolds", "supply_line"]


ROUNDING = 1e-9
"""Part of a cell's source by which its flow may be short before the cell counts as wet."""


class Pressure(NamedTuple):
    """Force of a film [1/s] and its pressure over 12 mu R^2 / c^2 [1/s] at theta and zeta.

    `side_flow` leaves the bearing at both ends, over L R c [1/s].
    """

    f_r: float
    f_t: float
    theta: Array
    zeta: Array
    p: Array
    side_flow: float


def supply_line(eps_dot: float, eps_w: float) -> float:
    r"""Angle from the narrowest gap at which oil is supplied at ambient pressure [rad].

    The widest gap, pi, while the film closes or only turns, as in Raimondi and Boyd's and in
    Butenschoen's tables. When it opens the line gives way to the film that then forms there:
    pi cos^2(phi), tan(phi) = 2 eps_dot / eps_w, which ends at the narrowest gap.
    """
    if eps_dot >= 0.0:
        return math.pi
    half_w = 0.5 * eps_w
    return math.copysign(math.pi * half_w**2 / (half_w**2 + eps_dot**2), eps_w)


def _angles(eps: float, start: float, cells: int) -> Array:
    """Angles from `start` once around, dense at the narrow gap and nowhere coarse."""
    w = math.sqrt((1.0 - eps) / (1.0 + eps))
    t = np.linspace(-math.pi, math.pi, 20 * cells + 1)
    theta = 2.0 * np.arctan(w * np.tan(0.5 * t))  # Sommerfeld's substitution
    theta[0], theta[-1] = -math.pi, math.pi
    even = 0.5 * (theta + t)
    first = float(np.interp(start, theta, even))
    turn = first + np.linspace(0.0, 2.0 * math.pi, cells + 1)
    wrapped = np.mod(turn + math.pi, 2.0 * math.pi) - math.pi
    angle = np.interp(wrapped, even, theta) + (turn - wrapped)
    angle[0], angle[-1] = start, start + 2.0 * math.pi
    return angle


def solve_reynolds(
    eps: float,
    eps_dot: float,
    eps_w: float,
    length_to_diameter: float,
    supply: float | None = None,
    cells: tuple[int, int] = (240, 20),
) -> Pressure:
    r"""Force of the film of a bearing of finite width under rotation and squeeze.

    .. math::
        \partial_\theta (h^3 \partial_\theta p) +
        \frac{1}{(L/D)^2} \partial_\zeta (h^3 \partial_\zeta p)
        = -(\dot\varepsilon \cos\theta - \tfrac12 \varepsilon W \sin\theta), \qquad
        h = 1 - \varepsilon \cos\theta

    with p = 0 at both ends, zeta = +-1, and Swift and Stieber's cavitation: p >= 0, and where the
    film breaks its gradient vanishes. That is an obstacle problem; finite volumes on a graded
    grid make it a complementarity problem with an M-matrix, which policy iteration (Newton's
    method on the cavitated set) solves exactly.

    Parameters
    ----------
    eps, eps_dot, eps_w : as for a film law
    length_to_diameter : L/D [-]
    supply : angle of a line held at p = 0, from the narrowest gap [rad]; None for none
    cells : cells around, and over half the length; force good to 0.3 % with the default

    References
    ----------
    .. [1] Christopherson, D. G. "A New Mathematical Method for the Solution of Film Lubrication
       Problems." Proc. IMechE 146 (1941): 126-135.
    .. [2] Cryer, C. W. "The Method of Christopherson for Solving Free Boundary Problems for
       Infinite Journal Bearings by Means of Finite Differences." Math. Comp. 25 (1971): 435-443.
    """
    half_w = 0.5 * eps_w
    if supply is None:  # cut the circle where the wedge opens fastest: no pressure there anyway
        supply = math.atan2(half_w, -eps_dot)
    theta = _angles(eps, supply, cells[0])
    zeta = np.sin(0.5 * math.pi * np.linspace(0.0, 1.0, cells[1] + 1))
    d_theta, d_zeta = np.diff(theta), np.diff(zeta)
    inner = theta[1:-1]
    w_theta = 0.5 * (d_theta[1:] + d_theta[:-1])
    w_zeta = 0.5 * np.append(d_zeta[0], d_zeta[1:] + d_zeta[:-1])  # zeta = 0 is a symmetry line

    gap_face = 1.0 - eps * np.cos(0.5 * (theta[1:] + theta[:-1]))
    around = np.outer(gap_face**3 / d_theta, w_zeta)
    gap = 1.0 - eps * np.cos(inner)
    along = np.outer(gap**3 * w_theta, 1.0 / (length_to_diameter**2 * d_zeta))
    diagonal = around[:-1] + around[1:] + along
    diagonal[:, 1:] += along[:, :-1]
    source = np.outer((eps_dot * np.cos(inner) - half_w * np.sin(inner)) * w_theta, w_zeta)

    p = obstacle(diagonal, around[1:-1], along[:, :-1], source)
    load = (p @ w_zeta) * w_theta
    return Pressure(
        float(-12.0 * load @ np.cos(inner)),
        float(-12.0 * load @ np.sin(inner)),
        inner,
        zeta[:-1],
        p,
        float(along[:, -1] @ p[:, -1]),
    )


def obstacle(diagonal: Array, around: Array, along: Array, source: Array) -> Array:
    """The least p >= 0 with A p >= source, A of five points: complementarity, solved exactly."""
    n, m = diagonal.shape
    wet = source > 0.0
    for _ in range(100):
        band = np.zeros((m + 1, n, m))
        band[0] = np.where(wet, diagonal, 1.0)
        band[1, :, :-1] = np.where(wet[:, 1:] & wet[:, :-1], -along, 0.0)
        band[m, :-1] += np.where(wet[1:] & wet[:-1], -around, 0.0)
        right = np.where(wet, source, 0.0).ravel()
        solved: Any = solveh_banded(band.reshape(m + 1, -1), right, lower=True, check_finite=False)
        p: Array = solved.reshape(n, m)
        residual = diagonal * p - source
        residual[1:] -= around * p[:-1]
        residual[:-1] -= around * p[1:]
        residual[:, 1:] -= along * p[:, :-1]
        residual[:, :-1] -= along * p[:, 1:]
        now = np.where(wet, p > 0.0, residual < -ROUNDING * np.abs(source))
        if np.array_equal(now, wet):
            return p
        wet = now
    raise RuntimeError("the cavitated set did not settle in 100 iterations")
