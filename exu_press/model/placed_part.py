"""The solid of a flexible body in its place: which of its faces the mechanism's joints hold.

A solid has coordinates of its own, the z axis along the joints' axes. Faces that have names are
fitted to where the drawing has their joints; other faces are found where the joints are. What a
guide or a load holds is found by names or places, and a guide's usual faces are the solid's sides.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib.util import find_spec
from math import atan2, cos, degrees, hypot, inf, radians, sin
from typing import Any

import numpy as np

from exu_press.errors import InputError, prefixed
from exu_press.mechanism import Body, Joint, Mechanism, Motion, Point
from exu_press.numerics.arrays import Array
from exu_press.numerics.threads import one_thread
from exu_press.scene import Face, Flexible, Scene, mechanism_of
from exu_press.scene.bodies import DRIVE_FACE, GUIDE_FACE, faces_given, require_rainflow
from exu_press.scene.load import Load
from exu_press.terminal.progress import Progress
from fe_models import (
    CRANK_STEEL,
    Axis,
    Interface,
    Part,
    Patch,
    ReducedPart,
    Reduction,
    Sides,
    StepFile,
    reduced_part,
    shipped_faces,
    shipped_part,
)

__all__ = ["PlacedPart", "placed_parts"]

NEAR = 1e-4
"""m: how far a face's axis may lie from its joint; drawings are rounded to tenths of a mm."""

IN_THE_PLANE = ("x", "y", "rz")
"""Directions in which a planar mechanism loads faces."""

MILLIMETRES = 1e-3
"""Netgen reads every STEP file in millimetres, whatever its own unit."""


@dataclass(frozen=True)
class PlacedPart:
    """A reduced part in a body of the mechanism.

    Attributes:
        reduced: the part; its frame is the solid's.
        centre: of the body's frame, its centre of mass in the mechanism, in the solid's frame, m.
        angle: of the body's frame in the solid's, rad.
        faces: joint -> the interfaces that it holds.
        drive: the interface that the drive turns; empty for other bodies than the crank.
        guide: the interface that the guide holds; empty for bodies that have none.
        loads: name of a load on the body -> the interfaces that carry it.
        middles: name of a load that acts in the middle of its face -> that in the body's frame, m.
        damping_ratio: of every mode.
    """

    reduced: ReducedPart
    centre: Point
    angle: float
    faces: Mapping[str, tuple[str, ...]]
    drive: str
    guide: str
    loads: Mapping[str, tuple[str, ...]]
    middles: Mapping[str, Point]
    damping_ratio: float

    def carried(self, faces: tuple[str, ...], point: Point) -> tuple[Array, Array]:
        """Return a point (3,) that faces carry, and its displacement by each mode, (3, modes).

        Args:
            faces: interfaces, whose mean motion carries it.
            point: in the body's frame, m.
        """
        places, modes = [], []
        for interface in map(self.reduced.interface, faces):
            places.append([*self.place(point), float(interface.centre[2])])
            modes.append(interface.moved_point(places[-1])[1])
        return np.mean(places, axis=0), np.mean(modes, axis=0)

    def place(self, point: Point) -> Point:
        """Return a point of the body's frame in the solid's, m."""
        x, y = _turned(point, self.angle)
        return self.centre[0] + x, self.centre[1] + y

    def point(self, place: Array) -> Point:
        """Return a place of the solid's frame in the body's, m."""
        x, y, _ = place
        return _turned((x - self.centre[0], y - self.centre[1]), -self.angle)

    def frame(self, body: Motion) -> Motion:
        """Return the motion of the solid's frame from that of the body's."""
        x, y = _turned(self.centre, -self.angle)
        return _turned_by(body.point_motion((-x, -y)), -self.angle)

    def body(self, frame: Motion) -> Motion:
        """Return the motion of the body's frame from that of the solid's."""
        return _turned_by(frame.point_motion(self.centre), self.angle)

    @property
    def centre_of_mass(self) -> Point:
        """Return the solid's centre of mass in the body's frame, m.

        It is zero where the mechanism has it.
        """
        return self.point(self.reduced.centre_of_mass)

    @property
    def inertia(self) -> float:
        """Return the solid's inertia about its centre of mass, in the plane, kg m^2."""
        x, y = self.reduced.centre_of_mass[:2]
        return float(self.reduced.inertia[2, 2] - self.reduced.mass * (x * x + y * y))


def placed_parts(scene: Scene, *, quiet: bool = True) -> dict[str, PlacedPart]:
    """Return the flexible bodies of a scene, reduced, showing progress while they are made.

    Raises:
        InputError: NGSolve is not installed, a part cannot be meshed, or its faces are not where
            the joints are.
    """
    if find_spec("ngsolve") is None:
        raise InputError(
            f"bodies.{next(iter(scene.bodies))}: needs NGSolve, which is not installed; where "
            "pip has no wheels of it (Linux on ARM), build it from its sources"
        )
    mechanism = mechanism_of(scene)
    placed = {}
    for name, table in scene.bodies.items():
        with prefixed(f"bodies.{name}: "):
            if table.sn_stress is not None:
                require_rainflow()
            loads = {
                which: load
                for which, load in scene.load.items()
                if (load.body or mechanism.slider) == name
            }
            placed[name] = _placed(mechanism, mechanism.body(name), table, loads, quiet)
    return placed


