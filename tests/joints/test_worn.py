"""A joint of worn surfaces: balance, energy, Jacobian, and the round one as its limit."""

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
from exu_press.joints.worn import WornJoint, WornSurfaces
from exu_press.laws.contact import hertz, hunt_crossley, step_damping
from exu_press.laws.film import film_scale, finite, with_asperities
from exu_press.laws.friction import lugre_steady, no_friction
from exu_press.laws.profile import profile

RADIUS, CLEARANCE = 0.05, 1e-4
ANGLES = np.linspace(0.0, 2.0 * np.pi, 36, endpoint=False)
STEADY = lugre_steady(0.15, 0.1, 1e-3, 0.1, 2.0, 1e-4)
SCALE = film_scale(0.1, 0.1, RADIUS, CLEARANCE)
CONTACT = step_damping(hertz(2.5545e10), 2.5545e6, 1e-5)


def shape(depth, at, sharpness=1):
    """A dent of the angle `at`, smooth."""
    return depth * np.cos(0.5 * (ANGLES - at)) ** (2 * sharpness)


WORN = WornSurfaces(
    profile(ANGLES, shape(1.5e-5, 0.7), 4e-6),
    profile(ANGLES, shape(2e-5, -0.4, 3), 3e-6),
    0.3,
    -0.2,
)


def dry(friction=STEADY, contact=CONTACT, onset=0.0):
    return DryInterface(contact, friction, RADIUS, CLEARANCE - onset)


KINDS = {
    "frictionless": lambda: [dry(no_friction())],
    "friction": lambda: [dry()],
    "hysteretic": lambda: [dry(STEADY, hunt_crossley(hertz(2.5545e10), 0.7))],
    "film": lambda: [FilmInterface(finite(1.0), SCALE, CLEARANCE)],
    "mixed": lambda: [
        FilmInterface(with_asperities(finite(1.0), 0.1), SCALE, CLEARANCE),
        dry(onset=0.1 * CLEARANCE),
    ],
}
EACH = pytest.mark.parametrize("name", KINDS)


def ends(rng):
    return [
        PlanarEnd(
            (index, index + 1, index + 2),
            tuple(rng.uniform(-0.2, 0.2) for _ in range(3)),
            (rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)),
        )
        for index in (0, 3)
    ]


def turned(vector):
    return np.array([-vector[1], vector[0]])


def arms(joint, q):
    found = []
    for end in (joint.journal, joint.bearing):
        angle = end.reference[2] + q[end.indices[2]]
        n = np.array([math.cos(angle), math.sin(angle)])
        found.append(end.point[0] * n + end.point[1] * turned(n))
    return found


def state_of(joint, rng, name):
    """A state with the journal where it acts, its surfaces moving slowly across the gap."""
    q, q_t = [rng.uniform(-0.1, 0.1) for _ in range(6)], [0.0] * 6
    q_t[:3] = [rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2), rng.uniform(-30, 30)]
    q_t[5] = rng.uniform(-30, 30)
    angle = rng.uniform(-math.pi, math.pi)
    if name == "film":
        e = rng.uniform(0.1, 0.8) * CLEARANCE * np.array([math.cos(angle), math.sin(angle)])
    else:
        deep = 10 ** rng.uniform(-6.0, -5.0) if name != "mixed" else rng.uniform(-8e-6, 5e-6)
        j, j_1, _ = joint.worn.journal.derivatives(angle - joint._turned_j - q[2])
        b, b_1, _ = joint.worn.bearing.derivatives(angle - joint._turned_b - q[5])
        n = np.array([math.cos(angle), math.sin(angle)])
        e = (joint.clearance + j + b + deep) * n + (j_1 + b_1) * turned(n)
    arm_j, arm_b = arms(joint, q)
    at = np.array(joint.journal.reference[:2]) + q[:2] + arm_j - e - arm_b
    q[3:5] = at - np.array(joint.bearing.reference[:2])
    relative = np.array([rng.uniform(-3e-3, 3e-3), rng.uniform(-3e-3, 3e-3)])
    q_t[3:5] = np.array(q_t[:2]) + q_t[2] * turned(arm_j) - q_t[5] * turned(arm_b) - relative
    return [float(v) for v in q], [float(v) for v in q_t], angle


def joints(name, seed, count):
    rng = random.Random(seed)
    for _ in range(count):
        joint = WornJoint(*ends(rng), KINDS[name](), WORN)
        yield joint, *state_of(joint, rng, name)


