"""The film of a plane pad that lies aslant on a plane way: squeeze, wedge, shear."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Final

from exu_press.laws.parameters import demand, positive

__all__ = ["PadFilm", "PadLaw", "plane_pad"]

PadFilm = tuple[float, ...]
"""F_1, F_2, F_t; then the derivatives of each by h_1, h_2, their rates and U: 18 numbers, over the
viscosity: m^2/s, m and so on."""

PadLaw = Callable[[float, float, float, float, float], PadFilm]
"""law(h_1, h_2, h_1_dot, h_2_dot, sliding)."""

CELLS: Final = 24
WIDTHS: tuple[float, float] = (0.01, 100.0)
"""Least and largest width of a pad over its length: the range of the law."""

OUTSIDE: PadFilm = (math.nan,) * 18
Node = tuple[float, float, float, float, float]
"""Place, weights of both ends' forces, kappa times the node's share, 2 / size of the cell before
it."""

Pressed = tuple[float, float, float, float, float, float, float, float, float]

NOTHING: Pressed = (0.0,) * 9

ALIKE: Final = 1e-3
"""Relative difference of two gaps below which series stand for their logarithm."""


def plane_pad(length: float, width: float) -> PadLaw:
    r"""Film between a plane pad of finite width and a way, of linear thickness along the pad.

    .. math::
        \nabla \cdot (h^3 \nabla p) = 12 \mu\, v, \qquad
        v = \dot h - \tfrac12 U h', \qquad
        h = (1 - \lambda) h_1 + \lambda h_2

    .. math::
        F_1 = \int p (1 - \lambda)\, dA, \quad F_2 = \int p \lambda\, dA, \quad
        F_t = -\frac{h_2 - h_1}{2 L} (F_1 + F_2) - \mu U \int \frac{dA}{h}

    h_1 and h_2 are the gaps at the rear and at the front end, lambda runs from the one to the other
    and U is the velocity of the pad along it, p = 0 at the pad's edges. F_1 and F_2 press the pad's
    two ends off the way and F_t acts along it, the opposite on the way: the power F_1 h_1' + F_2
    h_2' + F_t U is minus the heat of the film, never positive.

    Across the pad the pressure has one shape, cosh(a w / 2) - cosh(a z) with a^2 = 10 / L^2, along
    it what Galerkin's method leaves of Reynolds' equation (Kantorovich's method, the shape that of
    its first iteration):

    .. math:: (h^3 P')' - \kappa h^3 P = 12 \mu g v

    Both limits are in it: sideways flow alone of a narrow pad, none of a wide one. Finite volumes
    with the exact flow of a linear gap solve it in 24 cells, denser towards the ends.

    Parameters
    ----------
    length : L of the pad along the way [m]
    width : w of the pad across the sliding [m], 0.01 L to 100 L

    Returns
    -------
    The law of gaps [m], their rates and the sliding velocity [m/s]; its forces are over the
    viscosity. NaN where a gap is not positive.

    Raises
    ------
    InputError : length or width is not positive, or their ratio is out of its range

    Notes
    -----
    Cavitation: Swift and Stieber (p >= 0, zero gradient where the film breaks), so that an opening
    gap does not pull. Shear is that of a gap full of oil, also where its pressure is ambient. The
    pad is shorter than its way.

    Accuracy, against Reynolds' equation in two dimensions with ends' gaps up to 1 : 40 and any
    direction of the rates: each end's force within 2 % of the sum of both up to w = 0.3 L, within
    5 % for wider pads. A parallel pad has no wedge, at any speed.

    Examples
    --------
    A square pad of 0.1 m that sinks at 1 mm/s through 20 um: 0.4217 mu w^3 L V / h^3 (the series
    that torsion of a square bar has too)

    >>> law = plane_pad(0.1, 0.1)
    >>> f_1, f_2, *_ = law(2e-5, 2e-5, -1e-3, -1e-3, 0.0)
    >>> round((f_1 + f_2) * 2e-5**3 / (0.1**4 * 1e-3), 2)
    0.42

    References
    ----------
    .. [1] Hamrock, B. J., S. R. Schmid and B. O. Jacobson. Fundamentals of Fluid Film Lubrication,
       2nd ed. Marcel Dekker, 2004. Fixed-incline slider, 9.1; parallel squeeze, 12.1.
    .. [2] Kantorovich, L. V., and V. I. Krylov. Approximate Methods of Higher Analysis. Noordhoff,
       1958, chap. 4.
    .. [3] Cameron, A. The Principles of Lubrication. Longmans, 1966. Side leakage of pads.
    """
    positive(length=length, width=width)
    ratio = width / length
    demand(
        WIDTHS[0] <= ratio <= WIDTHS[1],
        "width / length",
        ratio,
        "0.01 to 100",
        "Kantorovich's method",
    )
    kappa, fullness = _crosswise_shape(ratio)
    root = math.sqrt(12.0 * length**3 * width * fullness)
    half = 0.5 / length
    positions = [0.5 - 0.5 * math.cos(math.pi * i / CELLS) for i in range(CELLS + 1)]
    sizes = [upper - lower for lower, upper in pairwise(positions)]
    nodes: list[Node] = []
    for i in range(1, CELLS):
        share, position = 0.5 * (sizes[i - 1] + sizes[i]), positions[i]
        rear, front = root * share * (1.0 - position), root * share * position
        nodes.append((position, rear, front, kappa * share, 2.0 / sizes[i - 1]))
    last = 2.0 / sizes[-1]

    def law(h_1: float, h_2: float, rate_1: float, rate_2: float, sliding: float) -> PadFilm:
        if not (h_1 > 0.0 and h_2 > 0.0) or not math.isfinite(
            h_1 + h_2 + rate_1 + rate_2 + sliding
        ):
            return OUTSIDE
        tilt = h_2 - h_1
        wedge = half * sliding * tilt
        f_1, f_2, a_11, a_12, a_22, by_11, by_12, by_21, by_22 = _pressure_forces(
            h_1, h_2, rate_1 - wedge, rate_2 - wedge, nodes, last
        )
        shear, shear_1, shear_2 = _shear_integral(h_1, h_2, length * width)
        # v_1 and v_2 change with the tilt and with the sliding
        both_1, both_2 = a_11 + a_12, a_12 + a_22
        along = half * sliding
        n_11, n_12 = by_11 - both_1 * along, by_12 + both_1 * along
        n_21, n_22 = by_21 - both_2 * along, by_22 + both_2 * along
        u_1, u_2 = both_1 * half * tilt, both_2 * half * tilt
        pressed, slope = f_1 + f_2, half * tilt
        return (
            f_1,
            f_2,
            -slope * pressed - sliding * shear,
            n_11,
            n_12,
            -a_11,
            -a_12,
            u_1,
            n_21,
            n_22,
            -a_12,
            -a_22,
            u_2,
            half * pressed - slope * (n_11 + n_21) - sliding * shear_1,
            -half * pressed - slope * (n_12 + n_22) - sliding * shear_2,
            slope * both_1,
            slope * both_2,
            -slope * (u_1 + u_2) - shear,
        )

    return law


def _crosswise_shape(ratio: float) -> tuple[float, float]:
    """Return kappa of the equation along the pad, and (int phi)^2 / (w int phi^2) of the shape."""
    x = 0.5 * math.sqrt(10.0) * ratio
    if x < 0.05:  # else digits are lost: a parabola, to 2e-5
        return 10.0 / ratio**2, 5.0 / 6.0
    flat, steep = math.tanh(x) / x, 1.0 / math.cosh(x) ** 2
    mean, square = 1.0 - flat, 1.0 - 1.5 * flat + 0.5 * steep
    return 5.0 * (flat - steep) / square, mean * mean / square


def _pressure_forces(
    h_1: float, h_2: float, v_1: float, v_2: float, nodes: list[Node], last: float
) -> Pressed:
    """Return both ends' forces by pressure, minus their derivatives by v, and those by h.

    The source changes its sign once at most, so that pressure is one piece from one end of the pad
    on. It ends before the first node that would have none if it were the last one: elimination from
    that end shows it, and solves the complementarity problem exactly. v are the sources at the two
    ends, `nodes` the inner ones from the rear, `last` is 2 / size of the last cell.
    """
    if v_1 < 0.0 or v_1 == v_2 == 0.0:
        return _from_rear(h_1, h_2, v_1, v_2, nodes, last)
    if not v_2 < 0.0:
        return NOTHING
    f_2, f_1, a_22, a_12, a_11, by_22, by_21, by_12, by_11 = _from_rear(
        h_2, h_1, v_2, v_1, nodes, last
    )
    return f_1, f_2, a_11, a_12, a_22, by_11, by_12, by_21, by_22


def _from_rear(
    h_1: float, h_2: float, v_1: float, v_2: float, nodes: list[Node], last: float
) -> Pressed:
    """Return the same for a pressure that begins at the rear end, or none."""
    tilt, at_rest = h_2 - h_1, v_1 == v_2 == 0.0
    gaps = [h_1]
    flows: list[float] = []
    pivots: list[float] = []
    rear_sources: list[float] = []  # eliminated, of the sources that v_1 and v_2 alone would be
    front_sources: list[float] = []
    gap, rear_response, front_response, pivot = h_1, 0.0, 0.0, 1.0
    count, ahead = len(nodes), h_1 + tilt * nodes[0][0]
    flow = nodes[0][4] * gap * gap * ahead * ahead / (gap + ahead)
    previous = 0.0
    for i in range(count):
        _, rear, front, kappa, _ = nodes[i]
        gap = ahead
        if i + 1 < count:
            ahead, cell = h_1 + tilt * nodes[i + 1][0], nodes[i + 1][4]
        else:
            ahead, cell = h_2, last
        previous = flow
        back = previous / pivot if i > 0 else 0.0
        flow = cell * gap * gap * ahead * ahead / (gap + ahead)
        now = previous + flow + kappa * gap * gap * gap - back * previous
        rear_response, front_response = rear + back * rear_response, front + back * front_response
        if not (v_1 * rear_response + v_2 * front_response < 0.0 or at_rest):
            break
        pivot = now
        gaps.append(gap)
        flows.append(previous)
        pivots.append(pivot)
        rear_sources.append(rear_response)
        front_sources.append(front_response)
    full = len(rear_sources)
    if full == 0:
        return NOTHING
    # behind the last full node lies the end, or a node without pressure
    gaps.append(ahead if full == count else gap)
    position = 1.0 if full == count else nodes[full][0]
    flows.append(flow if full == count else previous)
    a_11 = a_12 = a_22 = by_1 = by_2 = 0.0
    rear_response = front_response = 0.0
    for i in range(full - 1, -2, -1):
        rear_ahead, front_ahead, position_ahead = rear_response, front_response, position
        gap, ahead, flow = gaps[i + 1], gaps[i + 2], flows[i + 1]
        if i >= 0:
            position, rear, front, kappa, _ = nodes[i]
            rear_response = (rear_sources[i] + flow * rear_ahead) / pivots[i]
            front_response = (front_sources[i] + flow * front_ahead) / pivots[i]
            a_11 += rear * rear_response
            a_12 += front * rear_response
            a_22 += front * front_response
            stiff = (
                3.0
                * kappa
                * gap
                * gap
                * (1.0 - position)
                * (v_1 * rear_response + v_2 * front_response)
            )
            by_1 += stiff * rear_response
            by_2 += stiff * front_response
        else:
            rear_response = front_response = position = 0.0
        # the cell ahead: how its flow changes with the gap at the rear end
        d_rear, d_front, both = (
            rear_ahead - rear_response,
            front_ahead - front_response,
            1.0 / (gap + ahead),
        )
        change = (1.0 - position) * (2.0 / gap - both) + (1.0 - position_ahead) * (
            2.0 / ahead - both
        )
        change *= flow * (v_1 * d_rear + v_2 * d_front)
        by_1 += change * d_rear
        by_2 += change * d_front
    f_1, f_2 = -a_11 * v_1 - a_12 * v_2, -a_12 * v_1 - a_22 * v_2
    # forces are of degree -3 in the gaps
    return (
        f_1,
        f_2,
        a_11,
        a_12,
        a_22,
        by_1,
        -(3.0 * f_1 + h_1 * by_1) / h_2,
        by_2,
        -(3.0 * f_2 + h_1 * by_2) / h_2,
    )


def _shear_integral(h_1: float, h_2: float, area: float) -> tuple[float, float, float]:
    """Return the integral of 1 / h over the pad, m, and its derivatives by both gaps."""
    mean, taper = 0.5 * (h_1 + h_2), (h_2 - h_1) / (h_1 + h_2)
    if abs(taper) < ALIKE:  # artanh(p) / p, and its derivative
        square = taper * taper
        whole, slope = (
            1.0 + square / 3.0 + 0.2 * square * square,
            taper * (2.0 / 3.0 + 0.8 * square),
        )
    else:
        whole = math.atanh(taper) / taper
        slope = (1.0 / (1.0 - taper * taper) - whole) / taper
    shear, total = area * whole / mean, h_1 + h_2
    by_mean, by_taper = -0.5 * shear / mean, area * slope / mean
    return (
        shear,
        by_mean - by_taper * 2.0 * h_2 / (total * total),
        by_mean + by_taper * 2.0 * h_1 / (total * total),
    )
