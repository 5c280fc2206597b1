"""A reduced part in a body of the mechanism: where it lies, and its faces that are held.

A solid has coordinates of its own, the z axis along the joints' axes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import cos, sin
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.rigidBodyUtilities import EulerParameters2RotationMatrix

from exu_press.errors import InputError
from exu_press.joints.ends import FlexiblePoint
from exu_press.mechanism import Joint, Motion, Point
from exu_press.numerics.arrays import Array
from fe_models import FlexibleBody, ReducedPart

__all__ = ["PlacedPart", "point_name", "rotate"]


@dataclass(frozen=True)
class PlacedPart:
    """A reduced part in a body of the mechanism.

    Attributes:
        reduced: the part; its frame is the solid's.
        centre: of the body's frame, its centre of mass in the mechanism, in the solid's frame, m.
        angle: of the body's frame in the solid's, rad.
        faces: joint -> the interfaces that it holds.
        drive: the interface that the drive turns; empty for other bodies than the crank.
        guide: the interface that a guide of the frame holds; empty for bodies that have none.
        carriers: name of a slot or of a guide of a moving body -> the interface that moves with it.
        loads: name of a load on the body -> the interfaces that carry it.
        middles: name of a load in the middle of its face -> the middle in the body's frame, m.
        damping_ratio: of every mode.
    """

    reduced: ReducedPart
    centre: Point
    angle: float
    faces: Mapping[str, tuple[str, ...]]
    drive: str
    guide: str
    carriers: Mapping[str, str]
    loads: Mapping[str, tuple[str, ...]]
    middles: Mapping[str, Point]
    damping_ratio: float

    def carried_point(self, faces: tuple[str, ...], point: Point) -> tuple[Array, Array]:
        """Return a point in the solid's frame, (3,), and its displacement by each mode, (3, modes).

        Args:
            faces: interfaces with whose mean motion the point moves.
            point: in the body's frame, m.
        """
        positions, modes = [], []
        for interface in map(self.reduced.interface, faces):
            positions.append([*self.to_solid(point), float(interface.centre[2])])
            modes.append(interface.moved_point(positions[-1])[1])
        return np.mean(positions, axis=0), np.mean(modes, axis=0)

    def joint_points(self, joint: str) -> list[tuple[str, str]]:
        """Return the interfaces that a joint holds, each with the name of its point."""
        return [(face, point_name(joint, n)) for n, face in enumerate(self.faces[joint])]

    def load_points(self, load: str) -> list[tuple[str, str]]:
        """Return the interfaces that carry a load, each with the name of its point."""
        return [(face, f"load {load} {n}") for n, face in enumerate(self.loads[load], 1)]

    def joint_centre(self, joint: Joint, face: str, point: Point) -> tuple[float, float, float]:
        """Return a joint's centre on one of its faces in the solid; balls lie in the plane."""
        height = 0.0 if joint.spherical else float(self.reduced.interface(face).centre[2])
        return *self.to_solid(point), height

    def joint_end(self, body: FlexibleBody, joint: Joint, point: Point) -> Any:
        """Return the end of a clearance joint that moves with an interface, at a point (x, y).

        Raises:
            InputError: the joint holds several faces.
        """
        face, *further = self.faces[joint.name]
        if further:
            raise InputError(
                f"joints.{joint.name}: holds {1 + len(further)} faces of the flexible "
                f"{body.reduced.name}; allowed is 'ideal'"
            )
        interface = body.reduced.interface(face)
        centre = np.array(self.joint_centre(joint, face, point))
        if body.node_modes is None:
            return body.object_number, centre
        return FlexiblePoint(body.object_number, centre, interface.translation, interface.rotation)

    def guide_end(self, body: FlexibleBody, point: Point) -> Any:
        """Return an end for guideways with clearance, which moves with the guide's faces."""
        position, modes = self.carried_point((self.guide,), point)
        if body.node_modes is None:
            return body.object_number, position
        rotation = self.reduced.interface(self.guide).rotation
        return FlexiblePoint(body.object_number, position, modes, rotation)

    def guided_motion(self, mbs: exu.MainSystem, body: FlexibleBody) -> tuple[Array, Array]:
        """Return the guided motion of a body, linear in its coordinates: x, y (m), angle (rad).

        It is the mean motion of the faces in the guide, at the body's centre of mass. In a guide a
        body hardly turns: the error goes with the square of its tilt.

        Returns:
            Its values at the reference values of the coordinates, (3,), and its derivatives by the
            coordinates of the frame and of the modes, (3, coordinates).
        """
        pose = np.asarray(mbs.GetNodeParameter(body.node_rigid, "referenceCoordinates"))
        rotation = np.asarray(EulerParameters2RotationMatrix(pose[3:]))
        centre, modes = self.carried_point((self.guide,), (0.0, 0.0))
        arm = rotation @ centre
        turning = 2.0 * np.array([-pose[6], 0.0, 0.0, pose[3]])
        rows = np.zeros((3, len(pose) + self.reduced.mode_count))
        rows[:2, :2] = np.eye(2)
        rows[:, 3:7] = np.outer((-arm[1], arm[0], 1.0), turning)
        rows[:2, 7:] = (rotation @ modes)[:2]
        rows[2, 7:] = self.reduced.interface(self.guide).rotation[2]
        angle = 2.0 * np.arctan2(pose[6], pose[3]) + self.angle
        return np.array([pose[0] + arm[0], pose[1] + arm[1], angle]), rows

    def to_solid(self, point: Point) -> Point:
        """Return a point of the body's frame in the solid's, m."""
        x, y = rotate(point, self.angle)
        return self.centre[0] + x, self.centre[1] + y

    def to_body(self, point: Sequence[float] | Array) -> Point:
        """Return a point of the solid's frame in the body's, m."""
        return rotate((point[0] - self.centre[0], point[1] - self.centre[1]), -self.angle)

    def frame_motion(self, body: Motion) -> Motion:
        """Return the motion of the solid's frame from that of the body's."""
        x, y = rotate(self.centre, -self.angle)
        return _rotate_frame(body.point_motion((-x, -y)), -self.angle)

    def body_motion(self, frame: Motion) -> Motion:
        """Return the motion of the body's frame from that of the solid's."""
        return _rotate_frame(frame.point_motion(self.centre), self.angle)

    @property
    def centre_of_mass(self) -> Point:
        """The solid's centre of mass in the body's frame, m; the mechanism's is its origin."""
        return self.to_body(self.reduced.centre_of_mass)

    @property
    def inertia(self) -> float:
        """The solid's inertia about its centre of mass, in the plane, kg m^2."""
        x, y = self.reduced.centre_of_mass[:2]
        return float(self.reduced.inertia[2, 2] - self.reduced.mass * (x * x + y * y))


def point_name(joint: str, number: int = 0) -> str:
    """Return the name of the point or interface where a joint holds one of its faces."""
    return joint if number == 0 else f"{joint} {number + 1}"


def rotate(vector: Any, angle: float) -> Point:
    """Return a vector of the plane, turned by an angle, rad."""
    c, s = cos(angle), sin(angle)
    return float(c * vector[0] - s * vector[1]), float(s * vector[0] + c * vector[1])


def _rotate_frame(motion: Motion, angle: float) -> Motion:
    """Return the motion of a frame at a constant angle, rad, from another one."""
    return replace(motion, position=motion.position + np.array([0.0, 0.0, angle]))
