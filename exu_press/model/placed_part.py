"""The solid of a flexible body in its mechanism, with the faces that joints, guide and loads hold.

A solid has coordinates of its own, the z axis along the joints' axes. Named faces are fitted to the
joints' positions in the drawing; other faces are searched at the joints' positions. Faces of guides
and loads are named or lie in boxes; by default a guide holds the solid's sides.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from math import atan2, cos, degrees, hypot, inf, radians, sin
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.rigidBodyUtilities import EulerParameters2RotationMatrix

from exu_press.errors import InputError, error_prefix
from exu_press.joints.ends import FlexiblePoint
from exu_press.mechanism import Body, Joint, Mechanism, Motion, Point
from exu_press.numerics.arrays import Array
from exu_press.numerics.threads import one_thread
from exu_press.scene import Face, Flexible, Scene, mechanism_of
from exu_press.scene.bodies import (
    DRIVE_FACE,
    GUIDE_FACE,
    USUAL_MESH_SIZE,
    faces_given,
    require_rainflow,
)
from exu_press.scene.load import Load
from exu_press.terminal.progress import Progress
from fe_models import (
    CRANK_STEEL,
    Axis,
    FlexibleBody,
    Interface,
    Material,
    MatrixPart,
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

__all__ = ["PlacedPart", "placed_parts", "point_name"]

NEAR = 1e-4
"""m: largest distance of a face's axis from its joint; drawings are rounded to tenths of a mm."""

SIZES = 0.005, 10.0
"""Sizes of a body of nodes over the mechanism's: wrong units are off by 25 at least."""

IN_THE_PLANE = ("x", "y", "rz")
"""Motions of faces that a planar mechanism loads."""

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
        x, y = _rotate(point, self.angle)
        return self.centre[0] + x, self.centre[1] + y

    def to_body(self, point: Sequence[float] | Array) -> Point:
        """Return a point of the solid's frame in the body's, m."""
        return _rotate((point[0] - self.centre[0], point[1] - self.centre[1]), -self.angle)

    def frame_motion(self, body: Motion) -> Motion:
        """Return the motion of the solid's frame from that of the body's."""
        x, y = _rotate(self.centre, -self.angle)
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


def placed_parts(scene: Scene, *, quiet: bool = True) -> dict[str, PlacedPart]:
    """Return the flexible bodies of a scene, reduced, and show the progress of their reduction.

    Raises:
        InputError: NGSolve is not installed, a part cannot be meshed, or its faces are not where
            the joints are.
    """
    if find_spec("ngsolve") is None:
        raise InputError(
            f"{scene.origin}bodies.{next(iter(scene.bodies))}: needs NGSolve, which is not "
            "installed; where pip has no wheels of it (Linux on ARM), build it from its sources"
        )
    mechanism = mechanism_of(scene)
    parts = {}
    for name, table in scene.bodies.items():
        with error_prefix(f"{scene.origin}bodies.{name}: "):
            if table.sn_stress is not None:
                require_rainflow()
            loads = {
                load_name: load
                for load_name, load in scene.load.items()
                if (load.body or mechanism.slider) == name
            }
            radii = {n: getattr(joint, "radius", None) for n, joint in scene.joints.items()}
            body = mechanism.body(name)
            parts[name] = _place_part(mechanism, body, table, loads, radii, quiet)
    return parts