def _placed(
    mechanism: Mechanism, body: Body, table: Flexible, loads: Mapping[str, Load], quiet: bool
) -> PlacedPart:
    """Return one body's part."""
    joints = mechanism.joints_of(body.name)
    driven = body.name == mechanism.crank
    asked = dict(table.faces)
    if not table.from_file:
        shipped_part(table.flexible)  # refuses a name that there is not
        asked = {**faces_given(shipped_faces(table.flexible)), **asked}
    faces = {joint.name: asked.get(joint.name, (Face(),)) for joint in joints}
    drive = asked.get(DRIVE_FACE, ()) if driven else ()
    patches = {f"load {name}": load.face for name, load in loads.items() if load.face is not None}
    guide = next((guide for guide in mechanism.guides if guide.body == body.name), None)
    if guide is not None:
        patches = {GUIDE_FACE: asked.get(GUIDE_FACE, ()), **patches}
    _refuse_shared(faces)
    named = all(face.name for each in faces.values() for face in each) and all(
        each and all(face.name for face in each) for each in patches.values()
    )
    fitted = named and table.origin is None and table.angle_deg is None
    origin, turn = table.origin or (0.0, 0.0), radians(table.angle_deg or 0.0)
    across = (1.0, 0.0) if guide is None else _turned(guide.normal, -turn)
    part, carriers = _part(table, body, faces, drive, patches, joints, origin, turn, across)
    reduction = Reduction(
        table.modes, table.method, flexibility_error=table.flexibility_error, loads=IN_THE_PLANE
    )
    reduced = _reduced(part, reduction, body.name, quiet)
    held = {
        joint: tuple(face.name or _face_name(joint, i) for i, face in enumerate(each))
        for joint, each in faces.items()
    }
    ends = [
        (joint, face, np.array(joint.at), reduced.interface(held[joint.name][i]).axis[:2])
        for joint in joints
        for i, face in enumerate(faces[joint.name])
    ]
    if fitted:
        origin, turn = _fitted([(at, axis) for _, face, at, axis in ends if not face.eccentric])
    for joint, face, at, axis in ends:
        x, y = _turned((at[0] - origin[0], at[1] - origin[1]), -turn)
        away = hypot(x - axis[0], y - axis[1])
        if away > NEAR and not face.eccentric:
            best = ", where it fits best" if fitted else ""
            raise InputError(
                f"face {face.name or joint.name!r} of {table.flexible!r} lies {1e3 * away:.4g} mm "
                f"from joints.{joint.name}, with origin = [{origin[0]:.6g}, {origin[1]:.6g}], "
                f"angle_deg = {degrees(turn):.6g}{best}; allowed is {1e3 * NEAR:g} mm"
            )
    for joint in joints:
        height = float(reduced.interface(held[joint.name][0]).axis[2])
        if joint.spherical and abs(height) > NEAR:
            raise InputError(
                f"the sphere of joints.{joint.name} has its centre at z = {height:.6g} m of "
                f"{table.flexible!r}; allowed is z = 0, the plane of the mechanism"
            )
    x, y = body.centre_of_mass
    centre, angle = _turned((x - origin[0], y - origin[1]), -turn), body.angle - turn

    def middle(load: str) -> Point:
        x, y, _ = reduced.interface(carriers[f"load {load}"]).centre
        return _turned((x - centre[0], y - centre[1]), -angle)

    return PlacedPart(
        reduced=reduced,
        centre=centre,
        angle=angle,
        faces=held,
        drive=(drive[0].name if drive else held[mechanism.shaft.name][0]) if driven else "",
        guide="" if guide is None else carriers[GUIDE_FACE],
        loads={
            name: (carriers[f"load {name}"],) if load.joint is None else held[load.joint]
            for name, load in loads.items()
        },
        middles={
            name: middle(name)
            for name, load in loads.items()
            if load.joint is None and load.offset is None
        },
        damping_ratio=table.damping_ratio,
    )


