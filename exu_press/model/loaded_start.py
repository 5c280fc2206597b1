"""The loaded start of a mechanism with clearance: journals in equilibrium with the ideal motion.

Journals that start in the centre of their bearings at full speed fall on them, and the first peaks
come from this fall. Here each joint has the force of the ideal motion, from inertia, weight and
loads, and the eccentricity at which its contact or film bears this force. The bodies' positions
follow from the joints. A journal in a film starts at rest in its bearing, as its velocity depends
on its history. One in contact moves along the surface, as the force turns, with a constant
penetration: a strong damper would turn its rate into a force many times the one that it bears.
"""

import cmath
import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from exu_press.joints.interface import DryInterface, InterfaceLaw
from exu_press.joints.joint import SHALLOW
from exu_press.mechanism import GROUND, Motion
from exu_press.mechanism.planar_constraints import INDEPENDENT, null_space
from exu_press.mechanism.spring_motion import spring_ends, spring_motion
from exu_press.model.clearance_joints import interfaces_of
from exu_press.model.system import System
from exu_press.numerics.arrays import Array
from exu_press.scene import DryJoint, IdealJoint, LubricatedJoint
from exu_press.scene.joint import unworn

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart

__all__ = ["loaded_start", "moved_start"]

ANGLES = 1e-4 * np.array([-1.0, 0.0, 1.0])
"""Crank angles from the start, rad; the journals' velocities are differences over them. Over 1e-3
rad these are off by some 0.1 um/s, which a thin film of 1e10 N s/m turns into kilonewtons."""

ORIENTATIONS = 10
"""Iterations for the angle of a journal in a bearing with grooves."""

LARGEST_RATIO = 0.98
"""Largest eccentricity ratio at which a film may bear its load without squeezing."""

MISFIT = 0.01
"""Distance over the clearance at which the other joints and guides keep a journal from its place:
the curvature of a path takes some 1e-3."""

LARGEST_CHANGE = 5.0
"""Largest relative change of a joint's force per radian of the crank: a journal that is changing
sides has no equilibrium."""


def moved_start(
    system: System, start: Mapping[str, Motion], frames: Mapping[str, "FrameStart"]
) -> tuple[dict[str, Motion], dict[str, "FrameStart"]]:
    """Return the start of ideal joints with every body moved into the loaded start.

    Of flexible bodies that start deformed the frames are moved.
    """
    moved, moved_frames = {**start, **loaded_start(system)}, {}
    owners = {carrier: body for (_, body), carrier in system.carriers.items()}
    for name in {*start, *frames}:  # deformed, or connected to such a body
        owner = owners.get(name, name)
        if owner not in system.ideal:
            continue
        ideal, loaded = system.ideal[owner], moved[owner]
        change = Motion(
            loaded.position - ideal.position,
            loaded.velocity - ideal.velocity,
            np.zeros_like(ideal.position),
        )
        if name in frames:
            from exu_press.model.flexible_body import shift_start

            moved_frames[name] = shift_start(frames[name], ideal, change)
        else:
            unmoved = start[name]
            moved[name] = replace(
                unmoved,
                position=unmoved.position + change.position,
                velocity=unmoved.velocity + change.velocity,
            )
    return moved, {**frames, **moved_frames}


def loaded_start(system: System) -> dict[str, Motion]:
    """Return the motion of every body at the start, one instant.

    Ideal joints and guides are satisfied, and the crank's angle is kept. A joint without an
    equilibrium position starts centred: one that changes sides, a film whose journal hardly turns,
    or one that other joints and guides keep from it.

    Args:
        system: with nothing but the frame in it.
    """
    problem = _Problem(system)
    instants = [_Instant(problem, i) for i in range(len(ANGLES))]
    middle = len(ANGLES) // 2
    forces = np.array([instant.forces for instant in instants])
    sizes, changes = np.abs(forces[middle]), np.abs(forces[-1] - forces[0])
    in_equilibrium = changes < LARGEST_CHANGE * (ANGLES[-1] - ANGLES[0]) * sizes
    e = np.array([instant.eccentricities(in_equilibrium) for instant in instants])
    in_equilibrium &= np.isfinite(e).all(axis=(0, 2))
    e[:, ~in_equilibrium] = 0.0
    e[:, problem.films] = e[middle, problem.films]  # a film resists any change
    ratios = np.linalg.norm(e, axis=2, keepdims=True)  # a contact any of its penetration
    e *= np.divide(ratios[middle], ratios, out=np.ones_like(ratios), where=ratios > 0.0)
    for i, instant in enumerate(instants):
        e[i] = instant.add_wear(e[i], in_equilibrium)
    e[:, problem.films] = e[middle, problem.films]
    poses = _reached_poses(problem, instants, e)
    speed = system.scene.start_speed
    rates = np.zeros_like(poses[middle])
    if speed > 0.0:
        rates = (poses[-1] - poses[0]) / ((ANGLES[-1] - ANGLES[0]) / speed)
    velocity = problem.project_velocities(poses[middle], rates)
    position, velocity = poses[middle] * problem.scale, velocity * problem.scale
    return {
        name: Motion(
            position[None, 3 * i : 3 * i + 3],
            velocity[None, 3 * i : 3 * i + 3],
            problem.ideal[name].acceleration[middle : middle + 1],
        )
        for i, name in enumerate(problem.constraints.bodies)
    }