def _place_part(
    mechanism: Mechanism,
    body: Body,
    table: Flexible,
    loads: Mapping[str, Load],
    radii: Mapping[str, float | None],
    quiet: bool,
) -> PlacedPart:
    """Return one body's part; a joint without clearance has no radius."""
    moving = [g for g in mechanism.guides if body.name in g.bodies and not g.is_rail]
    pins = [Joint(g.name, g.at, body.name, g.on) for g in moving if g.at and g.body == body.name]
    joints = [*mechanism.joints_of(body.name), *pins]
    is_driven = body.name == mechanism.crank
    named_faces = dict(table.faces)
    if table.matrices is not None:
        sets = [*(joint.name for joint in joints), GUIDE_FACE]
        named_faces = {**{name: (Face(name),) for name in sets}, **named_faces}
    elif not table.from_file:
        shipped_part(table.source)  # refuses an unknown name
        named_faces = {**faces_given(shipped_faces(table.source)), **named_faces}
    faces = {joint.name: named_faces.get(joint.name, (Face(),)) for joint in joints}
    _refuse_shared(faces)
    for pin in pins:
        if len(faces[pin.name]) > 1:
            raise InputError(f"faces.{pin.name}: holds several faces; allowed is one for a pin")
    drive = named_faces.get(DRIVE_FACE, ()) if is_driven else ()
    patches = {f"load {name}": load.face for name, load in loads.items() if load.face is not None}
    guide = mechanism.frame_guide(body.name)
    if guide is not None:
        patches = {GUIDE_FACE: named_faces.get(GUIDE_FACE, ()), **patches}
    held_along = {guide.name for guide in moving} - {pin.name for pin in pins}
    patches |= {f"guide {name}": named_faces[name] for name in sorted(held_along)}
    is_fitted = (
        table.origin is None
        and table.angle_deg is None
        and all(patches.values())
        and all(face.name for group in (*faces.values(), *patches.values()) for face in group)
    )
    origin, turn = table.origin or (0.0, 0.0), radians(table.angle_deg or 0.0)
    normal = (1.0, 0.0) if guide is None else _rotate(guide.normal, -turn)
    interfaces = {
        joint: tuple(face.name or point_name(joint, i) for i, face in enumerate(group))
        for joint, group in faces.items()
    }
    holding = [
        (joint, face, interface)
        for joint in joints
        for face, interface in zip(faces[joint.name], interfaces[joint.name], strict=True)
    ]
    if table.from_file:
        axes = {
            interface: Axis(
                position=_rotate((joint.at[0] - origin[0], joint.at[1] - origin[1]), -turn),
                sphere=joint.spherical,
                hole=joint.bearing == body.name,
                radius=face.radius,
                z=face.z,
            )
            for joint, face, interface in holding
            if not face.name
        }
        names = [interface for *_, interface in holding]
        solid, carriers = _part_from_file(table, axes, names, drive, patches, normal)
    else:
        solid, carriers = _shipped_part(table, {**faces, DRIVE_FACE: drive}, patches)
    reduction = Reduction(
        table.modes, table.method, flexibility_error=table.flexibility_error, loads=IN_THE_PLANE
    )
    with one_thread(), Progress(f"modes of {body.name}", 1.0, "", quiet=quiet) as progress:
        reduced = reduced_part(solid, reduction, report=lambda _, share: progress.update(share))
    if table.matrices is not None:
        _refuse_other_size(reduced, table.source, mechanism)
    axis_of = {interface: reduced.interface(interface).axis for *_, interface in holding}
    if is_fitted:
        pairs = [
            (joint.at, axis_of[name][:2]) for joint, face, name in holding if not face.eccentric
        ]
        origin, turn = _fit_origin(*map(np.array, zip(*pairs, strict=True)))
    for joint, face, interface in holding:
        x, y = _rotate((joint.at[0] - origin[0], joint.at[1] - origin[1]), -turn)
        distance = hypot(x - axis_of[interface][0], y - axis_of[interface][1])
        allowed, reason = NEAR, ""
        if table.matrices is not None:  # a set of nodes need not be all around the pin
            allowed = radii.get(joint.name) or reduced.interface(interface).arm
            reason = ", the radius of its pin" if radii.get(joint.name) else ", the set's own size"
        if distance > allowed and not face.eccentric:
            best = ", where it fits best" if is_fitted else ""
            raise InputError(
                f"{'face' if table.matrices is None else 'the centre of node set'} "
                f"{face.name or joint.name!r} of {table.source!r} lies "
                f"{1e3 * distance:.4g} mm from joints.{joint.name}, with origin = "
                f"[{origin[0]:.6g}, {origin[1]:.6g}], angle_deg = {degrees(turn):.6g}{best}; "
                f"allowed is {1e3 * allowed:.4g} mm{reason}"
            )
    for joint in joints:
        height = float(axis_of[interfaces[joint.name][0]][2])
        if joint.spherical and abs(height) > NEAR:
            raise InputError(
                f"the sphere of joints.{joint.name} has its centre at z = {height:.6g} m of "
                f"{table.source!r}; allowed is z = 0, the plane of the mechanism"
            )
    x, y = body.centre_of_mass
    placed = PlacedPart(
        reduced=reduced,
        centre=_rotate((x - origin[0], y - origin[1]), -turn),
        angle=body.angle - turn,
        faces=interfaces,
        drive=(drive[0].name if drive else interfaces[mechanism.shaft.name][0])
        if is_driven
        else "",
        guide="" if guide is None else carriers[GUIDE_FACE],
        carriers={pin.name: interfaces[pin.name][0] for pin in pins}
        | {name: carriers[f"guide {name}"] for name in held_along},
        loads={
            name: (carriers[f"load {name}"],) if load.joint is None else interfaces[load.joint]
            for name, load in loads.items()
        },
        middles={},
        damping_ratio=table.damping_ratio,
    )
    middles = {
        name: placed.to_body(reduced.interface(carriers[f"load {name}"]).centre)
        for name, load in loads.items()
        if load.joint is None and load.offset is None
    }
    return replace(placed, middles=middles)


