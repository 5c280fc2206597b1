"""A clearance joint between two planar bodies: from coordinates to the pair and back to forces."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exu_press.joints.pairs import Pair

__all__ = ["GROUND", "PlanarEnd", "PlanarJoint", "PlanarState"]

Array = NDArray[np.float64]

GROUND = (0.0, 0.0, 0.0)
"""Stands behind all other coordinates for those of the ground."""


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
        cos, sin = math.cos(angle), math.sin(angle)
        arm_x, arm_y = along * cos - across * sin, along * sin + across * cos
        return (
            x + q[i] + arm_x,
            y + q[i + 1] + arm_y,
            q_t[i] - turn * arm_y,
            q_t[i + 1] + turn * arm_x,
            turn,
            arm_x,
            arm_y,
        )


@dataclass(frozen=True)
class PlanarState:
    """What a joint does at one instant; forces and moments in the x-y plane.

    Attributes:
        eccentricity: journal centre - bearing centre, (2,), m.
        eccentricity_rate: its time derivative, (2,), m/s.
        force: on the journal at its centre, (2,), N; the bearing has its opposite.
        moments: on the journal and on the bearing about their centres, (2,), N m.
        power: what forces and moments bring into the two bodies, W.
        stored_energy: elastic energy of the contact, J.
    """

    eccentricity: tuple[float, float]
    eccentricity_rate: tuple[float, float]
    force: tuple[float, float]
    moments: tuple[float, float]
    power: float
    stored_energy: float


class PlanarJoint:
    """One journal in one bearing, acting through one pair or several in parallel."""

    def __init__(self, journal: PlanarEnd, bearing: PlanarEnd, pairs: Sequence[Pair]) -> None:
        """Join the two ends by the pairs."""
        self.journal = journal
        self.bearing = bearing
        self.pairs = tuple(pairs)
        self.stateful = any(pair.stateful for pair in pairs)

    def add_force(self, q: Sequence[float], q_t: Sequence[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        x_j, y_j, u_j, v_j, w_j, a_j, b_j = self.journal.place(q, q_t)
        x_b, y_b, u_b, v_b, w_b, a_b, b_b = self.bearing.place(q, q_t)
        e, n_x, n_y, e_dot, v_t = _polar(x_j - x_b, y_j - y_b, u_j - u_b, v_j - v_b)
        i, k = self.journal.index, self.bearing.index
        for pair in self.pairs:
            polar = pair.force(e, e_dot, v_t, w_j, w_b)
            if polar is not None:
                f_n, f_t = polar[0]
                arm_j, arm_b, _, _ = pair.arms(e)
                f_x, f_y = f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x
                out[i] += f_x
                out[i + 1] += f_y
                out[i + 2] += arm_j * f_t + a_j * f_y - b_j * f_x
                out[k] -= f_x
                out[k + 1] -= f_y
                out[k + 2] += arm_b * f_t - a_b * f_y + b_b * f_x

    def add_jacobian(
        self, q: Sequence[float], q_t: Sequence[float], by_q: float, by_q_t: float, out: Array
    ) -> None:
        """Subtract by_q dQ/dq + by_q_t dQ/dq_t from `out`: the left-hand side's Jacobian."""
        x_j, y_j, u_j, v_j, w_j, a_j, b_j = self.journal.place(q, q_t)
        x_b, y_b, u_b, v_b, w_b, a_b, b_b = self.bearing.place(q, q_t)
        e, n_x, n_y, e_dot, v_t = _polar(x_j - x_b, y_j - y_b, u_j - u_b, v_j - v_b)
        turn = 1.0 / e if e > 0.0 else 0.0  # the direction has no derivative at e = 0
        law = np.zeros((4, 6))  # (F_n, F_t, m_J, m_B) by (e_n, e_t, v_n, v_t, omega_J, omega_B)
        f_x = f_y = 0.0
        for pair in self.pairs:
            polar = pair.force(e, e_dot, v_t, w_j, w_b)
            if polar is None:
                continue
            (f_n, f_t), (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = polar
            arm_j, arm_b, slope_j, slope_b = pair.arms(e)
            f_x += f_n * n_x - f_t * n_y
            f_y += f_n * n_y + f_t * n_x
            n_side = turn * (n_r * v_t - n_v * e_dot)
            t_side = turn * (t_r * v_t - t_v * e_dot)
            by_state = np.array([t_e, t_side, t_r, t_v, t_wj, t_wb])
            law[0] += (n_e, n_side - turn * f_t, n_r, n_v, n_wj, n_wb)
            law[1] += by_state
            law[1, 1] += turn * f_n
            law[2] += arm_j * by_state
            law[3] += arm_b * by_state
            law[2, 0] += slope_j * f_t
            law[3, 0] += slope_b * f_t
        if not law.any():
            return
        # rows: relative velocity along n and t and the two angular velocities, by q_t
        j_n, j_t = a_j * n_y - b_j * n_x, a_j * n_x + b_j * n_y
        b_n, b_t = a_b * n_y - b_b * n_x, a_b * n_x + b_b * n_y
        rates = np.array(
            (
                (n_x, n_y, j_n, -n_x, -n_y, -b_n),
                (-n_y, n_x, j_t, n_y, -n_x, -b_t),
                (0.0, 0.0, 1.0, 0.0, 0.0, 0.0),
                (0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
            )
        )
        changes = np.empty((6, 6))
        changes[:2] = by_q * rates[:2]
        changes[2:] = by_q_t * rates
        changes[2, 2] -= by_q * w_j * j_t
        changes[3, 2] += by_q * w_j * j_n
        changes[2, 5] += by_q * w_b * b_t
        changes[3, 5] -= by_q * w_b * b_n
        matrix = rates.T @ (law @ changes)
        matrix[2, 2] -= by_q * (a_j * f_x + b_j * f_y)
        matrix[5, 5] += by_q * (a_b * f_x + b_b * f_y)
        i, k = self.journal.index, self.bearing.index
        out[i : i + 3, i : i + 3] -= matrix[:3, :3]
        out[i : i + 3, k : k + 3] -= matrix[:3, 3:]
        out[k : k + 3, i : i + 3] -= matrix[3:, :3]
        out[k : k + 3, k : k + 3] -= matrix[3:, 3:]

    def state(self, q: Sequence[float], q_t: Sequence[float]) -> PlanarState:
        """Return what the joint does in a state of its two bodies."""
        x_j, y_j, u_j, v_j, w_j, _, _ = self.journal.place(q, q_t)
        x_b, y_b, u_b, v_b, w_b, _, _ = self.bearing.place(q, q_t)
        e_x, e_y, r_x, r_y = x_j - x_b, y_j - y_b, u_j - u_b, v_j - v_b
        e, n_x, n_y, e_dot, v_t = _polar(e_x, e_y, r_x, r_y)
        f_x = f_y = m_j = m_b = stored = 0.0
        for pair in self.pairs:
            stored += pair.stored_energy(e)
            polar = pair.force(e, e_dot, v_t, w_j, w_b)
            if polar is not None:
                f_n, f_t = polar[0]
                arm_j, arm_b, _, _ = pair.arms(e)
                f_x += f_n * n_x - f_t * n_y
                f_y += f_n * n_y + f_t * n_x
                m_j += arm_j * f_t
                m_b += arm_b * f_t
        power = f_x * r_x + f_y * r_y + m_j * w_j + m_b * w_b
        return PlanarState((e_x, e_y), (r_x, r_y), (f_x, f_y), (m_j, m_b), power, stored)

    def history(self, time: Array, q: Array, q_t: Array) -> list[PlanarState]:
        """Return what the joint did over recorded steps: (n,), and (n, m) coordinates."""
        for pair in self.pairs:
            pair.reset()
        states = []
        before = time[0]
        for now, row, row_t in zip(time.tolist(), q.tolist(), q_t.tolist(), strict=True):
            for pair in self.pairs:
                pair.begin_step(now - before, accepted=True)
            states.append(self.state([*row, *GROUND], [*row_t, *GROUND]))
            before = now
        return states


def _polar(
    e_x: float, e_y: float, r_x: float, r_y: float
) -> tuple[float, float, float, float, float]:
    """Return |e|, the direction n, and the rate's components along n and along t."""
    e = math.hypot(e_x, e_y)
    if e == 0.0:
        return 0.0, 1.0, 0.0, r_x, r_y
    n_x, n_y = e_x / e, e_y / e
    return e, n_x, n_y, r_x * n_x + r_y * n_y, r_y * n_x - r_x * n_y
