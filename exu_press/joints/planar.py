"""A clearance joint between two planar bodies: from coordinates to the pair and back to forces.

Vectors of the plane are complex numbers: i v is v after a quarter turn, conj(a) b holds the scalar
product and the cross product of a and b. That is half the time of sums of products.
"""

from cmath import rect
from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, hypot
from operator import add

from exu_press.joints.joint import JointState
from exu_press.joints.pairs import Load, Pair, PairedJoint, Slopes

__all__ = ["PlanarEnd", "PlanarJoint"]


@dataclass(frozen=True)
class PlanarEnd:
    """A point of a planar body.

    Attributes:
        index: where the body's coordinates (x, y, angle) start among those of the joint's item.
        reference: their reference values, m and rad.
        point: the point in the body's frame, m.
    """

    index: int
    reference: tuple[float, float, float]
    point: tuple[float, float]

    @property
    def polar(self) -> tuple[float, float]:
        """Distance of the point from the body's origin, and its direction in the reference."""
        x, y = self.point
        return hypot(x, y), atan2(y, x) + self.reference[2]


class PlanarJoint(PairedJoint):
    """One journal in one bearing, acting through one pair or several in parallel."""

    def __init__(self, journal: PlanarEnd, bearing: PlanarEnd, pairs: Sequence[Pair]) -> None:
        """Join the two ends by the pairs."""
        super().__init__(pairs)
        self.journal = journal
        self.bearing = bearing
        self.places = [end.index + c for end in (journal, bearing) for c in range(3)]
        i, k = journal.index, bearing.index
        offset = complex(*journal.reference[:2]) - complex(*bearing.reference[:2])
        self._ends = (i, i + 1, i + 2, *journal.polar, k, k + 1, k + 2, *bearing.polar, offset)
        self._loads: list[Load | None] = [None for _ in self.pairs]
        self._place = (0.0, 1.0 + 0j, 0j, 0.0, 0.0, 0j, 0j)
        self._before = self._place, self._loads

    def add_force(self, q: Sequence[float], q_t: Sequence[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        x_j, y_j, r_j, length_j, angle_j, x_b, y_b, r_b, length_b, angle_b, offset = self._ends
        arm_j, arm_b = rect(length_j, angle_j + q[r_j]), rect(length_b, angle_b + q[r_b])
        w_j, w_b = q_t[r_j], q_t[r_b]
        apart = q[x_j] - q[x_b] + offset + arm_j - arm_b + (q[y_j] - q[y_b]) * 1j
        velocity = q_t[x_j] - q_t[x_b] + 1j * (q_t[y_j] - q_t[y_b] + w_j * arm_j - w_b * arm_b)
        e = abs(apart)
        n = apart / e if e > 0.0 else 1.0 + 0j
        polar = velocity * n.conjugate()
        self._before = self._place, self._loads
        self._place = (e, n, polar, w_j, w_b, arm_j, arm_b)
        e_dot, v_t = polar.real, polar.imag
        self._loads = []
        for pair in self.pairs:  # a comprehension would cost a call
            load = pair.load(e, e_dot, v_t, w_j, w_b)
            self._loads.append(load)
            if load is not None:
                f_n, f_t, m_j, m_b, _ = load
                force = (f_n + f_t * 1j) * n
                f_x, f_y = force.real, force.imag
                out[x_j] += f_x
                out[y_j] += f_y
                out[r_j] += m_j + (arm_j.conjugate() * force).imag
                out[x_b] -= f_x
                out[y_b] -= f_y
                out[r_b] += m_b - (arm_b.conjugate() * force).imag

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t) at the state of the last `add_force`.

        Exact in the first state; then a film's dependence on its speeds is a secant.

        Q are the six generalised forces, q the journal's and the bearing's coordinates; 36 numbers,
        row by row. None where no pair acts.
        """
        matrix: list[float] | None = None
        for i, load in enumerate(self._loads):
            if load is not None:
                part = self._jacobian_of(i, load, by_q, by_q_t)
                matrix = part if matrix is None else list(map(add, matrix, part))
        return matrix

    def _jacobian_of(self, i: int, load: Load, by_q: float, by_q_t: float) -> list[float]:
        """Return one pair's part of the Jacobian."""
        e, n, polar, w_j, w_b, arm_j, arm_b = self._place
        n_x, n_y, e_dot, v_t = n.real, n.imag, polar.real, polar.imag
        f_n, f_t, _, _, answer = load
        pair = self.pairs[i]
        slopes = pair.slopes(answer, e, w_j, w_b)
        if pair.bends:
            slopes = self._secant(slopes, load, self._before[1][i])
        (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = slopes
        lever_j, lever_b, slope_j, slope_b = pair.arms(e)
        slope_j *= by_q * f_t
        slope_b *= by_q * f_t
        # the arms of the two points along n and along t
        back = n.conjugate()
        arm_j, arm_b = arm_j * back, arm_b * back
        j_n, j_t, b_n, b_t = arm_j.real, arm_j.imag, arm_b.real, arm_b.imag
        # f_n and f_t by a motion along n and along t; the direction turns with the latter, and the
        # force with the direction, which has no derivative at e = 0
        turn = by_q / e if e > 0.0 else 0.0
        n_out = by_q * n_e + by_q_t * n_r
        n_side = by_q_t * n_v + turn * (n_r * v_t - n_v * e_dot - f_t)
        t_out = by_q * t_e + by_q_t * t_r
        t_side = by_q_t * t_v + turn * (t_r * v_t - t_v * e_dot)
        turn *= f_n
        # for each coordinate: f_n, f_t (the drag) and, with the force's turning, its part along t;
        # an angle moves its point along i arm and turns that point's velocity by -spin arm
        n_1, drag_1 = n_out * n_x - n_side * n_y, t_out * n_x - t_side * n_y
        n_2, drag_2 = n_out * n_y + n_side * n_x, t_out * n_y + t_side * n_x
        spin = by_q * w_j
        n_3 = by_q_t * n_wj + j_n * (n_side - spin * n_r) - j_t * (n_out + spin * n_v)
        drag_3 = by_q_t * t_wj + j_n * (t_side - spin * t_r) - j_t * (t_out + spin * t_v)
        spin = by_q * w_b
        n_4 = by_q_t * n_wb - b_n * (n_side - spin * n_r) + b_t * (n_out + spin * n_v)
        drag_4 = by_q_t * t_wb - b_n * (t_side - spin * t_r) + b_t * (t_out + spin * t_v)
        t_1, t_2 = drag_1 - turn * n_y, drag_2 + turn * n_x
        t_3, t_4 = drag_3 + turn * j_n, drag_4 - turn * b_n
        # force, moment on the journal's and moment on the bearing's body, by each coordinate
        x_1, x_2, x_3, x_4 = (
            n_x * n_1 - n_y * t_1,
            n_x * n_2 - n_y * t_2,
            n_x * n_3 - n_y * t_3,
            n_x * n_4 - n_y * t_4,
        )
        y_1, y_2, y_3, y_4 = (
            n_y * n_1 + n_x * t_1,
            n_y * n_2 + n_x * t_2,
            n_y * n_3 + n_x * t_3,
            n_y * n_4 + n_x * t_4,
        )
        j_1 = lever_j * drag_1 + slope_j * n_x - j_t * n_1 + j_n * t_1
        j_2 = lever_j * drag_2 + slope_j * n_y - j_t * n_2 + j_n * t_2
        j_3 = lever_j * drag_3 - (slope_j + n_3) * j_t + j_n * t_3
        j_4 = lever_j * drag_4 + slope_j * b_t - j_t * n_4 + j_n * t_4
        b_1 = lever_b * drag_1 + slope_b * n_x + b_t * n_1 - b_n * t_1
        b_2 = lever_b * drag_2 + slope_b * n_y + b_t * n_2 - b_n * t_2
        b_3 = lever_b * drag_3 - slope_b * j_t + b_t * n_3 - b_n * t_3
        b_4 = lever_b * drag_4 + (slope_b + n_4) * b_t - b_n * t_4
        j_3 -= by_q * (j_n * f_n + j_t * f_t)
        b_4 += by_q * (b_n * f_n + b_t * f_t)
        return [
            *(-x_1, -x_2, -x_3, x_1, x_2, -x_4),
            *(-y_1, -y_2, -y_3, y_1, y_2, -y_4),
            *(-j_1, -j_2, -j_3, j_1, j_2, -j_4),
            *(x_1, x_2, x_3, -x_1, -x_2, x_4),
            *(y_1, y_2, y_3, -y_1, -y_2, y_4),
            *(-b_1, -b_2, -b_3, b_1, b_2, -b_4),
        ]

    def _secant(self, slopes: Slopes, load: Load, before: Load | None) -> Slopes:
        """Return slopes that lead from this state's force to the one before's, too (Broyden 1965).

        Exudyn starts each step without accelerations, so that the speeds across a film are off by
        as much as they are; the step then ends near where the last one ended. Newton's method gets
        there in one iteration along the secant, in two along the tangent.
        """
        if before is None:
            return slopes
        e, _, polar, w_j, w_b, _, _ = self._place
        e_0, _, polar_0, w_j0, w_b0, _, _ = self._before[0]
        (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = slopes
        way = polar_0 - polar
        r, v = way.real, way.imag
        d_e, d_j, d_b = e_0 - e, w_j0 - w_j, w_b0 - w_b
        n_rest = before[0] - load[0] - n_e * d_e - n_r * r - n_v * v - n_wj * d_j - n_wb * d_b
        t_rest = before[1] - load[1] - t_e * d_e - t_r * r - t_v * v - t_wj * d_j - t_wb * d_b
        square = r * r + v * v
        size = n_r * n_r + n_v * n_v + t_r * t_r + t_v * t_v
        # a larger correction, or none that is a number, means that the two states lie apart
        if not n_rest * n_rest + t_rest * t_rest < size * square:
            return slopes
        n_rest /= square
        t_rest /= square
        return (
            (n_e, n_r + n_rest * r, n_v + n_rest * v, n_wj, n_wb),
            (t_e, t_r + t_rest * r, t_v + t_rest * v, t_wj, t_wb),
        )

    @property
    def relative_velocity(self) -> tuple[float, float]:
        """Rate of the eccentricity at the last `add_force`, m/s."""
        velocity = self._place[2] * self._place[1]
        return velocity.real, velocity.imag

    def state(self, q: Sequence[float], q_t: Sequence[float]) -> JointState:
        """Return what the joint does in a state of its two bodies."""
        self.add_force(q, q_t, [0.0] * len(q))
        e, n, polar, w_j, w_b, _, _ = self._place
        loads = [load for load in self._loads if load is not None]
        f_n, f_t = sum(load[0] for load in loads), sum(load[1] for load in loads)
        m_j, m_b = sum(load[2] for load in loads), sum(load[3] for load in loads)
        apart, force = e * n, complex(f_n, f_t) * n
        return JointState(
            eccentricity=(apart.real, apart.imag),
            force=(force.real, force.imag),
            moments=(m_j, m_b),
            velocity=self.relative_velocity,
            spins=(w_j, w_b),
            gap=self.clearance - e,
            stored_energy=sum(pair.stored_energy(e) for pair in self.pairs),
            stored_power=sum(pair.stored_force(e) for pair in self.pairs) * polar.real,
        )
