"""A clearance joint between two planar bodies: balance, power, and its Jacobian."""

import math
import random
from functools import partial

import numpy as np
import pytest
from differences import assert_partials, forces
from state_in import state_in

from exu_press.joints.interface import DryInterface, FilmInterface
from exu_press.joints.joint import GROUND
from exu_press.joints.planar import PlanarEnd, PlanarJoint
from exu_press.laws.contact import hertz, hunt_crossley, step_damping
from exu_press.laws.film import film_scale, finite, pi_film, pinkus, short, with_asperities
from exu_press.laws.friction import LuGre, lugre_steady, no_friction

RADIUS, CLEARANCE = 0.07, 1e-4
STEADY = lugre_steady(0.15, 0.1, 1e-3, 0.1, 2.0, 1e-4)
SCALE = film_scale(0.4, 0.1, RADIUS, CLEARANCE)


def dry(friction, contact=None):
    contact = contact or step_damping(hertz(2.5545e10), 2.5545e6, 1e-5)
    return DryInterface(contact, friction, RADIUS, CLEARANCE)


def bristle():
    interface = dry(LuGre(0.15, 0.1, 1e4, 40.0, 1e-3, 0.1, 2.0))
    interface.bristle = 0.5e-5
    interface.begin_step(1e-6, accepted=False)
    return interface


def mixed():
    """Film and contact in parallel."""
    contact = step_damping(hertz(2.5545e10), 2.5545e6, 1e-5)
    return [
        FilmInterface(with_asperities(pi_film(), 0.1), SCALE, CLEARANCE),
        DryInterface(contact, STEADY, RADIUS, 0.9 * CLEARANCE),
    ]


DRY = {
    "without friction": lambda: [dry(no_friction())],
    "steady friction": lambda: [dry(STEADY)],
    "hysteretic": lambda: [dry(STEADY, hunt_crossley(hertz(2.5545e10), 0.7))],
    "with tension": lambda: [dry(STEADY, step_damping(hertz(2.5545e10), 2.5545e6, 1e-5, True))],
    "bristle": lambda: [bristle()],
}
LAWS = {"pinkus": pinkus(), "pi_film": pi_film(), "short": short(0.7), "finite": finite(0.7)}
FILMS = {
    **{
        name: partial(lambda law: [FilmInterface(law, SCALE, CLEARANCE)], law)
        for name, law in LAWS.items()
    },
    "mixed": mixed,
}
BOTH = pytest.mark.parametrize("interfaces", [*DRY.values(), *FILMS.values()], ids=[*DRY, *FILMS])


def eccentricities(interfaces, rng):
    """Where the interfaces act: in contact where all are dry, within the clearance else."""
    if all(isinstance(interface, DryInterface) for interface in interfaces):
        return CLEARANCE + 10 ** rng.uniform(-6, -4.5)
    if len(interfaces) > 1:
        return CLEARANCE * rng.uniform(0.85, 1.1)
    return CLEARANCE * rng.uniform(0.05, 0.95)


def random_joint(interfaces, rng):
    """Return a joint between two bodies anywhere, and a state that has it act."""
    ends, points = [], []
    for index in (0, 3):
        reference = tuple(rng.uniform(-0.2, 0.2) for _ in range(3))
        point = (rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2))
        ends.append(PlanarEnd((index, index + 1, index + 2), reference, point))
        points.append(point)
    joint = PlanarJoint(*ends, interfaces)
    q = [rng.uniform(-0.1, 0.1) for _ in range(6)]
    q_t = [rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2), rng.uniform(-30, 30)] * 2
    q_t[5] = rng.uniform(-30, 30)
    e, direction = eccentricities(interfaces, rng), rng.uniform(-math.pi, math.pi)
    journal, bearing = centres(joint, q)
    q[3:5] = np.array(q[3:5]) + journal - bearing - e * unit(direction)
    # relative velocity of the centres: slow across the gap
    arm_j, arm_b = journal - places(joint, q)[0], centres(joint, q)[1] - places(joint, q)[1]
    relative = rng.uniform(-2e-3, 4e-3) * unit(direction)
    relative += rng.uniform(-0.3, 0.3) * turned(unit(direction))
    q_t[3:5] = np.array(q_t[:2]) + q_t[2] * turned(arm_j) - q_t[5] * turned(arm_b) - relative
    return joint, [float(x) for x in q], [float(x) for x in q_t]


