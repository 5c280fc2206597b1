"""The point where a joint holds a body: position, velocity, and forces on its coordinates.

In floats rather than arrays: less for three components, and this is called at every iteration.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, sin
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.rigidBodyUtilities import RotationVector2RotationMatrix, RotXYZ2G, RotXYZ2RotationMatrix

from exu_press.errors import InputError
from exu_press.joints.user_force import user_force_of
from exu_press.numerics.arrays import Array

__all__ = [
    "NODES",
    "BodyEnd",
    "BodyPoint",
    "FlexiblePoint",
    "Vector",
    "cross",
    "cross_matrix",
    "dot",
    "rotate",
    "spatial_end",
]

Vector = tuple[float, float, float]

Matrix = tuple[float, float, float, float, float, float, float, float, float]
"""By rows."""

NODES = ("Ground", "RigidBody2D", "RigidBodyEP", "RigidBodyRotVecLG", "RigidBodyRxyz")
"""Kinds of nodes."""


@dataclass(frozen=True)
class FlexiblePoint:
    """An interface of a reduced flexible body, for the joints to hold on to.

    Attributes:
        body: object number of an ObjectFFRFreducedOrder.
        centre: (3,), its centre in the undeformed body's frame, m.
        translation: (3, modes) by a unit of each modal coordinate, in the body's frame.
        rotation: (3, modes), likewise.
    """

    body: int
    centre: Array
    translation: Array
    rotation: Array


BodyPoint = tuple[Any, Sequence[float]] | FlexiblePoint
"""Object number of a body (an int, or Exudyn's ObjectIndex) and a point in its frame (m), or an
interface of a flexible body."""


class BodyEnd:
    """A point of a rigid body in space or in the plane, or an interface of a flexible one.

    After `move`, in the global frame:
        position: m.
        velocity: m/s.
        angular_velocity: rad/s.
        arm: from the body's frame to the point, m.
        rotation: from the body's to the global frame.
    """

    def __init__(
        self,
        kind: str,
        index: int,
        reference: Array,
        point: Array,
        modes: tuple[int, Array, Array] | None = None,
    ) -> None:
        """Hold on to a point.

        Args:
            kind: of the body's node, one of NODES.
            index: where the node's coordinates start among those of the joint's item.
            reference: reference values of the node's coordinates.
            point: the end in the body's frame, (3,), m.
            modes: of a flexible body: where its modal coordinates start, and what they move and
                rotate the end, (3, modes) each, in the body's frame.
        """
        self._kind = kind
        self._index = index
        self._reference: list[float] = reference.tolist()
        self._moved = 0 if kind == "Ground" else 2 if kind == "RigidBody2D" else 3
        self._point: Vector = (float(point[0]), float(point[1]), float(point[2]))
        self.indices = list(range(index, index + len(self._reference)))
        self._modal = 0
        self._both = np.zeros((6, 0))
        if modes is not None:
            self._modal, translation, rotation = modes
            self._both = np.vstack([translation, rotation])
            self.indices += range(self._modal, self._modal + translation.shape[1])
        self._modes: list[tuple[float, float, float, float, float, float]] = [
            (x, y, z, a, b, c) for x, y, z, a, b, c in self._both.T.tolist()
        ]
        self._moving = np.eye(6, len(self.indices))
        self._moving[:, self._moved :] = 0.0
        self.position: Vector = (0.0, 0.0, 0.0)
        self.velocity: Vector = (0.0, 0.0, 0.0)
        self.angular_velocity: Vector = (0.0, 0.0, 0.0)
        self.arm: Vector = (0.0, 0.0, 0.0)
        self.rotation: Matrix = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
        self._omegas: list[float] = []

    def move(self, q: list[float], q_t: list[float]) -> None:
        """Go to a state."""
        i, moved = self._index, self._moved
        pose = self._reference.copy()
        for c in range(len(pose)):
            pose[c] += q[i + c]
        self.rotation, self._omegas = _orientation(self._kind, pose)
        x = y = z = u = v = w = 0.0
        if moved > 0:
            x, y, u, v = pose[0], pose[1], q_t[i], q_t[i + 1]
        if moved > 2:
            z, w = pose[2], q_t[i + 2]
        omegas = self._omegas
        angles = len(pose) - moved
        omega_x = omega_y = omega_z = 0.0
        for c in range(angles):
            rate = q_t[i + moved + c]
            omega_x += omegas[c] * rate
            omega_y += omegas[angles + c] * rate
            omega_z += omegas[2 * angles + c] * rate
        rigid_omega = omega_x, omega_y, omega_z
        along, across, up = self._point
        modes, k = self._modes, self._modal
        if modes:
            shift_x = shift_y = shift_z = drift_x = drift_y = drift_z = 0.0
            turn_x = turn_y = turn_z = 0.0
            for t_x, t_y, t_z, r_x, r_y, r_z in modes:
                value, rate = q[k], q_t[k]
                k += 1
                shift_x += t_x * value
                shift_y += t_y * value
                shift_z += t_z * value
                drift_x += t_x * rate
                drift_y += t_y * rate
                drift_z += t_z * rate
                turn_x += r_x * rate
                turn_y += r_y * rate
                turn_z += r_z * rate
            along += shift_x
            across += shift_y
            up += shift_z
            drift = rotate(self.rotation, (drift_x, drift_y, drift_z))
            turn = rotate(self.rotation, (turn_x, turn_y, turn_z))
            u += drift[0]
            v += drift[1]
            w += drift[2]
            omega_x += turn[0]
            omega_y += turn[1]
            omega_z += turn[2]
        arm = rotate(self.rotation, (along, across, up))
        around = cross(rigid_omega, arm)
        self.arm = arm
        self.angular_velocity = omega_x, omega_y, omega_z
        self.position = x + arm[0], y + arm[1], z + arm[2]
        self.velocity = u + around[0], v + around[1], w + around[2]

    def add_forces(self, force: Vector, moment: Vector, out: list[float]) -> None:
        """Add the generalised forces of a force at the end and of a moment to `out`."""
        i, moved = self._index, self._moved
        if moved > 0:
            out[i] += force[0]
            out[i + 1] += force[1]
        if moved > 2:
            out[i + 2] += force[2]
        leverage = cross(self.arm, force)
        m_x, m_y, m_z = leverage[0] + moment[0], leverage[1] + moment[1], leverage[2] + moment[2]
        omegas = self._omegas
        angles = len(omegas) // 3
        for c in range(angles):
            turning = omegas[c] * m_x + omegas[angles + c] * m_y + omegas[2 * angles + c] * m_z
            out[i + moved + c] += turning
        modes, k = self._modes, self._modal
        if modes:
            f_x, f_y, f_z = turned_back(self.rotation, force)
            m_x, m_y, m_z = turned_back(self.rotation, moment)
            for t_x, t_y, t_z, r_x, r_y, r_z in modes:
                out[k] += t_x * f_x + t_y * f_y + t_z * f_z + r_x * m_x + r_y * m_y + r_z * m_z
                k += 1

    def rates(self) -> tuple[Array, Array]:
        """Return velocity and angular velocity by the coordinates' rates, (3, n) each."""
        size, moved = len(self._reference), self._moved
        both = self._moving.copy()
        velocity, omega = both[:3], both[3:]
        omega[:, moved:size] = omegas = np.array(self._omegas).reshape(3, -1)
        velocity[:, moved:size] = -cross_matrix(self.arm) @ omegas
        if self._modes:
            rotation = np.array(self.rotation).reshape(3, 3)
            velocity[:, size:] = rotation @ self._both[:3]
            omega[:, size:] = rotation @ self._both[3:]
        return velocity, omega

    def rates_along(self, n: Vector, t: Vector, axis: Vector, beside: Vector) -> Array:
        """Return the rates that a joint in a plane needs by the coordinates' rates, (3, n).

        These are the velocities along two directions and the angular velocity about an axis.

        Args:
            n: first direction.
            t: second direction.
            axis: of the angular velocity.
            beside: from the end to the point of the body whose velocity is meant, m.
        """
        size, moved, omegas = len(self._reference), self._moved, self._omegas
        arm, angles = self.arm, size - moved
        lever = arm[0] + beside[0], arm[1] + beside[1], arm[2] + beside[2]
        rates = np.zeros((3, len(self.indices)))
        for row, direction, turning in (
            (0, n, cross(lever, n)),
            (1, t, cross(lever, t)),
            (2, (0.0, 0.0, 0.0), axis),
        ):
            x, y, z = turning
            values = list(direction[:moved])
            for c in range(angles):
                values.append(omegas[c] * x + omegas[angles + c] * y + omegas[2 * angles + c] * z)
            rates[row, :size] = values
        if self._modes:
            r = self.rotation
            weights = [
                [*turned_back(r, n), *turned_back(r, cross(beside, n))],
                [*turned_back(r, t), *turned_back(r, cross(beside, t))],
                [0.0, 0.0, 0.0, *turned_back(r, axis)],
            ]
            rates[:, size:] = np.array(weights) @ self._both
        return rates


def spatial_end(mbs: exu.MainSystem, point: BodyPoint) -> BodyEnd:
    """Return the end on a body of any kind."""
    flexible = point if isinstance(point, FlexiblePoint) else None
    body, centre = (
        (point.body, point.centre) if isinstance(point, FlexiblePoint) else (point[0], point[1])
    )
    item = mbs.GetObject(body)
    local = np.zeros(3)
    local[: len(centre)] = centre
    kind = item["objectType"]
    if kind == "Ground":
        local += item["referencePosition"]
        return BodyEnd("Ground", 0, np.zeros(0), local)
    if flexible is not None and kind == "FFRFreducedOrder":
        rigid, modal = (int(node) for node in item["nodeNumbers"])
    elif flexible is None and kind in ("RigidBody", "RigidBody2D"):
        rigid, modal = int(item["nodeNumber"]), None
    else:
        raise InputError(
            f"body {body} is a {kind}: allowed are RigidBody, RigidBody2D, Ground and, between "
            "bodies in the plane, Mass1D and RotationalMass1D with a point of theirs, and "
            "FFRFreducedOrder with a FlexiblePoint"
        )
    node_kind = mbs.GetNode(rigid)["nodeType"]
    if node_kind not in NODES:
        raise InputError(f"body {body} has a {node_kind} node: allowed are {', '.join(NODES)}")
    reference = np.array(mbs.GetNodeParameter(rigid, "referenceCoordinates"), dtype=float)
    index = user_force_of(mbs).index_of(rigid)
    if flexible is None or modal is None:
        return BodyEnd(node_kind, index, reference, local)
    modes = (user_force_of(mbs).index_of(modal), flexible.translation, flexible.rotation)
    return BodyEnd(node_kind, index, reference, local, modes)


def cross(v: Vector, w: Vector) -> Vector:
    """Return v x w."""
    a, b, c = v
    x, y, z = w
    return b * z - c * y, c * x - a * z, a * y - b * x


def dot(v: Vector, w: Vector) -> float:
    """Return v . w."""
    return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]


