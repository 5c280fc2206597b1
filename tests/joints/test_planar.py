"""A clearance joint between two planar bodies, round or worn: balance, power, and its Jacobian."""

import random

import numpy as np
import pytest
from differences import assert_jacobian, forces, state_in
from planar_states import FILMS, KINDS, WORN_KINDS, arms, joints, places

from exu_press.joints.joint import GROUND
from exu_press.joints.planar import PlanarEnd, PlanarJoint

EACH = pytest.mark.parametrize(
    ("kind", "worn"), [*((kind, False) for kind in KINDS), *((kind, True) for kind in WORN_KINDS)]
)


@EACH
def test_forces_and_moments_sum_to_zero_about_any_point(kind, worn):
    rng = random.Random(5)
    for joint, q, q_t, _ in joints(kind, worn, 5, 150):
        total = forces(joint, q, q_t)
        size = max(np.abs(total).max(), 1.0)
        assert total[:2] + total[3:5] == pytest.approx([0.0, 0.0], abs=1e-12 * size)
        about = np.array([rng.uniform(-2, 2), rng.uniform(-2, 2)])
        moment = 0.0
        for place, force in zip(places(joint, q), (total[:3], total[3:]), strict=True):
            arm = place - about
            moment += arm[0] * force[1] - arm[1] * force[0] + force[2]
        assert abs(moment) < 1e-12 * size


@EACH
def test_state_agrees_with_the_generalised_forces(kind, worn):
    """Power = Q . q_t, the force of the state is the journal's body's, none comes from nothing."""
    lost = 0
    for joint, q, q_t, _ in joints(kind, worn, 6, 100):
        total = forces(joint, q, q_t)
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
@pytest.mark.parametrize("factors", [(1.0, 0.0), (0.0, 1.0), (1.3, -0.07), (1.0, 2e4)])
def test_jacobian_against_differences(kind, worn, factors):
    """-(by_q dQ/dq + by_q_t dQ/dq_t), row by row; journal first, then bearing."""
    acting = 0
    for joint, q, q_t, _ in joints(kind, worn, 9, 15):
        if not forces(joint, q, q_t).any():
            continue  # held at zero: no tension
        acting += 1
        assert_jacobian(joint, q, q_t, factors, 1e-4)
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