def _refuse_other_size(reduced: ReducedPart, source: str, mechanism: Mechanism) -> None:
    """Refuse a body of nodes that is far from the mechanism's size, as by a wrong unit."""
    size = float(np.ptp(reduced.nodes, axis=0).max())
    low, high = (share * mechanism.size for share in SIZES)
    if not low <= size <= high:
        raise InputError(
            f"{source!r}: its nodes are up to {size:.3g} m apart, where the mechanism's joints are "
            f"up to {mechanism.size:.3g} m apart; allowed are {low:.3g} to {high:.3g} m: is "
            "units.length right?"
        )


def point_name(joint: str, number: int = 0) -> str:
    """Return the name of the point or interface where a joint holds one of its faces."""
    return joint if number == 0 else f"{joint} {number + 1}"


def _shipped_part(
    table: Flexible,
    faces: Mapping[str, tuple[Face, ...]],
    patches: Mapping[str, tuple[Face, ...]],
) -> tuple[Part, dict[str, str]]:
    """Return a shipped part in the scene's material, and patch -> the interface that carries it."""
    shipped = shipped_part(table.source, table.mesh_size or USUAL_MESH_SIZE)
    known = [interface.face for interface in shipped.interfaces]
    for name, group in {**faces, **patches}.items():
        wrong = [face.name for face in group if face.name not in known]
        if name in patches and len(group) != 1:
            wrong.append("")
        if wrong:
            unknown = f" {wrong[0]!r}" if wrong[0] else ""
            is_load = name in patches and name != GUIDE_FACE
            key = f"{name.replace(' ', '.')}.face" if is_load else f"faces.{name}"
            raise InputError(
                f"{table.source!r} has no face{unknown} for {name}; allowed as "
                f"{key} is one of {', '.join(map(repr, known))}"
            )
    material = _material(table, shipped.material)
    return shipped.replace(material=material), {
        name: group[0].name for name, group in patches.items()
    }


