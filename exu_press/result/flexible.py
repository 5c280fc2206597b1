"""Channels of flexible bodies: deformation and energy."""

from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import Joint, Motion, Point
from exu_press.numerics.arrays import Array, lengths
from exu_press.result.channel import Channel, Declaration, Declarations
from exu_press.result.energy import work
from exu_press.result.info import Solid
from exu_press.result.motion import (
    frame_motion,
    moving_point,
    point_motion,
    sensor,
    turned_vectors,
)
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.model import Model
    from exu_press.model.placed_part import PlacedPart
    from fe_models import ReducedPart

__all__ = ["CHANNELS", "carried_motion", "deflection", "guided_motion", "modal", "record"]

CHANNELS = Declarations(
    Declaration("{body}_strain_energy", "J", "{body}: elastic energy", always=False),
    Declaration(
        "{body}_modes_loss",
        "J",
        "{body}: energy dissipated by the damping of modes since the start",
        always=False,
    ),
    Declaration("{body}_modes", "kg^0.5 m", "{body}: modal coordinates", "{body}_mode", False),
    Declaration("{body}_elongation", "m", "{body}: joints further apart", always=False),
    Declaration("{body}_bending", "rad", "{body}: joints turned apart", always=False),
    Declaration(
        "{pivoted}_deflection", "m", "{pivoted}: displacement from a rigid body", "plane", False
    ),
    Declaration(
        "{bent}_slope",
        "rad",
        "{bent}: where the journal's axis leans in its bearing",
        "plane",
        False,
    ),
)


def record(run: Recording) -> Record:
    """Return the channels of the flexible bodies, their stored and their dissipated energy.

    Modes are orthogonal to rigid motions, so that kinetic energy is that of the undeformed body
    plus half of every modal velocity's square and deformation's part of the moment of inertia,
    to the square of deformation over length.
    """
    model, time = run.model, run.time
    channels: dict[str, Channel] = {}
    stored, dissipated = np.zeros_like(time), np.zeros_like(time)
    for name, placed in model.parts.items():
        reduced = placed.reduced
        motion = frame_motion(model, name)
        position, velocity = motion.position, motion.velocity
        q, q_t = modal(model, name, reduced, len(time))
        strain = 0.5 * (q**2) @ np.diag(reduced.stiffness_matrix)
        stored += _rigid_energy(model, name, reduced)
        stored += 0.5 * (q_t**2).sum(axis=1) + strain
        stored += 0.5 * velocity[:, 2] ** 2 * (q @ _inertia_of_modes(reduced))
        damping = np.diag(reduced.damping_matrix(placed.damping_ratio))
        loss = work(time, q_t * damping, q_t)
        dissipated += loss
        channels |= CHANNELS.record(name, strain_energy=strain)
        if reduced.mode_count:
            channels |= CHANNELS.record(name, modes_loss=loss, modes=q)
        pivot = next((j.name for j in model.mechanism.joints_of(name) if j.on_frame), None)
        if pivot is not None:
            for joint in placed.faces:
                if placed.faces[joint][0] not in placed.faces[pivot]:
                    displacement = q @ deflection(placed, joint, pivot).T
                    rotated = _rotate(displacement, position[:, 2])
                    label = f"{joint} on the {name}".replace("_", " ")
                    channels |= CHANNELS.record(joint, label=label, deflection=rotated)
        elif len(placed.faces) == 2:
            channels |= _relative_motion(placed, name, q)
    for held in model.mechanism.joints:
        if not held.spherical and {held.journal, held.bearing} & model.parts.keys():
            channels |= CHANNELS.record(held.name, slope=_slope(model, held, len(time)))
    solids = {name: _solid(placed) for name, placed in model.parts.items()}
    return Record(channels, stored, dissipated, info={"solids": solids})


def _solid(placed: "PlacedPart") -> Solid:
    """Return the mass properties of a body's solid."""
    return {
        "mass": placed.reduced.mass,
        "centre_of_mass": [*placed.centre_of_mass],
        "inertia": placed.inertia,
        "modes": placed.reduced.mode_count,
        "frequencies": placed.reduced.fixed_interface_frequencies.tolist(),
    }


def _relative_motion(placed: "PlacedPart", name: str, q: Array) -> dict[str, Channel]:
    """Return elongation and bending between the two joints of a body."""
    first, second = (placed.reduced.interface(faces[0]) for faces in placed.faces.values())
    along = (second.axis - first.axis)[:2]
    along = along / np.linalg.norm(along)
    elongation = along @ (second.translation - first.translation)[:2]
    bending = (second.rotation - first.rotation)[2]
    return CHANNELS.record(name, elongation=q @ elongation, bending=q @ bending)


def _slope(model: "Model", joint: Joint, count: int) -> Array:
    """Return where the axis of a journal leans in its bearing, (n, 2), rad, in the drawing's axes.

    By the mean rotation of the faces; of several the one that leans most.
    """
    journal, bearing = (_axes(model, body, joint, count) for body in (joint.journal, joint.bearing))
    pairs = max(len(journal), len(bearing))
    slopes = [journal[k % len(journal)] - bearing[k % len(bearing)] for k in range(pairs)]
    return max(slopes, key=lambda slope: float(lengths(slope).max()))


