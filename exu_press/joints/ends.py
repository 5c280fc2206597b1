"""Where a joint holds on to a body: position, velocity and how forces reach its coordinates."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from exudyn.rigidBodyUtilities import (
    EulerParameters2G,
    EulerParameters2RotationMatrix,
    RotationVector2RotationMatrix,
    RotXYZ2G,
    RotXYZ2RotationMatrix,
)
from numpy.typing import NDArray

__all__ = ["ROTATIONS", "BodyEnd", "EndMotion", "FlexiblePoint", "cross_matrix"]

Array = NDArray[np.float64]

ROTATIONS: dict[str, tuple[Callable[[Array], Array], Callable[[Array], Array]]] = {
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


@dataclass(frozen=True)
class EndMotion:
    """Motion of an end in the global frame.

    Attributes:
        position: (3,), m.
        velocity: (3,), m/s.
        spin: angular velocity, (3,), rad/s.
        rotation: (3, 3) from the body's to the global frame.
        by_rates: (3, n): the velocity by the rates of the end's n coordinates.
        spin_by_rates: (3, n): the angular velocity by them.
    """

    position: Array
    velocity: Array
    spin: Array
    rotation: Array
    by_rates: Array
    spin_by_rates: Array


@dataclass(frozen=True)
class BodyEnd:
    """A point of a rigid body in space or in the plane, or an interface of a flexible one.

    Attributes:
        kind: of the body's node, a key of ROTATIONS.
        index: where the node's coordinates start among those of the joint's item.
        reference: reference values of the node's coordinates.
        point: the end in the body's frame, (3,), m.
        mode_index: where the modal coordinates start, for a flexible body.
        translation: (3, modes): what a modal coordinate moves the end, in the body's frame.
        turn: (3, modes): what a modal coordinate turns the end.
    """

    kind: str
    index: int
    reference: Array
    point: Array
    mode_index: int = 0
    translation: Array = field(default_factory=lambda: np.zeros((3, 0)))
    turn: Array = field(default_factory=lambda: np.zeros((3, 0)))

    @property
    def places(self) -> list[int]:
        """Where the end's coordinates lie among those of the joint's item."""
        rigid = range(self.index, self.index + len(self.reference))
        return [*rigid, *range(self.mode_index, self.mode_index + self.translation.shape[1])]

    def motion(self, q: Sequence[float], q_t: Sequence[float]) -> EndMotion:
        """Return where the end is and how it moves."""
        size = len(self.reference)
        pose = self.reference + q[self.index : self.index + size]
        moved = 2 if self.kind == "RigidBody2D" else size and 3
        turn_to_matrix, turn_to_spin = ROTATIONS[self.kind]
        rotation = turn_to_matrix(pose[moved:])
        arm = self.point
        modes = self.translation.shape[1]
        if modes:
            arm = arm + self.translation @ q[self.mode_index : self.mode_index + modes]
        arm = rotation @ arm
        by_rates = np.zeros((3, size + modes))
        spin_by_rates = np.zeros((3, size + modes))
        by_rates[:moved, :moved] = np.eye(moved)
        spins = turn_to_spin(pose[moved:])
        spin_by_rates[:, moved:size] = spins
        by_rates[:, moved:size] -= cross_matrix(arm) @ spins
        if modes:
            by_rates[:, size:] = rotation @ self.translation
            spin_by_rates[:, size:] = rotation @ self.turn
        rates = np.array([q_t[place] for place in self.places])
        position = np.zeros(3)
        position[:moved] = pose[:moved]
        return EndMotion(
            position=position + arm,
            velocity=by_rates @ rates,
            spin=spin_by_rates @ rates,
            rotation=rotation,
            by_rates=by_rates,
            spin_by_rates=spin_by_rates,
        )


def cross_matrix(v: Array) -> Array:
    """Return the matrix that turns w into v x w."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