def _part(
    table: Flexible,
    body: Body,
    faces: Mapping[str, tuple[Face, ...]],
    drive: tuple[Face, ...],
    patches: Mapping[str, tuple[Face, ...]],
    joints: list[Joint],
    origin: Point,
    turn: float,
    across: Point,
) -> tuple[Part, dict[str, str]]:
    """Return the part to be reduced, in the material that is asked for.

    The second are the interfaces of the patches, which guide and loads hold, by the patches' names.
    """
    if not table.from_file:
        part = shipped_part(table.flexible, table.mesh_size)
        known = [interface.face for interface in part.interfaces]
        for what, each in {**faces, DRIVE_FACE: drive, **patches}.items():
            loaded = what in patches
            wrong = [face.name for face in each if face.name not in known]
            if loaded and len(each) != 1:
                wrong.append("")
            if wrong:
                given = f" {wrong[0]!r}" if wrong[0] else ""
                of_load = loaded and what != GUIDE_FACE
                key = f"{what.replace(' ', '.')}.face" if of_load else f"faces.{what}"
                raise InputError(
                    f"{table.flexible!r} has no face{given} for {what}; allowed as "
                    f"{key} is one of {', '.join(map(repr, known))}"
                )
        part = part.replace(material=_material(table, part.material))
        return part, {what: each[0].name for what, each in patches.items()}
    axes = {
        _face_name(joint.name, i): Axis(
            place=_turned((joint.at[0] - origin[0], joint.at[1] - origin[1]), -turn),
            sphere=joint.spherical,
            hole=joint.bearing == body.name,
            radius=face.radius,
            z=face.z,
        )
        for joint in joints
        for i, face in enumerate(faces[joint.name])
        if not face.name
    }
    names = [
        face.name or _face_name(joint, i)
        for joint, each in faces.items()
        for i, face in enumerate(each)
    ]
    turned = [face.name for face in drive if face.name not in names]
    first: dict[tuple[Face, ...], str] = {}  # loads may share a patch
    carriers = {
        what: each[0].name if len(each) == 1 and each[0].name else first.setdefault(each, what)
        for what, each in patches.items()
    }
    more = [name for name in dict.fromkeys(carriers.values()) if name not in (*names, *turned)]
    interfaces = [Interface(name) for name in dict.fromkeys(names)]
    interfaces += [Interface(name, ("rz",)) for name in turned]
    interfaces += [Interface(name, IN_THE_PLANE) for name in more]
    held = {
        what: tuple(map(_patch, each)) or Sides(across)
        for what, each in patches.items()
        if carriers[what] == what
    }
    limits: dict[str, Any] = {
        "time_limit": table.time_limit,
        "memory_limit": table.memory_limit_gb and 1e9 * table.memory_limit_gb,
    }
    solid = StepFile(
        table.path,
        MILLIMETRES,
        axes=axes,
        patches=held,
        **{name: limit for name, limit in limits.items() if limit is not None},
    )
    material = _material(table, CRANK_STEEL)
    return Part(solid.path.stem, solid, material, tuple(interfaces), table.mesh_size), carriers


def _patch(face: Face) -> Patch:
    if face.name:
        return Patch(face.name)
    low, high = zip(*(ends or (-inf, inf) for ends in face.ranges), strict=True)
    return Patch(box=(low, high))


def _material(table: Flexible, usual: Any) -> Any:
    keys = ("youngs_modulus", "poissons_ratio", "density")
    given = {name: getattr(table, name) for name in keys}
    return replace(usual, **{name: value for name, value in given.items() if value is not None})


def _reduced(part: Part, reduction: Reduction, name: str, quiet: bool) -> ReducedPart:
    with one_thread(), Progress(f"modes of {name}", 1.0, "", quiet=quiet) as progress:
        return reduced_part(part, reduction, report=lambda what, share: progress.update(share))


def _refuse_shared(faces: Mapping[str, tuple[Face, ...]]) -> None:
    """Refuse a face that two joints hold by its name, or one joint twice."""
    taken: dict[str, str] = {}
    for joint, each in faces.items():
        for face in each:
            if not face.name or face.eccentric:
                continue
            if face.name in taken:
                raise InputError(
                    f"joints.{taken[face.name]} and joints.{joint} hold the same face "
                    f"{face.name!r}; allowed are different ones"
                )
            taken[face.name] = joint


def _face_name(joint: str, number: int) -> str:
    return joint if number == 0 else f"{joint} {number + 1}"


def _fitted(pairs: list[tuple[Any, Any]]) -> tuple[Point, float]:
    """Return origin and angle (rad) of a solid whose axes fit best to where the joints are."""
    places, axes = (np.array(each) for each in zip(*pairs, strict=True))
    here, there = places - places.mean(axis=0), axes - axes.mean(axis=0)
    across = (there[:, 0] * here[:, 1] - there[:, 1] * here[:, 0]).sum()
    turn = atan2(across, (there * here).sum())
    x, y = _turned(axes.mean(axis=0), turn)
    mean = places.mean(axis=0)
    return (float(mean[0] - x), float(mean[1] - y)), turn


def _turned(vector: Any, angle: float) -> Point:
    c, s = cos(angle), sin(angle)
    return float(c * vector[0] - s * vector[1]), float(s * vector[0] + c * vector[1])


def _turned_by(motion: Motion, angle: float) -> Motion:
    """Return the motion of a frame that is turned by a constant angle, rad."""
    turned = motion.position + np.array([0.0, 0.0, angle])
    return Motion(turned, motion.velocity, motion.acceleration)
