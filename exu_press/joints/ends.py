"""Where a joint holds on to a body: position, velocity and how forces reach its coordinates."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from exudyn.rigidBodyUtilities import (
    EulerParameters2G,
    EulerParameters2RotationMatrix,
    RotationVector2RotationMatrix,
    RotXYZ2G,
    RotXYZ2RotationMatrix,
)
from numpy.typing import NDArray

__all__ = ["ROTATIONS", "BodyEnd", "FlexiblePoint", "cross", "cross_matrix"]

Array = NDArray[np.float64]

ROTATIONS: dict[str, tuple[Callable[[list[float]], Array], Callable[[list[float]], Array]]] = {
    "RigidBodyEP": (EulerParameters2RotationMatrix, EulerParameters2G),
    "RigidBodyRxyz": (RotXYZ2RotationMatrix, RotXYZ2G),
    "RigidBodyRotVecLG": (RotationVector2RotationMatrix, RotationVector2RotationMatrix),
    "RigidBody2D": (
        lambda angle: RotXYZ2RotationMatrix([0.0, 0.0, angle[0]]),
        lambda angle: np.array([[0.0], [0.0], [1.0]]),
    ),
    "Ground": (lambda none: np.eye(3), lambda none: np.zeros((3, 0))),
}
"""Kind of node -> (rotation matrix, what turns rotation rates into the angular velocity)."""


@dataclass(frozen=True)
class FlexiblePoint:
    """An interface of a reduced flexible body, for the joints to hold on to.

    Attributes:
        body: object number of an ObjectFFRFreducedOrder.
        centre: (3,), its centre in the undeformed body's frame, m.
        translation: (3, modes): what a modal coordinate moves it, in the body's frame.
        turn: (3, modes): what a modal coordinate turns it.
    """

    body: int
    centre: Array
    translation: Array
    turn: Array


class BodyEnd:
    """A point of a rigid body in space or in the plane, or an interface of a flexible one.

    After `move`, in the global frame:
        position: (3,), m.
        velocity: (3,), m/s.
        spin: angular velocity, (3,), rad/s.
        rotation: (3, 3) from the body's to the global frame.
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
            kind: of the body's node, a key of ROTATIONS.
            index: where the node's coordinates start among those of the joint's item.
            reference: reference values of the node's coordinates.
            point: the end in the body's frame, (3,), m.
            modes: of a flexible body: where its modal coordinates start, and what they move and
                turn the end, (3, modes) each, in the body's frame.
        """
        self._matrix_of, self._spins_of = ROTATIONS[kind]
        self._moved = 2 if kind == "RigidBody2D" else len(reference) and 3
        self._reference, self._point = reference.tolist(), point
        self._rigid = slice(index, index + len(reference))
        self.places = list(range(index, index + len(reference)))
        self._modal: slice | None = None
        if modes is not None:
            start, translation, turn = modes
            self._modal = slice(start, start + translation.shape[1])
            self._translation = translation
            self._both = np.vstack([translation, turn])
            self.places += range(start, start + translation.shape[1])

    def move(self, q: Sequence[float], q_t: Sequence[float]) -> None:
        """Go to a state."""
        moved = self._moved
        pose = [
            value + change for value, change in zip(self._reference, q[self._rigid], strict=True)
        ]
        rates = q_t[self._rigid]
        self.rotation = rotation = self._matrix_of(pose[moved:])
        self._spins = self._spins_of(pose[moved:])
        spin = self._spins @ rates[moved:]
        still = [0.0] * (3 - moved)
        position, velocity = np.array(pose[:moved] + still), np.array([*rates[:moved], *still])
        if self._modal is None:
            self.arm = arm = rotation @ self._point
            self.spin = spin
        else:
            self.arm = arm = rotation @ (self._point + self._translation @ q[self._modal])
            moving = self._both @ q_t[self._modal]
            velocity += rotation @ moving[:3]
            self.spin = spin + rotation @ moving[3:]
        self.position = position + arm
        self.velocity = velocity + cross(spin, arm)

    def forces(self, force: Array, moment: Array) -> list[float]:
        """Return the generalised forces, in the order of `places`, of a force at the end."""
        turning = (cross(self.arm, force) + moment) @ self._spins
        values: list[float] = [*force[: self._moved].tolist(), *turning.tolist()]
        if self._modal is not None:
            back = self.rotation.T
            values += (np.concatenate([back @ force, back @ moment]) @ self._both).tolist()
        return values

    def rates(self) -> tuple[Array, Array]:
        """Return velocity and angular velocity by the coordinates' rates, (3, n) each."""
        size, moved = len(self._reference), self._moved
        velocity, spin = np.zeros((3, len(self.places))), np.zeros((3, len(self.places)))
        velocity[:moved, :moved] = np.eye(moved)
        spin[:, moved:size] = self._spins
        velocity[:, moved:size] -= cross_matrix(self.arm) @ self._spins
        if self._modal is not None:
            velocity[:, size:] = self.rotation @ self._both[:3]
            spin[:, size:] = self.rotation @ self._both[3:]
        return velocity, spin


def cross(v: Array, w: Array) -> Array:
    """Return v x w; a tenth of numpy's time for two vectors."""
    a, b, c = v.tolist()
    x, y, z = w.tolist()
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def cross_matrix(v: Array) -> Array:
    """Return the matrix that turns w into v x w."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
