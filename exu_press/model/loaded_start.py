"""The start of a mechanism with clearance: journals lie where the loads of the motion press them.

Journals that start in the middle of their bearings at full speed fall on them, and the first peaks
are those of this fall. Here each joint has the force of the ideal motion, from inertia, weight and
loads, and lies where its contact or its film bears this force. The bodies follow from the joints.
A journal in a film begins at rest in its bearing: how it moves on follows from the time before.
One in contact moves along the surface, as the force turns. Its penetration begins at rest: a strong
damper would turn its rate into a force many times the one that it bears.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from exu_press.joints.interface import DryInterface, InterfaceLaw
from exu_press.joints.joint import SHALLOW
from exu_press.mechanism import GROUND, Motion
from exu_press.mechanism.planar_constraints import INDEPENDENT, null_space
from exu_press.model.clearance_joints import interfaces_of
from exu_press.model.system import System
from exu_press.numerics.arrays import Array
from exu_press.scene import DryJoint, IdealJoint, LubricatedJoint
from exu_press.scene.joint import unworn

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart

__all__ = ["loaded_start", "moved_start"]

ANGLES = 1e-4 * np.array([-1.0, 0.0, 1.0])
"""rad of the crank about the start: the journals' velocities are the slope there. Over 1e-3 rad the
slope is off by some 0.1 um/s, which a thin film of 1e10 N s/m turns into kilonewtons."""

THICKEST = 0.98
"""Eccentricity ratio up to which a film is taken to bear its load without squeezing."""

SHARPEST = 5.0
"""Part of itself that a joint's force may change by in a radian of the crank: where a journal is
changing sides it rests nowhere."""


def moved_start(
    system: System, start: Mapping[str, Motion], frames: Mapping[str, "FrameStart"]
) -> tuple[dict[str, Motion], dict[str, "FrameStart"]]:
    """Return a start from that of ideal joints, every body moved as its joints ask for.

    Args:
        system: with nothing but the frame in it.
        start: name -> motion of bodies at the start, where it is not the ideal mechanism's.
        frames: name -> start of the frame of a flexible body that starts deformed.
    """
    moved, bent = {**start, **loaded_start(system)}, {}
    for name in system.ideal.keys() & {*start, *frames}:  # deformed, or beside such a body
        ideal, loaded = system.ideal[name], moved[name]
        away = Motion(
            loaded.position - ideal.position,
            loaded.velocity - ideal.velocity,
            np.zeros_like(ideal.position),
        )
        if name in frames:
            from exu_press.model.flexible_body import shifted

            bent[name] = shifted(frames[name], ideal, away)
        else:
            before = start[name]
            moved[name] = replace(
                before,
                position=before.position + away.position,
                velocity=before.velocity + away.velocity,
            )
    return moved, {**frames, **bent}


def loaded_start(system: System) -> dict[str, Motion]:
    """Return the motion of every body at the start, one instant.

    Joints and guides without clearance are held, and so is the crank's angle. A joint without a
    place where it could bear its force starts as if nothing pressed it: one that changes sides, or
    a film whose journal hardly turns.

    Args:
        system: with nothing but the frame in it.
    """
    problem = _Problem(system)
    instants = [_Instant(problem, i) for i in range(len(ANGLES))]
    middle = len(ANGLES) // 2
    forces = np.array([instant.forces for instant in instants])
    sizes, changes = np.abs(forces[middle]), np.abs(forces[-1] - forces[0])
    pressed = changes < SHARPEST * (ANGLES[-1] - ANGLES[0]) * sizes
    wanted = np.array([instant.eccentricities(pressed) for instant in instants])
    pressed &= np.isfinite(wanted).all(axis=(0, 2))
    wanted[:, ~pressed] = 0.0
    wanted[:, problem.films] = wanted[middle, problem.films]  # a film resists any change
    depths = np.linalg.norm(wanted, axis=2, keepdims=True)  # a contact may, of its penetration
    wanted *= np.divide(depths[middle], depths, out=np.ones_like(depths), where=depths > 0.0)
    wanted = np.array(
        [instant.on_worn(e, pressed) for instant, e in zip(instants, wanted, strict=True)]
    )
    wanted[:, problem.films] = wanted[middle, problem.films]
    poses = np.array(
        [instant.moved(e.ravel()) for instant, e in zip(instants, wanted, strict=True)]
    )
    speed = system.scene.start_speed
    rates = np.zeros_like(poses[middle])
    if speed > 0.0:
        rates = (poses[-1] - poses[0]) / ((ANGLES[-1] - ANGLES[0]) / speed)
    velocity = problem.on_constraints(poses[middle], rates)
    position, velocity = poses[middle] * problem.scale, velocity * problem.scale
    return {
        name: Motion(
            position[None, 3 * i : 3 * i + 3],
            velocity[None, 3 * i : 3 * i + 3],
            problem.ideal[name].acceleration[middle : middle + 1],
        )
        for i, name in enumerate(problem.constraints.bodies)
    }


class _Problem:
    """A mechanism's constraints and loads over the angles about its start.

    Attributes:
        system: whose start is wanted.
        constraints: of all joints and guides, in coordinates relative to the mechanism's size.
        scale: units of all coordinates, m and rad.
        loose: joints with clearance.
        films: (m,), which of these have one.
        ideal: name -> ideal motion at the angles.
        ideal_q: its coordinates, (k, n).
    """

    def __init__(self, system: System) -> None:
        """Take the ideal motion."""
        scene, self.mechanism = system.scene, system.mechanism
        self.system, self.constraints = system, self.mechanism.constraints
        size = self.constraints.size
        self.scale = np.tile([size, size, 1.0], len(self.constraints.bodies))
        self.loose = [j for j in self.mechanism.joints if j.name not in scene.joints.ideal]
        self.films = np.array(
            [scene.joints[joint.name].kind == "lubricated" for joint in self.loose]
        )
        rows = self.constraints.rows
        self._loose_rows = np.concatenate([rows[f"joints.{joint.name}"] for joint in self.loose])
        self._crank = self.constraints.angle_row(self.mechanism.crank)
        self.angles = scene.start_angle + ANGLES
        self.ideal = self.mechanism.motion(self.angles, scene.start_speed)
        self.ideal_q = self.constraints.coordinates(self.ideal)

    def gaps(self, q: Array) -> tuple[Array, Array]:
        """Return journal - bearing of the loose joints, (2 m,), and the Jacobian, (2 m, n)."""
        residuals, rows = self.constraints.residuals(q), self.constraints.jacobian(q)
        return residuals[self._loose_rows], rows[self._loose_rows]

    def held(self, q: Array, ideal: Array) -> tuple[Array, Array]:
        """Return the residuals of ideal joints, guides and drive at q, and their Jacobian."""
        residuals, rows = (
            np.delete(values, self._loose_rows, axis=0)
            for values in (self.constraints.residuals(q), self.constraints.jacobian(q))
        )
        return np.append(residuals, self._crank @ (q - ideal)), np.vstack([rows, self._crank])

    def on_constraints(self, q: Array, q_t: Array) -> Array:
        """Return velocities that the constraints allow, next to the given ones."""
        rows = self.held(q, q)[1]
        wanted = np.zeros(len(rows))
        wanted[-1] = self.system.scene.start_speed
        return np.asarray(q_t + correction(rows, rows @ q_t - wanted))

    def pressing(self, i: int) -> Array:
        """Return the forces (n,), N m, that joints have to exert on coordinates at one angle."""
        scene, speed = self.system.scene, self.system.scene.start_speed
        crank = self.angles, np.full(len(ANGLES), speed)
        slider = self.ideal[self.mechanism.slider]
        height = self.mechanism.output_position(slider.position) - self.mechanism.bottom
        velocity = self.mechanism.output_component(slider.velocity)
        found = np.zeros(len(self.scale))
        for k, body in enumerate(self.mechanism.bodies):
            moving, mass, inertia = self.ideal[body.name], body.mass, body.inertia
            arm = np.zeros(2)
            if body.name in self.system.parts:  # of the solid, not of its drawing
                part = self.system.parts[body.name]
                mass, inertia, centre = part.reduced.mass, part.inertia, part.centre_of_mass
                moving = moving.point_motion(centre)
                arm = moving.position[i, :2] - self.ideal[body.name].position[i, :2]
            a = moving.acceleration[i]
            fx, fy = mass * a[0], mass * (a[1] + scene.gravity)
            found[3 * k : 3 * k + 3] = fx, fy, inertia * a[2] + arm[0] * fy - arm[1] * fx
        for load in self.system.loads.values():
            k = 3 * self.constraints.bodies.index(load.body)
            size = load.force(ANGLES / (speed or math.inf), crank, (height, velocity))
            angle = self.ideal[load.body].position[:, 2]
            found[k : k + 2] -= size[i] * np.array(load.direction)
            found[k + 2] -= load.moment(size, angle)[i]
        return np.asarray(found * self.scale)


def correction(rows: Array, residuals: Array) -> Array:
    """Return the smallest change of the coordinates that satisfies constraints."""
    return np.asarray(np.linalg.lstsq(rows, -residuals, rcond=INDEPENDENT)[0])


class _Instant:
    """One of the angles.

    Attributes:
        ideal: coordinates (n,) of the ideal motion.
        forces: on the journals of the loose joints, x + iy, N.
    """

    def __init__(self, problem: _Problem, i: int) -> None:
        """Find the loads on the joints; several that bear one load share it evenly."""
        self._problem, self.ideal = problem, problem.ideal_q[i]
        self._omega = {n: m.velocity[i, 2] for n, m in problem.ideal.items()} | {GROUND: 0.0}
        self._angle = {n: m.position[i, 2] for n, m in problem.ideal.items()} | {GROUND: 0.0}
        self._free = null_space(problem.held(self.ideal, self.ideal)[1]).T
        self._reach = problem.gaps(self.ideal)[1] @ self._free
        pressing = self._free.T @ problem.pressing(i)
        forces = np.linalg.lstsq(self._reach.T, pressing, rcond=INDEPENDENT)[0]
        forces = forces / problem.constraints.size
        self.forces = forces[0::2] + 1j * forces[1::2]

    def eccentricities(self, pressed: Array) -> Array:
        """Return where the pressed loose joints bear their forces, (m, 2), m; NaN: nowhere."""
        found = np.zeros((len(pressed), 2))
        joints, scene = self._problem.loose, self._problem.system.scene.joints
        for k in np.flatnonzero(pressed):
            kind = scene[joints[k].name]
            assert not isinstance(kind, IdealJoint)
            turning = self._omega[joints[k].journal], self._omega[joints[k].bearing]
            interfaces = interfaces_of(joints[k], kind, self._problem.system.scene)
            e = _borne(interfaces, complex(self.forces[k]), *turning)
            found[k] = (math.nan, math.nan) if e is None else (e.real, e.imag)
        return found

    def on_worn(self, wanted: Array, pressed: Array) -> Array:
        """Return eccentricities (m, 2) in round bearings where worn surfaces bear them instead.

        A contact lies on the surface worn there, with the same normal; a film has as thin a gap,
        over its clearance.
        """
        found, problem = np.array(wanted), self._problem
        for k in np.flatnonzero(pressed):
            joint, kind = problem.loose[k], problem.system.scene.joints[problem.loose[k].name]
            if not isinstance(kind, DryJoint | LubricatedJoint) or kind.worn is None:
                continue
            profiles, size = kind.worn.profiles(), float(np.linalg.norm(wanted[k]))
            if profiles is None or size == 0.0:
                continue
            n = wanted[k] / size
            angle, depth, slope = math.atan2(n[1], n[0]), 0.0, 0.0
            for body, shape in zip((joint.journal, joint.bearing), profiles, strict=True):
                worn, change, _ = shape.derivatives(angle - self._angle[body])
                depth, slope = depth + worn, slope + change
            clearance = unworn(kind).clearance
            if kind.onset is not None and size > clearance - kind.onset:
                found[k] = (size + depth) * n + slope * np.array([-n[1], n[0]])
            else:
                found[k] = (1.0 + depth / clearance) * wanted[k]
        return found

    def moved(self, wanted: Array) -> Array:
        """Return the coordinates (n,) with eccentricities (2 m,), m, as far as possible."""
        problem, q = self._problem, self.ideal
        inverse = np.linalg.pinv(self._reach, rcond=INDEPENDENT)
        wanted = self._reach @ (inverse @ wanted) / problem.constraints.size
        for _ in range(3):
            q = q + self._free @ (inverse @ (wanted - problem.gaps(q)[0]))
            residuals, rows = problem.held(q, self.ideal)
            q = q + correction(rows, residuals)
        return np.asarray(q)


def _borne(
    interfaces: list[InterfaceLaw], force: complex, omega_j: float, omega_b: float
) -> complex | None:
    """Return the eccentricity at which surfaces exert a force on a journal at rest, or None."""

    def exerted(e: float) -> complex:
        """Return the force along the eccentricity and a quarter turn from it, at rest there."""
        loads = [interface.load(e, 0.0, 0.0, omega_j, omega_b) for interface in interfaces]
        return sum((complex(f[0], f[1]) for f in loads if f is not None), 0j)

    size = _bearing_eccentricity(exerted, interfaces, abs(force))
    if size is None:
        return None
    along = force / exerted(size)
    return size * along / abs(along)


def _bearing_eccentricity(
    exerted: Callable[[float], complex], interfaces: list[InterfaceLaw], wanted: float
) -> float | None:
    """Return the size of the eccentricity at which a force of a wanted size is exerted, or None."""
    dry = [interface for interface in interfaces if isinstance(interface, DryInterface)]
    low, high = 0.0, THICKEST * interfaces[0].clearance
    if dry:
        high = dry[0].clearance + SHALLOW * dry[0].radius
        low = dry[0].clearance if len(dry) == len(interfaces) else 0.0
    if not abs(exerted(low)) < wanted <= abs(exerted(high)):
        return None
    while low < (middle := 0.5 * (low + high)) < high:  # a penetration may be its last digits
        if abs(exerted(middle)) < wanted:
            low = middle
        else:
            high = middle
    return high