def _axes(model: "Model", body: str, joint: Joint, count: int) -> list[Array]:
    """Return x and y of the axis of each face by which a body holds a joint, (n, 2)."""
    if body not in model.parts:
        return [np.zeros((count, 2))]
    placed = model.parts[body]
    q, _ = modal(model, body, placed.reduced, count)
    axes = []
    for face in placed.faces[joint.name]:
        rotation = q @ placed.reduced.interface(face).rotation.T
        axis = np.column_stack([rotation[:, 1], -rotation[:, 0], np.ones(count)])
        axes.append(turned_vectors(model, body, axis)[:, :2])
    return axes


def deflection(placed: "PlacedPart", joint: str, pivot: str) -> Array:
    """Return the displacement of a joint by each mode, against the body's pivot, (2, modes).

    In the solid's frame, relative to a rigid body that follows the line between the pivot's faces
    and rotates with the driven face, or else with the pivot. The mean-axis frame itself moves with
    the modes: relative to it, a force across the press's throw bends it by 14 % less, one along it
    by 5 % more.
    """
    reduced = placed.reduced
    driven = reduced.interface(placed.faces[joint][0])
    rests = [reduced.interface(face) for face in placed.faces[pivot]]
    height, heights = float(driven.centre[2]), [float(rest.centre[2]) for rest in rests]
    part_way = 0.0 if len(rests) == 1 else (height - heights[0]) / (heights[1] - heights[0])
    line = (1.0 - part_way) * rests[0].translation + part_way * rests[-1].translation
    axis = reduced.interface(placed.drive or placed.faces[pivot][0]).rotation.T * (0.0, 0.0, 1.0)
    rotated = np.cross(axis, driven.axis - rests[0].axis).T
    return np.asarray((driven.translation - line - rotated)[:2])


def carried_motion(
    model: "Model", name: str, faces: tuple[str, ...], point: Point
) -> tuple[Array, Array]:
    """Return position, m, and velocity, m/s, (n, 3) each, of a point that faces carry.

    Args:
        model: integrated.
        name: of the flexible body.
        faces: interfaces, whose mean motion carries the point.
        point: in the undeformed body's frame, m.
    """
    placed, count = model.parts[name], len(sensor(model, name, "position"))
    position, modes = placed.carried_point(faces, point)
    q, q_t = modal(model, name, placed.reduced, count)
    return moving_point(model, name, position + q @ modes.T, q_t @ modes.T)


def guided_motion(model: "Model", name: str) -> Motion:
    """Return the mean motion of the faces of a body that lie in its guide, (x, y, angle).

    Where the body has its centre of mass; accelerations are left out.
    """
    placed = model.parts[name]
    frame = frame_motion(model, name)
    q, q_t = modal(model, name, placed.reduced, len(frame.position))
    turn = placed.reduced.interface(placed.guide).rotation[2]
    position_of_guide, rate = carried_motion(model, name, (placed.guide,), (0.0, 0.0))
    angle = frame.position[:, 2] + placed.angle + q @ turn
    omega = frame.velocity[:, 2] + q_t @ turn
    position, velocity = (
        np.column_stack([vector[:, :2], angular])
        for vector, angular in ((position_of_guide, angle), (rate, omega))
    )
    return Motion(position, velocity, np.zeros_like(position))


def modal(model: "Model", name: str, reduced: "ReducedPart", count: int) -> tuple[Array, Array]:
    """Return modal coordinates and their rates, (n, modes)."""
    if reduced.mode_count == 0:
        return np.zeros((count, 0)), np.zeros((count, 0))
    return sensor(model, f"{name}_modes", "position"), sensor(model, f"{name}_modes", "velocity")


def _inertia_of_modes(reduced: "ReducedPart") -> Array:
    """Return the change of the moment of inertia about z by each mode, (modes,).

    It is twice the integral of x u_x + y u_y over the mass.
    """
    products = reduced.couplings["mXRefTildePsiTilde"][2, 2::3]
    return np.asarray(2.0 * products)


def _rigid_energy(model: "Model", name: str, reduced: "ReducedPart") -> Array:
    """Return kinetic and potential energy of the undeformed body, (n,), J.

    In space, as the frame of a bending crank shaft tilts at sudden forces.
    """
    height, velocity, omega = point_motion(model, name, reduced.centre_of_mass)
    c = reduced.centre_of_mass
    about_centre = reduced.inertia - reduced.mass * (c @ c * np.eye(3) - np.outer(c, c))
    kinetic = 0.5 * reduced.mass * (velocity**2).sum(axis=1)
    kinetic += 0.5 * ((omega @ about_centre) * omega).sum(axis=1)
    return np.asarray(kinetic + reduced.mass * model.scene.gravity * height)


def _rotate(vectors: Array, angle: Array) -> Array:
    """Return the x and y of vectors (n, 2 or 3) of a body turned by angles (n,)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors[:, 0], vectors[:, 1]
    return np.column_stack([c * x - s * y, s * x + c * y])
