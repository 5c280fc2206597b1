"""A revolute clearance joint between bodies of any kind, through the same pairs as in the plane."""

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from exu_press.joints.ends import BodyEnd, cross, cross_matrix
from exu_press.joints.joint import JointState
from exu_press.joints.pairs import Arms, Pair, PairedJoint, PolarForce

__all__ = ["SpatialRevolute"]

Array = NDArray[np.float64]


class SpatialRevolute(PairedJoint):
    """A journal in a bearing whose axis is fixed in the bearing's body.

    Forces act in the plane normal to the axis through the journal's centre, moments about the axis;
    nothing resists sliding along the axis or tilting.
    """

    def __init__(
        self, journal: BodyEnd, bearing: BodyEnd, axis: Sequence[float], pairs: Sequence[Pair]
    ) -> None:
        """Join the two ends by the pairs; `axis` is the bearing's, in its body's frame."""
        super().__init__(pairs)
        self.journal = journal
        self.bearing = bearing
        self._axis = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
        self.places = journal.places + bearing.places
        self._acting: list[tuple[PolarForce, Arms]] = []

    def add_force(self, q: Sequence[float], q_t: Sequence[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        self._move(q, q_t)
        self._acting = []
        f_n = f_t = m_j = m_b = 0.0
        for pair in self.pairs:
            polar = pair.force(self._e, self._e_dot, self._v_t, self._w_j, self._w_b)
            if polar is not None:
                arms = pair.arms(self._e)
                self._acting.append((polar, arms))
                p_n, p_t = polar[0]
                f_n += p_n
                f_t += p_t
                m_j += arms[0] * p_t
                m_b += arms[1] * p_t
        self._wrench = f_n, f_t, m_j, m_b
        if self._acting:
            force, axis = f_n * self._n + f_t * self._t, self._turned_axis
            forces = self.journal.forces(force, m_j * axis)
            forces += self.bearing.forces(-force, m_b * axis - cross(self._along, force))
            for place, value in zip(self.places, forces, strict=True):
                out[place] += value

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t), but for what only turns arms and axes."""
        if not self._acting:
            return None
        turn = 1.0 / self._e if self._e > 0.0 else 0.0
        law = np.zeros((4, 6))  # (F_n, F_t, m_J, m_B) by (e_n, e_t, v_n, v_t, omega_J, omega_B)
        for ((f_n, f_t), by_n, by_t), (arm_j, arm_b, slope_j, slope_b) in self._acting:
            (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = by_n, by_t
            n_side = turn * (n_r * self._v_t - n_v * self._e_dot)
            t_side = turn * (t_r * self._v_t - t_v * self._e_dot)
            drag = np.array([t_e, t_side, t_r, t_v, t_wj, t_wb])
            law[0] += (n_e, n_side - turn * f_t, n_r, n_v, n_wj, n_wb)
            law[1] += drag
            law[1, 1] += turn * f_n
            law[2] += arm_j * drag
            law[3] += arm_b * drag
            law[2:, 0] += (slope_j * f_t, slope_b * f_t)
        rates = self._rates()
        changes = np.concatenate([by_q * rates[:2], by_q_t * rates])
        matrix: list[float] = (-rates.T @ (law @ changes)).ravel().tolist()
        return matrix

    @property
    def relative_velocity(self) -> tuple[float, ...]:
        """Rate of the eccentricity at the last `add_force`, m/s."""
        return tuple((self._e_dot * self._n + self._v_t * self._t).tolist())

    def state(self, q: Sequence[float], q_t: Sequence[float]) -> JointState:
        """Return what the joint does in a state of its two bodies."""
        self.add_force(q, q_t, [0.0] * len(q))
        f_n, f_t, m_j, m_b = self._wrench
        return JointState(
            eccentricity=tuple((self._e * self._n).tolist()),
            force=tuple((f_n * self._n + f_t * self._t).tolist()),
            velocity=self.relative_velocity,
            moments=(m_j, m_b),
            spins=(self._w_j, self._w_b),
            gap=self.clearance - self._e,
            stored_energy=sum(pair.stored_energy(self._e) for pair in self.pairs),
            stored_power=sum(pair.stored_force(self._e) for pair in self.pairs) * self._e_dot,
        )

    def _move(self, q: Sequence[float], q_t: Sequence[float]) -> None:
        """Find eccentricity, directions and velocities."""
        journal, bearing = self.journal, self.bearing
        journal.move(q, q_t)
        bearing.move(q, q_t)
        self._turned_axis = axis = bearing.rotation @ self._axis
        apart = journal.position - bearing.position
        self._along = along = axis * (axis @ apart)  # the bearing's force acts beside the journal
        across = apart - along
        self._e = e = sqrt(float(across @ across))
        self._n = n = across / e if e > 0.0 else _normal_to(axis)
        self._t = t = cross(axis, n)
        relative = journal.velocity - bearing.velocity + cross(along, bearing.spin)
        self._e_dot, self._v_t = float(n @ relative), float(t @ relative)
        self._w_j, self._w_b = float(axis @ journal.spin), float(axis @ bearing.spin)

    def _rates(self) -> Array:
        """Return velocities along n and t and both spins about the axis by all rates, (4, n)."""
        journal, journal_spin = self.journal.rates()
        bearing, bearing_spin = self.bearing.rates()
        bearing -= cross_matrix(self._along) @ bearing_spin
        none_j, none_b = np.zeros(journal.shape[1]), np.zeros(bearing.shape[1])
        rows = [
            (self._n @ journal, -self._n @ bearing),
            (self._t @ journal, -self._t @ bearing),
            (self._turned_axis @ journal_spin, none_b),
            (none_j, self._turned_axis @ bearing_spin),
        ]
        return np.array([np.concatenate(row) for row in rows])


def _normal_to(axis: Array) -> Array:
    """Return some unit vector normal to an axis."""
    normal = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    return np.asarray(normal / np.linalg.norm(normal))
