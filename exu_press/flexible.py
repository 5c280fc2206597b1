"""Crank shaft and linkage of the press as flexible bodies, and what holds them in space.

NGSolve's modes come from fe_models: from its cache, or made there on first use. In the plane the
joints are those of rigid bodies; what the plane holds of itself is held here: the linkage sideways
and upright by the slide, the crank shaft lengthwise by its first main bearing.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from math import cos, pi, sin
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import MarkerBodyRigid, ObjectJointGeneric, ObjectJointSpherical
from exudyn.rigidBodyUtilities import (
    EulerParameters2G,
    EulerParameters2RotationMatrix,
    RotationMatrixZ,
)
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.joints import FlexiblePoint
from exu_press.mechanism import Motion
from exu_press.progress import Progress
from exu_press.scene import Scene
from exu_press.scene.tables import Flexible
from fe_models import (
    FlexibleBody,
    ReducedPart,
    Reduction,
    add_flexible_body,
    reduced_part,
    shipped_part,
)

__all__ = [
    "FACES",
    "MAIN_BEARINGS",
    "FrameStart",
    "add_part",
    "deformed",
    "hold_crank",
    "hold_linkage",
    "joint_end",
    "reduced_parts",
    "undeformed",
]

Array = NDArray[np.float64]

FACES = {
    ("crank", "crank_pin"): "pin",
    ("crank", "counter_pin"): "journal A",
    ("linkage", "crank_pin"): "big bore",
    ("linkage", "slide_pin"): "small bore",
}
"""(body, joint) -> the interface of the part that carries the joint."""

MAIN_BEARINGS = {"main_bearing_a": "journal A", "main_bearing_b": "journal B"}

HELD = ("held_a", "held_b", "held_c")
"""Three points of the linkage around its small bore, in the plane that the slide keeps it in."""


@dataclass(frozen=True)
class FrameStart:
    """Where a flexible body starts: its frame, and the modal coordinates if it is deformed.

    Attributes:
        position: of the frame's origin, (3,), m.
        rotation: from the body to the global frame, (3, 3).
        velocity: (3,), m/s.
        angular_velocity: global components, (3,), rad/s.
        modes: (n,), kg^0.5 m.
        modes_t: (n,), their rates.
    """

    position: Array
    rotation: Array
    velocity: Array
    angular_velocity: Array
    modes: Array | None = None
    modes_t: Array | None = None


def undeformed(start: Motion) -> FrameStart:
    """Return the start of a frame from its motion (x, y, angle) in the plane, one instant."""
    (x, y, angle), (u, v, spin) = start.position[0], start.velocity[0]
    return FrameStart(
        position=np.array([x, y, 0.0]),
        rotation=np.asarray(RotationMatrixZ(angle)),
        velocity=np.array([u, v, 0.0]),
        angular_velocity=np.array([0.0, 0.0, spin]),
    )


def deformed(
    mbs: exu.MainSystem, body: FlexibleBody, q: Array, q_t: Array, modes: Array, modes_t: Array
) -> FrameStart:
    """Return the start of a frame from a state of the body in another system.

    Args:
        mbs: that system.
        body: in it.
        q: (7,) displacements of the frame's coordinates, Euler parameters.
        q_t: (7,) their rates.
        modes: (n,) modal coordinates.
        modes_t: (n,) their rates.
    """
    pose = np.asarray(mbs.GetNodeParameter(body.node_rigid, "referenceCoordinates")) + q
    return FrameStart(
        position=pose[:3],
        rotation=np.asarray(EulerParameters2RotationMatrix(pose[3:])),
        velocity=q_t[:3],
        angular_velocity=np.asarray(EulerParameters2G(pose[3:])) @ q_t[3:],
        modes=modes,
        modes_t=modes_t,
    )


def reduced_parts(scene: Scene, *, quiet: bool = True) -> dict[str, ReducedPart]:
    """Return crank and linkage as the scene wants them, showing progress while they are made.

    Raises:
        InputError: NGSolve is not installed.
    """
    table = scene.flexible
    if table is None:
        return {}
    if find_spec("ngsolve") is None:
        raise InputError(
            "bodies = 'flexible': needs NGSolve, which is not installed (there are no wheels for "
            "Linux on ARM); allowed here is 'rigid'"
        )
    shapes = {"crank": table.crank, "linkage": table.linkage}
    return {name: _reduced(table, shape, quiet) for name, shape in shapes.items()}


def add_part(
    mbs: exu.MainSystem,
    scene: Scene,
    name: str,
    part: ReducedPart,
    start: FrameStart,
    joints: Mapping[str, Sequence[float]],
) -> FlexibleBody:
    """Add a part.

    The frames of the solids: the crank's in the shaft's axis, its pin upwards at angle 0; the
    linkage's in the middle of its bores, x towards the slide.

    Args:
        mbs: the system.
        scene: for gravity and damping.
        name: "crank" or "linkage".
        part: reduced.
        start: of the frame and the modes.
        joints: name -> place (x, y) of the ideal joints in the frame. They sit where the drawing
            has them; a mesh's interface has its centre a micrometre beside.
    """
    assert scene.flexible is not None
    points = {}
    for joint, place in joints.items():
        face = MAIN_BEARINGS.get(joint) or FACES[name, joint]
        along = 0.0 if name == "linkage" else part.interface(face).centre[2]
        points[joint] = face, (*place, along)
    if name == "linkage":
        bore = part.interface("small bore")
        for held, turn in zip(HELD, (0.0, 2.0 * pi / 3.0, 4.0 * pi / 3.0), strict=True):
            x_held, y_held = bore.centre[:2] + bore.arm * np.array([cos(turn), sin(turn)])
            points[held] = bore.face, (x_held, y_held, 0.0)
    return add_flexible_body(
        mbs,
        part,
        position=start.position.tolist(),
        rotation=start.rotation,
        velocity=start.velocity.tolist(),
        angular_velocity=start.angular_velocity.tolist(),
        initial_modes=start.modes,
        initial_modes_t=start.modes_t,
        gravity=(0.0, -scene.gravity, 0.0),
        damping_ratio=scene.flexible.damping_ratio,
        points=points,
        name=name,
    )


def joint_end(body: FlexibleBody, face: str, point: Sequence[float]) -> Any:
    """Return what a clearance joint holds on to: the interface's motion, at the point (x, y)."""
    interface = body.part.interface(face)
    centre = np.array([*point, interface.centre[2]])
    if body.node_modes is None:
        return body.object_number, centre
    return FlexiblePoint(body.object_number, centre, interface.translation, interface.rotation)