def unit(angle):
    return np.array([math.cos(angle), math.sin(angle)])


def turned(vector):
    return np.array([-vector[1], vector[0]])


def places(joint, q):
    """Positions of the two bodies' frames."""
    return [
        np.array(end.reference[:2]) + np.take(q, end.indices[:2])
        for end in (joint.journal, joint.bearing)
    ]


def centres(joint, q):
    """Positions of journal and bearing, written anew."""
    found = []
    for end, place in zip((joint.journal, joint.bearing), places(joint, q), strict=True):
        angle = end.reference[2] + q[end.indices[2]]
        along, across = end.point
        found.append(place + along * unit(angle) + across * turned(unit(angle)))
    return found


@BOTH
def test_forces_and_moments_sum_to_zero_about_any_point(interfaces):
    rng = random.Random(5)
    for _ in range(200):
        joint, q, q_t = random_joint(interfaces(), rng)
        total = forces(joint, q, q_t)
        size = np.abs(total[:2]).max()
        assert total[:2] + total[3:5] == pytest.approx([0.0, 0.0], abs=1e-12 * max(size, 1.0))
        about = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2)])
        moment = 0.0
        for place, force in zip(places(joint, q), (total[:3], total[3:]), strict=True):
            arm = place - about
            moment += arm[0] * force[1] - arm[1] * force[0] + force[2]
        assert abs(moment) < 1e-12 * max(size, 1.0)


@BOTH
def test_state_agrees_with_the_generalised_forces(interfaces):
    """Power = Q . q_t, and the force of the state is the one on the journal's body."""
    rng = random.Random(6)
    for _ in range(50):
        joint, q, q_t = random_joint(interfaces(), rng)
        total = forces(joint, q, q_t)
        state = state_in(joint, [*q, *GROUND], [*q_t, *GROUND])
        journal, bearing = centres(joint, q)
        assert state.eccentricity == pytest.approx(journal - bearing, abs=1e-15)
        assert state.force == pytest.approx(total[:2], rel=1e-12)
        terms = total * q_t
        assert state.power == pytest.approx(terms.sum(), abs=1e-11 * np.abs(terms).sum())


@BOTH
@pytest.mark.parametrize("factors", [(1.0, 0.0), (0.0, 1.0), (1.3, -0.07), (1.0, 2e4)])
def test_jacobian_against_differences(interfaces, factors):
    """-(by_q dQ/dq + by_q_t dQ/dq_t), row by row; journal first, then bearing."""
    by_q, by_q_t = factors
    rng = random.Random(9)
    acting = 0
    for _ in range(15):
        joint, q, q_t = random_joint(interfaces(), rng)
        if not forces(joint, q, q_t).any():
            continue  # held at zero: no tension
        acting += 1
        given = np.array(joint.jacobian(by_q, by_q_t)).reshape(6, 6)
        assert_partials(given, partial(forces, joint, q, q_t), (q, q_t), factors, 1e-4)
    assert acting > 5


@pytest.mark.parametrize("interfaces", FILMS.values(), ids=FILMS)
def test_centred_journal_has_finite_forces(interfaces):
    """Every run starts there."""
    end = PlanarEnd((0, 1, 2), (0.0, 0.0, 0.0), (0.0, 0.0))
    joint = PlanarJoint(end, PlanarEnd((3, 4, 5), (0.0, 0.0, 0.0), (0.0, 0.0)), interfaces())
    for q_t in ([0.0] * 6, [0.01, 0.02, 25.0, 0.0, 0.0, 3.0]):
        assert np.all(np.isfinite(forces(joint, [0.0] * 6, q_t)))
        assert np.all(np.isfinite(joint.jacobian(1.0, 1e4)))
    assert forces(joint, [0.0] * 6, [0.1, 0.0, 0.0, 0.0, 0.0, 0.0])[0] < 0.0
