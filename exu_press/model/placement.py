"""Placing of flexible bodies: their solids in the mechanism, and the faces that are held.

Named faces are fitted to the joints' positions in the drawing; other faces are searched at the
joints' positions. Faces of guides and loads are named or lie in boxes; by default a guide holds the
solid's sides.
"""

from collections.abc import Mapping
from dataclasses import replace
from importlib.util import find_spec
from math import atan2, degrees, hypot, radians

import numpy as np

from exu_press.errors import InputError, error_prefix
from exu_press.mechanism import Body, Joint, Mechanism, Point
from exu_press.model.placed_part import PlacedPart, point_name, rotate
from exu_press.model.solids import IN_THE_PLANE, part_from_file, part_of_shipped
from exu_press.numerics.arrays import Array
from exu_press.numerics.threads import one_thread
from exu_press.scene import Face, Flexible, Scene, mechanism_of
from exu_press.scene.bodies import DRIVE_FACE, GUIDE_FACE, faces_given, require_rainflow
from exu_press.scene.load import Load
from exu_press.terminal.progress import Progress
from fe_models import Axis, ReducedPart, Reduction, reduced_part, shipped_faces, shipped_part

__all__ = ["placed_parts"]

NEAR = 1e-4
"""m: largest distance of a face's axis from its joint; drawings are rounded to tenths of a mm."""

SIZES = 0.005, 10.0
"""Sizes of a body of nodes over the mechanism's: wrong units are off by 25 at least."""


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
    normal = (1.0, 0.0) if guide is None else rotate(guide.normal, -turn)
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
                position=rotate((joint.at[0] - origin[0], joint.at[1] - origin[1]), -turn),
                sphere=joint.spherical,
                hole=joint.bearing == body.name,
                radius=face.radius,
                z=face.z,
            )
            for joint, face, interface in holding
            if not face.name
        }
        names = [interface for *_, interface in holding]
        solid, carriers = part_from_file(table, axes, names, drive, patches, normal)
    else:
        solid, carriers = part_of_shipped(table, {**faces, DRIVE_FACE: drive}, patches)
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
        x, y = rotate((joint.at[0] - origin[0], joint.at[1] - origin[1]), -turn)
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
        centre=rotate((x - origin[0], y - origin[1]), -turn),
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
    x, y = rotate(axes.mean(axis=0), turn)
    mean = joints.mean(axis=0)
    return (float(mean[0] - x), float(mean[1] - y)), turn