def _reached_poses(problem: "_Problem", instants: list["_Instant"], e: Array) -> Array:
    """Return the coordinates (k, n) with the eccentricities e, (k, m, 2), m, at all instants.

    Journals whose place the other joints and guides do not allow are moved to the centre in e:
    where one can move along a line alone, or several share fewer motions, constraints bear a part.
    """
    middle, size = len(instants) // 2, problem.constraints.size
    while True:
        poses = np.array([instant.positions(e[i].ravel()) for i, instant in enumerate(instants)])
        reached = size * problem.gaps(poses[middle])[0].reshape(-1, 2)
        misses = np.linalg.norm(reached - e[middle], axis=1) > MISFIT * problem.clearances
        misses &= e[middle].any(axis=1)
        if not misses.any():
            return poses
        e[:, misses] = 0.0


class _Problem:
    """A mechanism's constraints and loads over the angles about its start.

    Attributes:
        scale: units of all coordinates, m and rad.
        clearances: (m,), of the clearance joints, m.
        films: (m,), which of them have a film.
        ideal: name -> ideal motion at the angles.
        ideal_q: its coordinates, (k, n), relative to the mechanism's size.
    """

    def __init__(self, system: System) -> None:
        """Compute the ideal motion."""
        scene, self.mechanism = system.scene, system.mechanism
        self.system, self.constraints = system, self.mechanism.constraints
        size = self.constraints.size
        self.scale = np.tile([size, size, 1.0], len(self.constraints.bodies))
        joints = [j for j in self.mechanism.joints if j.name not in scene.joints.ideal]
        self.clearance_joints = joints
        kinds = [scene.joints[joint.name] for joint in joints]
        self.clearances = np.array([kind.clearance for kind in kinds])
        self.films = np.array([kind.kind == "lubricated" for kind in kinds])
        rows = self.constraints.rows
        self._clearance_rows = np.concatenate([rows[f"joints.{joint.name}"] for joint in joints])
        self._crank = self.constraints.angle_row(self.mechanism.crank)
        self.angles = scene.start_angle + ANGLES
        self.ideal = self.mechanism.motion(self.angles, scene.start_speed)
        self.ideal_q = self.constraints.coordinates(self.ideal)

    def gaps(self, q: Array) -> tuple[Array, Array]:
        """Return journal minus bearing of clearance joints, (2 m,), and the Jacobian, (2 m, n)."""
        residuals, rows = self.constraints.residuals(q), self.constraints.jacobian(q)
        return residuals[self._clearance_rows], rows[self._clearance_rows]

    def constrain(self, q: Array, ideal: Array) -> tuple[Array, Array]:
        """Return the residuals of ideal joints, guides and drive at q, and their Jacobian."""
        residuals, rows = (
            np.delete(values, self._clearance_rows, axis=0)
            for values in (self.constraints.residuals(q), self.constraints.jacobian(q))
        )
        return np.append(residuals, self._crank @ (q - ideal)), np.vstack([rows, self._crank])

    def project_velocities(self, q: Array, q_t: Array) -> Array:
        """Return the velocities closest to q_t that satisfy the constraints."""
        rows = self.constrain(q, q)[1]
        rates = np.zeros(len(rows))
        rates[-1] = self.system.scene.start_speed
        return np.asarray(q_t + correction(rows, rows @ q_t - rates))

    def joint_forces(self, i: int) -> Array:
        """Return the generalized forces (n,), N m, of all joints at one of the angles."""
        scene, speed = self.system.scene, self.system.scene.start_speed
        crank = self.angles, np.full(len(ANGLES), speed)
        slider = self.ideal[self.mechanism.slider]
        height = self.mechanism.output_position(slider.position) - self.mechanism.bottom
        velocity = self.mechanism.output_component(slider.velocity)
        forces = np.zeros(len(self.scale))
        for k, body in enumerate(self.mechanism.bodies):
            moving, mass, inertia = self.ideal[body.name], body.mass, body.inertia
            arm = np.zeros(2)
            if body.name in self.system.parts:  # of the solid, not of its drawing
                placed = self.system.parts[body.name]
                mass, inertia = placed.reduced.mass, placed.inertia
                moving = moving.point_motion(placed.centre_of_mass)
                arm = moving.position[i, :2] - self.ideal[body.name].position[i, :2]
            a = moving.acceleration[i]
            fx, fy = mass * a[0], mass * (a[1] + scene.gravity)
            forces[3 * k : 3 * k + 3] = fx, fy, inertia * a[2] + arm[0] * fy - arm[1] * fx
        for load in self.system.applied_loads.values():
            k = 3 * self.constraints.bodies.index(load.body)
            size = load.force(ANGLES / (speed or math.inf), crank, (height, velocity))
            angle = self.ideal[load.body].position[:, 2]
            forces[k : k + 2] -= size[i] * np.array(load.direction)
            forces[k + 2] -= load.moment(size, angle)[i]
        for spring in self.mechanism.springs:
            motion = spring_motion(self.mechanism, spring, self.ideal)
            push = spring.force(motion.length, motion.rate)[i] * motion.direction[i]
            ends = spring_ends(self.mechanism, spring)
            for sign, (name, point) in zip((-1.0, 1.0), ends, strict=True):
                if name in self.constraints.bodies:
                    k, ideal = 3 * self.constraints.bodies.index(name), self.ideal[name]
                    x, y = (ideal.point_motion(point).position - ideal.position)[i, :2]
                    forces[k : k + 2] -= sign * push
                    forces[k + 2] -= sign * (x * push[1] - y * push[0])
        return np.asarray(forces * self.scale)