@EACH
def test_momentum_and_angular_momentum_are_kept(name):
    for joint, q, q_t, _ in joints(name, 1, 100):
        total = forces(joint, q, q_t)
        size = max(1.0, np.abs(total).max())
        assert np.abs(total[:2] + total[3:5]).max() < 1e-12 * size
        places = [
            np.array(end.reference[:2]) + np.array(q)[list(end.indices[:2])]
            for end in (joint.journal, joint.bearing)
        ]
        moment = sum(
            at[0] * part[1] - at[1] * part[0] + part[2]
            for at, part in zip(places, (total[:3], total[3:]), strict=True)
        )
        assert abs(moment) < 1e-10 * size * CLEARANCE / 1e-4


def test_the_place_of_contact_is_the_nearest_one():
    """It is where the state was put, and no other direction is deeper."""
    for joint, q, q_t, angle in joints("friction", 2, 100):
        state = state_in(joint, [*q, *GROUND], [*q_t, *GROUND])
        assert joint._touched[:2] == pytest.approx((math.cos(angle), math.sin(angle)), abs=1e-9)
        e = np.array(state.eccentricity)
        all_round = [
            e[0] * math.cos(a) + e[1] * math.sin(a)
            - joint.worn.journal.derivatives(a - joint._turned_j - q[2])[0]
            - joint.worn.bearing.derivatives(a - joint._turned_b - q[5])[0]
            - CLEARANCE
            for a in np.linspace(0.0, 2.0 * np.pi, 721)
        ]  # fmt: skip
        assert -1e-12 < -state.gap - max(all_round) < 1e-8


def test_what_is_stored_comes_back():
    """The generalised forces at rest are minus the energy's gradient: turns and moves alike."""
    for joint, q, _, _ in joints("frictionless", 3, 30):
        joint.interfaces[0].contact = step_damping(hertz(2.5545e10), 0.0, 1e-5)
        total = forces(joint, q, [0.0] * 6)
        for i in range(6):
            sides = []
            for shift in (1e-8, -1e-8):
                other = [*q]
                other[i] += shift
                sides.append(state_in(joint, [*other, *GROUND], [0.0] * 9).stored_energy)
            slope = (sides[0] - sides[1]) / 2e-8
            assert -slope == pytest.approx(total[i], abs=1e-4 * np.abs(total).max() + 1e-6)


@EACH
def test_no_energy_comes_from_nothing(name):
    lost = 0
    for joint, q, q_t, _ in joints(name, 4, 300):
        state = state_in(joint, [*q, *GROUND], [*q_t, *GROUND])
        total = forces(joint, q, q_t)
        assert state.power == pytest.approx(
            float(total @ q_t), abs=1e-9 * float(np.abs(total) @ np.abs(q_t))
        )
        assert state.dissipated_power >= -1e-9 * (abs(state.power) + abs(state.stored_power))
        lost += state.dissipated_power > 1e-6
    assert lost > 100


@EACH
@pytest.mark.parametrize("factors", [(1.0, 0.0), (0.0, 1.0), (1.3, 1e-3)])
def test_jacobian_against_differences(name, factors):
    by_q, by_q_t = factors
    acting = 0
    for joint, q, q_t, _ in joints(name, 5, 15):
        if not forces(joint, q, q_t).any():
            continue
        acting += 1
        given = np.array(joint.jacobian(by_q, by_q_t)).reshape(6, 6)
        assert_partials(given, partial(forces, joint, q, q_t), (q, q_t), factors, 2e-4)
    assert acting > 5


@EACH
def test_even_wear_is_a_round_joint(name):
    rng = random.Random(6)
    flat = profile(ANGLES, [2e-5] * len(ANGLES), 2e-5)
    for _ in range(30):
        both = ends(rng)
        worn = WornJoint(*both, KINDS[name](), WornSurfaces(flat, flat))
        q, q_t, _ = state_of(worn, rng, name)
        round_one = PlanarJoint(*both, KINDS[name]())
        found, wanted = forces(worn, q, q_t), forces(round_one, q, q_t)
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9 * np.abs(wanted).max())


def test_no_number_where_the_state_is_none():
    rng = random.Random(7)
    joint = WornJoint(*ends(rng), KINDS["mixed"](), WORN)
    assert np.isnan(forces(joint, [math.nan] * 6, [0.0] * 6)).any()
