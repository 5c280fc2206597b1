"""A revolute clearance joint between bodies of any kind, with the interface laws of the plane."""

from collections.abc import Sequence
from math import sqrt

import numpy as np

from exu_press.joints.ends import BodyEnd, Vector, cross, dot, rotate
from exu_press.joints.interface import InterfaceJoint, InterfaceLaw
from exu_press.numerics.arrays import Array

__all__ = ["SpatialRevolute"]


class SpatialRevolute(InterfaceJoint):
    """A journal in a bearing whose axis is fixed in the bearing's body.

    Forces act in the plane normal to the axis through the journal's centre, moments about the axis;
    nothing resists sliding along the axis or tilting.
    """

    def __init__(
        self,
        journal: BodyEnd,
        bearing: BodyEnd,
        axis: Sequence[float],
        interfaces: Sequence[InterfaceLaw],
        turns: bool = True,
    ) -> None:
        """Join the two ends by the interfaces; `axis` is the bearing's, in its body's frame."""
        super().__init__(journal.indices + bearing.indices, interfaces, turns)
        self.journal = journal
        self.bearing = bearing
        x, y, z = (float(component) for component in axis)
        length = sqrt(x * x + y * y + z * z)
        self._axis: Vector = (x / length, y / length, z / length)
        # after `add_force`: the turned axis, across it towards the journal and tangentially, and
        # from the bearing's centre along the axis to the journal's
        self._a: Vector = self._axis
        self._n: Vector = (1.0, 0.0, 0.0)
        self._t: Vector = (0.0, 1.0, 0.0)
        self._along: Vector = (0.0, 0.0, 0.0)

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        journal, bearing = self.journal, self.bearing
        journal.move(q, q_t)
        bearing.move(q, q_t)
        self._a = axis = rotate(bearing.rotation, self._axis)
        p, b = journal.position, bearing.position
        apart = p[0] - b[0], p[1] - b[1], p[2] - b[2]
        height = dot(axis, apart)
        # the bearing's force acts beside the journal
        self._along = along = axis[0] * height, axis[1] * height, axis[2] * height
        e, n = self._eccentricity_and_normal(
            (apart[0] - along[0], apart[1] - along[1], apart[2] - along[2])
        )
        t = cross(axis, n)
        self._n, self._t = n, t
        aside = cross(along, bearing.angular_velocity)
        v, u = journal.velocity, bearing.velocity
        relative = v[0] - u[0] + aside[0], v[1] - u[1] + aside[1], v[2] - u[2] + aside[2]
        w_j, w_b = dot(axis, journal.angular_velocity), dot(axis, bearing.angular_velocity)
        for load in self._load((e, dot(n, relative), dot(t, relative), w_j, w_b)):
            if load is not None:
                f_n, f_t, m_j, m_b, _ = load
                force = _sum(f_n, n, f_t, t)
                journal.add_forces(force, (m_j * axis[0], m_j * axis[1], m_j * axis[2]), out)
                x, y, z = cross(along, force)
                moment = m_b * axis[0] - x, m_b * axis[1] - y, m_b * axis[2] - z
                bearing.add_forces((-force[0], -force[1], -force[2]), moment, out)

    def jacobian(self, by_q: float, by_q_t: float) -> Array | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t), less the terms of turning arms and axes."""
        e, e_dot, v_t, w_j, w_b = self._motion
        turn = 1.0 / e if self._turns and e > 0.0 else 0.0
        # (F_n, F_t, M_J, M_B) by motions along n and t and rotations of journal and bearing
        normal, across = [0.0] * 4, [0.0] * 4
        on_journal, on_bearing = [0.0] * 4, [0.0] * 4
        acting = False
        for i, load in enumerate(self._loads):
            if load is None:
                continue
            acting = True
            f_n, f_t, _, _, response = load
            (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = self._partials(i, load)
            arm_j, arm_b, slope_j, slope_b = self.interfaces[i].arms(e)
            n_side = turn * (n_r * v_t - n_v * e_dot - f_t)
            t_side = turn * (t_r * v_t - t_v * e_dot)
            normal[0] += by_q * n_e + by_q_t * n_r
            normal[1] += by_q * n_side + by_q_t * n_v
            normal[2] += by_q_t * n_wj
            normal[3] += by_q_t * n_wb
            drag = (
                by_q * t_e + by_q_t * t_r,
                by_q * t_side + by_q_t * t_v,
                by_q_t * t_wj,
                by_q_t * t_wb,
            )
            for c in range(4):
                across[c] += drag[c]
                on_journal[c] += arm_j * drag[c]
                on_bearing[c] += arm_b * drag[c]
            across[1] += by_q * turn * f_n
            shear_e, shear_w = self.interfaces[i].shear_partials(response, w_j, w_b)
            on_journal[0] += by_q * (slope_j * f_t - shear_e)
            on_bearing[0] += by_q * (slope_b * f_t + shear_e)
            sheared = by_q_t * shear_w
            on_journal[2] -= sheared
            on_journal[3] += sheared
            on_bearing[2] += sheared
            on_bearing[3] -= sheared
        if not acting:
            return None
        rates = self._rates()
        partials = np.array([normal, across, on_journal, on_bearing])
        return np.asarray(rates.T @ -(partials @ rates)).ravel()

    def in_frame(self, along_n: float, along_t: float) -> tuple[float, ...]:
        """Return a vector of the joint's plane at the last `add_force` in the global frame."""
        return _sum(along_n, self._n, along_t, self._t)

    def _eccentricity_and_normal(self, apart: Vector) -> tuple[float, Vector]:
        """Return eccentricity and normal for how far the centres lie apart across the axis, m."""
        e = sqrt(dot(apart, apart))
        return e, (apart[0] / e, apart[1] / e, apart[2] / e) if e > 0.0 else _normal_to(self._a)

    def _rates(self) -> Array:
        """Return, by all rates, velocities along n and t and both angular velocities, (4, n)."""
        n, t, axis = self._n, self._t, self._a
        journal = self.journal.rates_along(n, t, axis, (0.0, 0.0, 0.0))
        bearing = self.bearing.rates_along(n, t, axis, self._along)
        size = len(self.journal.indices)
        rates = np.zeros((4, len(self.indices)))
        rates[:3, :size] = journal
        rates[:2, size:] = -bearing[:2]
        rates[3, size:] = bearing[2]
        return rates


def _sum(a: float, v: Vector, b: float, w: Vector) -> Vector:
    return a * v[0] + b * w[0], a * v[1] + b * w[1], a * v[2] + b * w[2]


def _normal_to(axis: Vector) -> Vector:
    x, y, z = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]).tolist()
    length = sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length