def correction(rows: Array, residuals: Array) -> Array:
    """Return the smallest change of the coordinates that satisfies linearized constraints."""
    return np.asarray(np.linalg.lstsq(rows, -residuals, rcond=INDEPENDENT)[0])


class _Instant:
    """The mechanism at one of the angles.

    Attributes:
        ideal: coordinates (n,) of the ideal motion.
        forces: on the journals of the clearance joints, x + iy, N.
    """

    def __init__(self, problem: _Problem, i: int) -> None:
        """Compute the joints' forces; redundant joints share a load evenly."""
        self._problem, self.ideal = problem, problem.ideal_q[i]
        self._omega = {n: m.velocity[i, 2] for n, m in problem.ideal.items()} | {GROUND: 0.0}
        self._angle = {n: m.position[i, 2] for n, m in problem.ideal.items()} | {GROUND: 0.0}
        self._free = null_space(problem.constrain(self.ideal, self.ideal)[1]).T
        self._reach = problem.gaps(self.ideal)[1] @ self._free
        generalized = self._free.T @ problem.joint_forces(i)
        forces = np.linalg.lstsq(self._reach.T, generalized, rcond=INDEPENDENT)[0]
        forces = forces / problem.constraints.size
        self.forces = forces[0::2] + 1j * forces[1::2]

    def eccentricities(self, is_loaded: Array) -> Array:
        """Return the equilibrium positions of loaded joints, (m, 2), m; NaN where there is none."""
        eccentricities = np.zeros((len(is_loaded), 2))
        joints, scene = self._problem.clearance_joints, self._problem.system.scene.joints
        for k in np.flatnonzero(is_loaded):
            kind = scene[joints[k].name]
            assert not isinstance(kind, IdealJoint)
            turning = self._omega[joints[k].journal], self._omega[joints[k].bearing]
            interfaces = interfaces_of(kind, self._problem.system.scene)
            turned = self._angle[joints[k].bearing]
            force, is_guided = complex(self.forces[k]), self._is_guided(int(k))
            e = _equilibrium(interfaces, force, *turning, turned, is_guided)
            eccentricities[k] = (math.nan, math.nan) if e is None else (e.real, e.imag)
        return eccentricities

    def _is_guided(self, k: int) -> bool:
        """Return whether a dry journal moves along a line alone: others bear its friction."""
        if self._problem.films[k]:
            return False
        sizes = np.linalg.svd(self._reach[2 * k : 2 * k + 2], compute_uv=False)
        return bool((sizes > INDEPENDENT * sizes[0]).sum() < 2)

    def add_wear(self, eccentricities: Array, is_loaded: Array) -> Array:
        """Return eccentricities (m, 2) in round bearings as they are in worn ones.

        A contact lies on the worn surface, with the same normal; a film has the same relative gap.
        """
        in_worn, problem = eccentricities.copy(), self._problem
        for k in np.flatnonzero(is_loaded):
            e, joint = eccentricities[k], problem.clearance_joints[k]
            kind = problem.system.scene.joints[joint.name]
            if not isinstance(kind, DryJoint | LubricatedJoint) or kind.worn is None:
                continue
            profiles, size = kind.worn.profiles(), float(np.linalg.norm(e))
            if profiles is None or size == 0.0:
                continue
            n = e / size
            angle, depth, slope = math.atan2(n[1], n[0]), 0.0, 0.0
            for body, shape in zip((joint.journal, joint.bearing), profiles, strict=True):
                depth_there, slope_there, _ = shape.derivatives(angle - self._angle[body])
                depth, slope = depth + depth_there, slope + slope_there
            clearance = unworn(kind).clearance
            if kind.onset is not None and size > clearance - kind.onset:
                in_worn[k] = (size + depth) * n + slope * np.array([-n[1], n[0]])
            else:
                in_worn[k] = (1.0 + depth / clearance) * e
        return in_worn

    def positions(self, eccentricities: Array) -> Array:
        """Return the coordinates (n,) with eccentricities closest to some, (2 m,), m."""
        problem, q = self._problem, self.ideal
        inverse = np.linalg.pinv(self._reach, rcond=INDEPENDENT)
        gaps = self._reach @ (inverse @ eccentricities) / problem.constraints.size
        for _ in range(3):
            q = q + self._free @ (inverse @ (gaps - problem.gaps(q)[0]))
            residuals, rows = problem.constrain(q, self.ideal)
            q = q + correction(rows, residuals)
        return np.asarray(q)


