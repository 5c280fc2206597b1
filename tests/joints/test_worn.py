"""A joint of worn surfaces: the place of contact, what it stores, and the round one as its limit.

What holds of round joints too is in `test_planar`.
"""

import math

import numpy as np
import pytest
from differences import forces, state_in
from planar_states import ANGLES, CLEARANCE, KINDS, STIFFNESS, WORN_KINDS, joints, unit

from exu_press.joints.joint import GROUND
from exu_press.joints.worn import WornJoint, WornSurfaces
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.profile import profile


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