def hold_crank(mbs: exu.MainSystem, ground: int, crank: FlexibleBody, drive: int) -> dict[str, int]:
    """Rest the main journals in the frame and turn the flange; return the bearings by name.

    Args:
        mbs: the system.
        ground: object number of the frame.
        crank: the body.
        drive: marker that turns at the crank's speed; the flange follows it about its axis alone.
    """
    bearings = {}
    for name, face in MAIN_BEARINGS.items():
        along = float(crank.part.interface(face).centre[2])
        seat = mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground, localPosition=[0.0, 0.0, along]))
        held = [1, 1, 1] if face == "journal A" else [1, 1, 0]
        bearing = ObjectJointSpherical(
            name=name,
            markerNumbers=[crank.add_point_marker(mbs, name), seat],
            constrainedAxes=held,
        )
        bearings[name] = int(mbs.AddObject(bearing))
    _hold(mbs, drive, crank.add_marker(mbs, "flange"), [0, 0, 0, 0, 0, 1])
    return bearings


def hold_linkage(mbs: exu.MainSystem, slide: int, linkage: FlexibleBody) -> None:
    """Keep the linkage in the plane of the slide, whose marker is given.

    Three points do what the height and the two tilts of a marker with an orientation would, which
    costs more: it has three nodes and is asked for its rotation, too.
    """
    for name in HELD:
        points = [slide, linkage.add_point_marker(mbs, name)]
        mbs.AddObject(ObjectJointSpherical(markerNumbers=points, constrainedAxes=[0, 0, 1]))


def _hold(mbs: exu.MainSystem, by: int, marker: int, axes: list[int]) -> None:
    """Hold relative motions along and about the axes of marker `by`."""
    mbs.AddObject(ObjectJointGeneric(markerNumbers=[by, marker], constrainedAxes=axes))


def _reduced(table: Flexible, name: str, quiet: bool) -> ReducedPart:
    """Return one part reduced."""
    part = shipped_part(name, table.mesh_size)
    if table.modulus_factor != 1.0:
        modulus = part.material.youngs_modulus * table.modulus_factor
        part = part.replace(material=replace(part.material, youngs_modulus=modulus))
    reduction = Reduction(modes=table.modes, method=table.method)
    with Progress(f"modes of {name}", 1.0, "", quiet=quiet) as progress:
        return reduced_part(part, reduction, report=lambda what, share: progress.update(share))
