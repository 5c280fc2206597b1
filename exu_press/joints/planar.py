"""A clearance joint between two planar bodies: from coordinates to the pair and back to forces."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin, sqrt

from exu_press.joints.joint import JointState
from exu_press.joints.pairs import Arms, Pair, PairedJoint, PolarForce

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

    def place(
        self, q: Sequence[float], q_t: Sequence[float]
    ) -> tuple[float, float, float, float, float, float, float]:
        """Return position, velocity (x, y), angular velocity and the arm (x, y) of the point."""
        i, (x, y, angle), (along, across) = self.index, self.reference, self.point
        angle += q[i + 2]
        turn = q_t[i + 2]
        c, s = cos(angle), sin(angle)
        arm_x, arm_y = along * c - across * s, along * s + across * c
        return (
            x + q[i] + arm_x,
            y + q[i + 1] + arm_y,
            q_t[i] - turn * arm_y,
            q_t[i + 1] + turn * arm_x,
            turn,
            arm_x,
            arm_y,
        )


class PlanarJoint(PairedJoint):
    """One journal in one bearing, acting through one pair or several in parallel."""

    def __init__(self, journal: PlanarEnd, bearing: PlanarEnd, pairs: Sequence[Pair]) -> None:
        """Join the two ends by the pairs."""
        super().__init__(pairs)
        self.journal = journal
        self.bearing = bearing
        self.places = [end.index + c for end in (journal, bearing) for c in range(3)]
        self._acting: list[tuple[PolarForce, Arms]] = []
        self._place = (0.0, 1.0, *(0.0,) * 9)

    def add_force(self, q: Sequence[float], q_t: Sequence[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        x_j, y_j, u_j, v_j, w_j, a_j, b_j = self.journal.place(q, q_t)
        x_b, y_b, u_b, v_b, w_b, a_b, b_b = self.bearing.place(q, q_t)
        e_x, e_y, r_x, r_y = x_j - x_b, y_j - y_b, u_j - u_b, v_j - v_b
        e = sqrt(e_x * e_x + e_y * e_y)
        n_x, n_y = (e_x / e, e_y / e) if e > 0.0 else (1.0, 0.0)
        e_dot, v_t = r_x * n_x + r_y * n_y, r_y * n_x - r_x * n_y
        self._place = (e, n_x, n_y, e_dot, v_t, w_j, a_j, b_j, w_b, a_b, b_b)
        self._acting = []
        for pair in self.pairs:
            polar = pair.force(e, e_dot, v_t, w_j, w_b)
            if polar is not None:
                arms = pair.arms(e)
                self._acting.append((polar, arms))
                f_n, f_t = polar[0]
                f_x, f_y = f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x
                i, k = self.journal.index, self.bearing.index
                out[i] += f_x
                out[i + 1] += f_y
                out[i + 2] += arms[0] * f_t + a_j * f_y - b_j * f_x
                out[k] -= f_x
                out[k + 1] -= f_y
                out[k + 2] += arms[1] * f_t - a_b * f_y + b_b * f_x

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t) at the state of the last `add_force`.

        Q are the six generalised forces, q the journal's and the bearing's coordinates; 36 numbers,
        row by row. None where no pair acts.
        """
        if not self._acting:
            return None
        e, n_x, n_y, e_dot, v_t, w_j, a_j, b_j, w_b, a_b, b_b = self._place
        turn = by_q / e if e > 0.0 else 0.0  # the direction has no derivative at e = 0
        # a quarter turn of each arm, along n and along t
        j_n, j_t = a_j * n_y - b_j * n_x, a_j * n_x + b_j * n_y
        b_n, b_t = a_b * n_y - b_b * n_x, a_b * n_x + b_b * n_y
        # for each coordinate: what it moves along n and t, what it spins, and what it adds to the
        # velocity along n and t by turning the arm of a spinning body
        columns = (
            (n_x, -n_y, 0.0, 0.0, 0.0, 0.0),
            (n_y, n_x, 0.0, 0.0, 0.0, 0.0),
            (j_n, j_t, by_q_t, 0.0, -by_q * w_j * j_t, by_q * w_j * j_n),
            (-b_n, -b_t, 0.0, by_q_t, by_q * w_b * b_t, -by_q * w_b * b_n),
        )
        rows_x, rows_y, rows_j, rows_b = [0.0] * 4, [0.0] * 4, [0.0] * 4, [0.0] * 4
        for polar, (arm_j, arm_b, slope_j, slope_b) in self._acting:
            (f_n, f_t), (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = polar
            n_out = by_q * n_e + by_q_t * n_r
            n_side = by_q_t * n_v + turn * (n_r * v_t - n_v * e_dot - f_t)
            t_out = by_q * t_e + by_q_t * t_r
            t_side = by_q_t * t_v + turn * (t_r * v_t - t_v * e_dot)
            for c, (p_n, p_t, s_j, s_b, u_n, u_t) in enumerate(columns):
                d_n = n_out * p_n + n_side * p_t + n_wj * s_j + n_wb * s_b + n_r * u_n + n_v * u_t
                drag = t_out * p_n + t_side * p_t + t_wj * s_j + t_wb * s_b + t_r * u_n + t_v * u_t
                d_t = drag + turn * f_n * p_t
                reach = by_q * f_t * p_n
                rows_x[c] += n_x * d_n - n_y * d_t
                rows_y[c] += n_y * d_n + n_x * d_t
                rows_j[c] += arm_j * drag + slope_j * reach + j_n * d_n + j_t * d_t
                rows_b[c] += arm_b * drag + slope_b * reach - b_n * d_n - b_t * d_t
            f_x, f_y = f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x
            rows_j[2] -= by_q * (a_j * f_x + b_j * f_y)
            rows_b[3] += by_q * (a_b * f_x + b_b * f_y)
        matrix: list[float] = []
        for (by_x, by_y, by_j, by_b), sign in (
            (rows_x, -1.0),
            (rows_y, -1.0),
            (rows_j, -1.0),
            (rows_x, 1.0),
            (rows_y, 1.0),
            (rows_b, -1.0),
        ):
            x, y = sign * by_x, sign * by_y
            matrix += (x, y, sign * by_j, -x, -y, sign * by_b)
        return matrix

    @property
    def relative_velocity(self) -> tuple[float, float]:
        """Rate of the eccentricity at the last `add_force`, m/s."""
        _, n_x, n_y, e_dot, v_t, *_ = self._place
        return e_dot * n_x - v_t * n_y, e_dot * n_y + v_t * n_x

    def state(self, q: Sequence[float], q_t: Sequence[float]) -> JointState:
        """Return what the joint does in a state of its two bodies."""
        self.add_force(q, q_t, [0.0] * len(q))
        e, n_x, n_y, _, _, w_j, _, _, w_b, _, _ = self._place
        f_n = f_t = m_j = m_b = 0.0
        for ((p_n, p_t), _, _), (arm_j, arm_b, _, _) in self._acting:
            f_n += p_n
            f_t += p_t
            m_j += arm_j * p_t
            m_b += arm_b * p_t
        return JointState(
            eccentricity=(e * n_x, e * n_y),
            force=(f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x),
            moments=(m_j, m_b),
            velocity=self.relative_velocity,
            spins=(w_j, w_b),
            gap=self.clearance - e,
            stored_energy=sum(pair.stored_energy(e) for pair in self.pairs),
            stored_power=sum(pair.stored_force(e) for pair in self.pairs) * self._place[3],
        )