def _part_from_file(
    table: Flexible,
    axes: Mapping[str, Axis],
    names: list[str],
    drive: tuple[Face, ...],
    patches: Mapping[str, tuple[Face, ...]],
    normal: Point,
) -> tuple[Part | MatrixPart, dict[str, str]]:
    """Return the part of a STEP file or matrices, and patch -> the interface that carries it.

    Of the interfaces that joints hold those without a name in the file have their axes; the guide's
    normal is that in the solid's frame.
    """
    driven = [face.name for face in drive if face.name not in names]
    first: dict[tuple[Face, ...], str] = {}  # loads may share a patch
    carriers = {
        name: group[0].name if len(group) == 1 and group[0].name else first.setdefault(group, name)
        for name, group in patches.items()
    }
    further = [name for name in dict.fromkeys(carriers.values()) if name not in (*names, *driven)]
    interfaces = [Interface(name) for name in dict.fromkeys(names)]
    interfaces += [Interface(name, ("rz",)) for name in driven]
    interfaces += [Interface(name, IN_THE_PLANE) for name in further]
    limits: dict[str, Any] = {
        "time_limit": table.time_limit,
        "memory_limit": table.memory_limit_gb and 1e9 * table.memory_limit_gb,
    }
    limits = {name: limit for name, limit in limits.items() if limit is not None}
    if table.matrices is not None:
        if axes or any(len(group) != 1 or not group[0].name for group in patches.values()):
            raise InputError(
                f"faces on {table.source!r}: allowed is the name of a node set for each joint, "
                "guide and load, without radius or ranges"
            )
        return MatrixPart(table.path, tuple(interfaces), **limits), carriers
    solid = StepFile(
        table.path,
        MILLIMETRES,
        axes=axes,
        patches={
            name: tuple(map(_patch, group)) or Sides(normal)
            for name, group in patches.items()
            if carriers[name] == name
        },
        **limits,
    )
    material = _material(table, CRANK_STEEL)
    size = table.mesh_size or USUAL_MESH_SIZE
    return Part(solid.path.stem, solid, material, tuple(interfaces), size), carriers


def _patch(face: Face) -> Patch:
    if face.name:
        return Patch(face.name)
    low, high = zip(*(ends or (-inf, inf) for ends in face.ranges), strict=True)
    return Patch(box=(low, high))


def _material(table: Flexible, default: Material) -> Material:
    keys = ("youngs_modulus", "poissons_ratio", "density")
    values = {key: value for key in keys if (value := getattr(table, key)) is not None}
    return replace(default, **values)


def _refuse_shared(faces: Mapping[str, tuple[Face, ...]]) -> None:
    """Refuse a named face that two joints hold, or one joint twice."""
    holders: dict[str, str] = {}
    for joint, group in faces.items():
        for face in group:
            if not face.name or face.eccentric:
                continue
            if face.name in holders:
                raise InputError(
                    f"joints.{holders[face.name]} and joints.{joint} hold the same face "
                    f"{face.name!r}; allowed are different ones"
                )
            holders[face.name] = joint


def _fit_origin(joints: Array, axes: Array) -> tuple[Point, float]:
    """Return origin and angle (rad) of a solid whose axes (n, 2) fit best to joints (n, 2)."""
    from_mean, axes_from_mean = joints - joints.mean(axis=0), axes - axes.mean(axis=0)
    cross = axes_from_mean[:, 0] * from_mean[:, 1] - axes_from_mean[:, 1] * from_mean[:, 0]
    turn = atan2(cross.sum(), (axes_from_mean * from_mean).sum())
    x, y = _rotate(axes.mean(axis=0), turn)
    mean = joints.mean(axis=0)
    return (float(mean[0] - x), float(mean[1] - y)), turn


def _rotate(vector: Any, angle: float) -> Point:
    c, s = cos(angle), sin(angle)
    return float(c * vector[0] - s * vector[1]), float(s * vector[0] + c * vector[1])


def _rotate_frame(motion: Motion, angle: float) -> Motion:
    """Return the motion of a frame at a constant angle, rad, from another one."""
    return replace(motion, position=motion.position + np.array([0.0, 0.0, angle]))