def _equilibrium(
    interfaces: list[InterfaceLaw],
    force: complex,
    omega_j: float,
    omega_b: float,
    turned: float,
    is_guided: bool = False,
) -> complex | None:
    """Return the eccentricity at which interfaces exert a force on a journal at rest, or None.

    A bearing with grooves, turned by an angle, rad, has its force at the angle of the eccentricity
    in it, which is found by iteration. Across the force of a guided journal its guide bears all.
    """

    def surface_force(e: float) -> complex:
        """Return the force along the eccentricity and a quarter turn from it, at rest."""
        loads = [interface.load(e, 0.0, 0.0, omega_j, omega_b) for interface in interfaces]
        total = sum((complex(f[0], f[1]) for f in loads if f is not None), 0j)
        return complex(total.real) if is_guided else total

    is_oriented = any(interface.is_oriented for interface in interfaces)
    e = -force
    for _ in range(ORIENTATIONS if is_oriented else 1):
        for interface in interfaces:
            interface.orient(cmath.phase(e) - turned)
        size = _equilibrium_size(surface_force, interfaces, abs(force))
        if size is None:
            return None
        direction = force / surface_force(size)
        e = size * direction / abs(direction)
    return e


def _equilibrium_size(
    surface_force: Callable[[float], complex], interfaces: list[InterfaceLaw], load: float
) -> float | None:
    """Return the size of the eccentricity at which the force equals a load, or None."""
    dry = [interface for interface in interfaces if isinstance(interface, DryInterface)]
    low, high = 0.0, LARGEST_RATIO * interfaces[0].reach
    if dry:
        high = dry[0].clearance + SHALLOW * dry[0].radius
        low = dry[0].clearance if len(dry) == len(interfaces) else 0.0
    if not abs(surface_force(low)) < load <= abs(surface_force(high)):
        return None
    while low < (middle := 0.5 * (low + high)) < high:  # to the last digit, for stiff contacts
        if abs(surface_force(middle)) < load:
            low = middle
        else:
            high = middle
    return high
