"""A clearance joint between two planar bodies, round or worn: balance, power, Jacobian, contact."""

import math
import random

import numpy as np
import pytest
from differences import assert_jacobian, forces, state_in
from planar_states import (
    ANGLES,
    CLEARANCE,
    KINDS,
    STIFFNESS,
    WORN_KINDS,
    arms,
    joints,
    places,
    unit,
)

from exu_press.joints.joint import GROUND
from exu_press.joints.worn import WornJoint, WornSurfaces
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.profile import profile

EACH = pytest.mark.parametrize(
    ("kind", "worn"), [*((kind, False) for kind in KINDS), *((kind, True) for kind in WORN_KINDS)]
)


@EACH
def test_forces_and_moments_sum_to_zero_about_any_point(kind, worn):
    """Power = Q . q_t, the force of the state is the journal's body's, none comes from nothing."""
    rng, lost = random.Random(5), 0
    for joint, q, q_t, _ in joints(kind, worn, 5, 100):
        total = forces(joint, q, q_t)
        size = max(np.abs(total).max(), 1.0)
        assert total[:2] + total[3:5] == pytest.approx([0.0, 0.0], abs=1e-12 * size)
        about = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2)])
        moment = 0.0
        for place, force in zip(places(joint, q), (total[:3], total[3:]), strict=True):
            arm = place - about
            moment += arm[0] * force[1] - arm[1] * force[0] + force[2]
        assert abs(moment) < 1e-12 * size
        state = state_in(joint, [*q, *GROUND], [*q_t, *GROUND])
        arm_j, arm_b = arms(joint, q)
        at_j, at_b = places(joint, q)
        assert state.eccentricity == pytest.approx(at_j + arm_j - at_b - arm_b, abs=1e-15)
        assert state.force == pytest.approx(total[:2], rel=1e-12)
        terms = total * q_t
        assert state.power == pytest.approx(terms.sum(), abs=1e-11 * np.abs(terms).sum())
        if kind != "with tension":
            assert state.dissipated_power >= -1e-9 * (abs(state.power) + abs(state.stored_power))
        lost += state.dissipated_power > 1e-6
    assert lost > 30


@EACH
@pytest.mark.parametrize("factors", [(1.3, 0.0), (0.0, -0.07)])
def test_jacobian_against_differences(kind, worn, factors):
    """-(by_q dQ/dq + by_q_t dQ/dq_t), row by row; journal first, then bearing."""
    acting = 0
    for joint, q, q_t, _ in joints(kind, worn, 9, 15):
        if not forces(joint, q, q_t).any():
            continue  # held at zero: no tension
        acting += 1
        assert_jacobian(joint, q, q_t, factors, 1e-4)
    assert acting > 5


def test_the_place_of_contact_is_the_nearest_one():
    """It is where the state was put, and no other direction is deeper."""
    for joint, q, q_t, angle in joints("steady friction", True, 2, 20):
        state = state_in(joint, [*q, *GROUND], [*q_t, *GROUND])
        assert joint._touched[:2] == pytest.approx(unit(angle), abs=1e-9)
        all_round = [
            np.array(state.eccentricity) @ unit(a)
            - joint.worn.journal.derivatives(a - joint._turned_j - q[2])[0]
            - joint.worn.bearing.derivatives(a - joint._turned_b - q[5])[0]
            - CLEARANCE
            for a in np.linspace(0.0, 2.0 * np.pi, 721)
        ]
        assert -1e-12 < -state.gap - max(all_round) < 1e-8


def test_what_is_stored_comes_back():
    """The generalised forces at rest are minus the energy's gradient: turns and moves alike."""
    for joint, q, _, _ in joints("without friction", True, 3, 30):
        joint.interfaces[0].contact = step_damping(hertz(STIFFNESS), 0.0, 1e-5)
        total = forces(joint, q, [0.0] * 6)
        for i in range(6):
            sides = []
            for shift in (1e-8, -1e-8):
                other = [*q]
                other[i] += shift
                sides.append(state_in(joint, [*other, *GROUND], [0.0] * 9).stored_energy)
            slope = (sides[0] - sides[1]) / 2e-8
            assert -slope == pytest.approx(total[i], abs=1e-4 * np.abs(total).max() + 1e-6)


@pytest.mark.parametrize("kind", WORN_KINDS)
def test_even_wear_is_a_round_joint(kind):
    flat = profile(ANGLES, [2e-5] * len(ANGLES), 2e-5)
    for round_one, q, q_t, _ in joints(kind, False, 6, 30):
        both = round_one.journal, round_one.bearing
        even = WornJoint(*both, KINDS[kind](), WornSurfaces(flat, flat))
        found, wanted = forces(even, q, q_t), forces(round_one, q, q_t)
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9 * np.abs(wanted).max())


def test_no_number_where_the_state_is_none():
    joint, *_ = next(joints("mixed", True, 7, 1))
    assert np.isnan(forces(joint, [math.nan] * 6, [0.0] * 6)).any()
