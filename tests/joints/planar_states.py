"""Clearance joints between two planar bodies anywhere, round and worn, in states that act."""

import math
import random

import numpy as np

from exu_press.joints.interface import DryInterface, FilmInterface
from exu_press.joints.planar import PlanarEnd, PlanarJoint
from exu_press.joints.worn import WornJoint, WornSurfaces
from exu_press.laws.contact import hertz, hunt_crossley, step_damping
from exu_press.laws.film import film_scale, finite, pi_film, pinkus, short, with_asperities
from exu_press.laws.friction import LuGre, lugre_steady, no_friction
from exu_press.laws.profile import profile

RADIUS, CLEARANCE = 0.07, 1e-4
STIFFNESS = 2.5545e10
STEADY = lugre_steady(0.15, 0.1, 1e-3, 0.1, 2.0, 1e-4)
BRISTLE = LuGre(0.15, 0.1, 1e4, 40.0, 1e-3, 0.1, 2.0)
ANGLES = np.linspace(0.0, 2.0 * np.pi, 36, endpoint=False)


def dry(friction=STEADY, contact=None, onset=0.0):
    contact = contact or step_damping(hertz(STIFFNESS), 2.5545e6, 1e-5)
    return DryInterface(contact, friction, RADIUS, CLEARANCE - onset)


def film(law):
    return FilmInterface(law, film_scale(0.4, 0.1, RADIUS, CLEARANCE), CLEARANCE)


def bristle():
    interface = dry(BRISTLE)
    interface.bristle = 0.5e-5
    interface.begin_step(1e-6, accepted=False)
    return interface


LAWS = {"pinkus": pinkus(), "pi_film": pi_film(), "short": short(0.7), "finite": finite(0.7)}
FILMS = {name: lambda law=law: [film(law)] for name, law in LAWS.items()} | {
    "mixed": lambda: [film(with_asperities(pi_film(), 0.1)), dry(onset=0.1 * CLEARANCE)]
}
KINDS = FILMS | {
    "without friction": lambda: [dry(no_friction())],
    "steady friction": lambda: [dry()],
    "hysteretic": lambda: [dry(contact=hunt_crossley(hertz(STIFFNESS), 0.7))],
    "with tension": lambda: [dry(contact=step_damping(hertz(STIFFNESS), 2.5545e6, 1e-5, True))],
    "bristle": lambda: [bristle()],
}


def dent(depth, at, sharpness=1):
    """Depths of a smooth dent at an angle."""
    return depth * np.cos(0.5 * (ANGLES - at)) ** (2 * sharpness)


WORN = WornSurfaces(
    profile(ANGLES, dent(1.5e-5, 0.7), 4e-6), profile(ANGLES, dent(2e-5, -0.4, 3), 3e-6), 0.3, -0.2
)
WORN_KINDS = ("without friction", "steady friction", "hysteretic", "finite", "mixed")


def unit(angle):
    return np.array([math.cos(angle), math.sin(angle)])


def turned(vector):
    return np.array([-vector[1], vector[0]])


def places(joint, q):
    """Positions of the two bodies' frames."""
    ends = joint.journal, joint.bearing
    return [np.array(end.reference[:2]) + np.take(q, end.indices[:2]) for end in ends]


def arms(joint, q):
    """From the frames to journal and bearing, written anew."""
    found = []
    for end in (joint.journal, joint.bearing):
        n = unit(end.reference[2] + q[end.indices[2]])
        found.append(end.point[0] * n + end.point[1] * turned(n))
    return found


def ends(rng):
    return [
        PlanarEnd(
            (index, index + 1, index + 2),
            tuple(rng.uniform(-0.2, 0.2) for _ in range(3)),
            (rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)),
        )
        for index in (0, 3)
    ]


def state_of(joint, rng):
    """A state with the journal where it acts, slow across the gap; and the direction of that."""
    q, q_t = [rng.uniform(-0.1, 0.1) for _ in range(6)], [0.0] * 6
    q_t[:3] = [rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2), rng.uniform(-30, 30)]
    q_t[5] = rng.uniform(-30, 30)
    angle = rng.uniform(-math.pi, math.pi)
    n = unit(angle)
    touches = isinstance(joint.interfaces[-1], DryInterface)
    if len(joint.interfaces) > 1:
        e = CLEARANCE * rng.uniform(0.9, 1.08) * n
    elif touches:
        e = (CLEARANCE + 10 ** rng.uniform(-6.0, -5.0)) * n
    else:
        e = CLEARANCE * rng.uniform(0.05, 0.9) * n
    if touches and isinstance(joint, WornJoint):
        j, j_1, _ = joint.worn.journal.derivatives(angle - joint._turned_j - q[2])
        b, b_1, _ = joint.worn.bearing.derivatives(angle - joint._turned_b - q[5])
        e += (j + b) * n + (j_1 + b_1) * turned(n)
    arm_j, arm_b = arms(joint, q)
    at_j, at_b = places(joint, q)
    q[3:5] = np.array(q[3:5]) + at_j + arm_j - at_b - arm_b - e
    relative = rng.uniform(-2e-3, 4e-3) * n + rng.uniform(-0.3, 0.3) * turned(n)
    q_t[3:5] = np.array(q_t[:2]) + q_t[2] * turned(arm_j) - q_t[5] * turned(arm_b) - relative
    return [float(x) for x in q], [float(x) for x in q_t], angle


def joints(kind, worn, seed, count):
    """Yield joints of a kind with a state each, and the direction of the journal in it."""
    rng = random.Random(seed)
    for _ in range(count):
        surfaces = (WORN,) if worn else ()
        joint = (WornJoint if worn else PlanarJoint)(*ends(rng), KINDS[kind](), *surfaces)
        yield joint, *state_of(joint, rng)