def cross_matrix(v: Vector | Array) -> Array:
    """Return the matrix that turns w into v x w."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def _orientation(kind: str, pose: list[float]) -> tuple[Matrix, list[float]]:
    """Return a rotation and the matrix from rotation rates to the angular velocity, by rows."""
    if kind == "RigidBodyEP":
        e, x, y, z = pose[3], pose[4], pose[5], pose[6]
        return (
            1.0 - 2.0 * (z * z + y * y),
            2.0 * (y * x - z * e),
            2.0 * (z * x + y * e),
            2.0 * (z * e + y * x),
            1.0 - 2.0 * (z * z + x * x),
            2.0 * (z * y - x * e),
            2.0 * (z * x - y * e),
            2.0 * (z * y + x * e),
            1.0 - 2.0 * (y * y + x * x),
        ), [
            -2.0 * x, 2.0 * e, -2.0 * z, 2.0 * y,
            -2.0 * y, 2.0 * z, 2.0 * e, -2.0 * x,
            -2.0 * z, -2.0 * y, 2.0 * x, 2.0 * e,
        ]  # fmt: skip
    if kind == "RigidBody2D":
        c, s = cos(pose[2]), sin(pose[2])
        return (c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0), [0.0, 0.0, 1.0]
    if kind == "Ground":
        return (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), []
    if kind == "RigidBodyRxyz":
        matrix, omegas = RotXYZ2RotationMatrix(pose[3:]), RotXYZ2G(pose[3:])
    else:
        matrix = omegas = RotationVector2RotationMatrix(pose[3:])
    r = matrix.ravel().tolist()
    rotation = r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]
    return rotation, omegas.ravel().tolist()


def rotate(r: Matrix, v: Vector) -> Vector:
    """Return a vector of the body's frame in the global one."""
    a, b, c, d, e, f, g, h, i = r
    x, y, z = v
    return a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z


def turned_back(r: Matrix, v: Vector) -> Vector:
    """Return a vector of the global frame in the body's."""
    a, b, c, d, e, f, g, h, i = r
    x, y, z = v
    return a * x + d * y + g * z, b * x + e * y + h * z, c * x + f * y + i * z
