"""A joint whose film depends on the angle in its bearing: balance, Jacobian, rotation."""

import cmath
import math
import random

import numpy as np
import pytest
from differences import assert_partials, forces

from exu_press.joints.oriented import GroovedInterface, OrientedJoint, TiltedInterface
from exu_press.joints.planar import PlanarEnd
from exu_press.laws.film.grooved_table import DIRECTIONS, LEVELS, GroovedFilm
from exu_press.laws.film.grooves import Groove, GroovedBearing
from exu_press.laws.film.tilted import TiltedFilm
from exu_press.model.loaded_start import _equilibrium

CLEARANCE, SCALE = 1e-4, 50.0


def film():
    """A smooth table that depends on the angle; of no bearing."""
    law = GroovedFilm(GroovedBearing(0.5, (Groove(0.0, 0.2, 1.0),)))
    x, angle, direction = np.meshgrid(
        np.linspace(0.0, 1.0, LEVELS),
        np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False),
        np.linspace(-math.pi, math.pi, DIRECTIONS, endpoint=False),
        indexing="ij",
    )
    ln_e, m = 2.0 + x + np.sin(angle) * np.cos(direction), 0.5 * np.cos(angle + direction)
    law.set_table(np.stack([ln_e, m, ln_e], axis=-1))
    return law


def joint_of(rng, interface=None):
    ends = [
        PlanarEnd(
            (index, index + 1, index + 2),
            tuple(rng.uniform(-0.2, 0.2) for _ in range(3)),
            (rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)),
        )
        for index in (0, 3)
    ]
    interface = interface or GroovedInterface(film(), SCALE, CLEARANCE)
    return OrientedJoint(*ends, [interface], 0.3)


def state_of(joint, rng, largest=0.8):
    """A state inside the clearance, q and q_t, by moving the journal's body."""
    q = [rng.uniform(-0.1, 0.1) for _ in range(6)]
    q_t = [rng.uniform(-1e-2, 1e-2) for _ in range(6)]
    joint.add_force([*q, 0.0, 0.0, 0.0], [*q_t, 0.0, 0.0, 0.0], [0.0] * 9)
    e, angle = rng.uniform(0.1, largest) * CLEARANCE, rng.uniform(-math.pi, math.pi)
    for k, coordinate in enumerate((e * math.cos(angle), e * math.sin(angle))):
        q[k] += coordinate - joint.eccentricity[k]
    joint.add_force([*q, 0.0, 0.0, 0.0], [*q_t, 0.0, 0.0, 0.0], [0.0] * 9)
    for k in (0, 1):
        q_t[k] += rng.uniform(-3e-3, 3e-3) - joint.relative_velocity[k]
    return q, q_t


def test_jacobian_is_the_derivative():
    rng = random.Random(5)
    for _ in range(4):
        joint = joint_of(rng)
        state = q, q_t = state_of(joint, rng)
        factors = 1.0, 1e-3
        forces(joint, q, q_t)
        joint._loads_before = [None]
        jacobian = np.reshape(joint.jacobian(*factors), (6, 6))
        assert_partials(jacobian, lambda: forces(joint, q, q_t), state, factors, 2e-3)  # noqa: B023


def test_momentum_and_a_bearing_that_turns_with_its_journal():
    """Forces cancel; the film is the same when both bodies and their motion are turned."""
    rng = random.Random(6)
    joint = joint_of(rng)
    q, q_t = state_of(joint, rng)
    out = forces(joint, q, q_t)
    assert np.allclose(out[:2], -out[3:5], rtol=1e-12)
    before = joint.interfaces[0].law.angle
    turn = 0.7
    c, s = math.cos(turn), math.sin(turn)
    rotation = np.array([[c, -s], [s, c]])
    moved, moved_t = list(q), list(q_t)
    for end, first in ((joint.journal, 0), (joint.bearing, 3)):
        at = np.array(end.reference[:2]) + q[first : first + 2]
        moved[first : first + 2] = rotation @ at - end.reference[:2]
        moved_t[first : first + 2] = rotation @ q_t[first : first + 2]
        moved[first + 2] += turn
    again = forces(joint, moved, moved_t)
    assert math.isclose(
        math.remainder(joint.interfaces[0].law.angle - before, math.tau), 0.0, abs_tol=1e-9
    )
    assert np.allclose(again[:2], rotation @ out[:2], rtol=1e-6)
    assert np.allclose(again[[2, 5]], out[[2, 5]], rtol=1e-6, atol=1e-9 * np.abs(out).max())


def test_a_loaded_start_knows_where_the_grooves_are():
    """The joint bears the load where the start puts the journal, with the bearing turned."""
    interface, load, turned = GroovedInterface(film(), SCALE, CLEARANCE), 300.0 - 200.0j, 0.4
    e = _equilibrium([interface], load, 60.0, 10.0, turned)
    interface.orient(cmath.phase(e) - turned)
    f_n, f_t, *_ = interface.load(abs(e), 0.0, 0.0, 60.0, 10.0)
    assert complex(f_n, f_t) * e / abs(e) == pytest.approx(load, rel=1e-3)


def tilted_joint(rng, tilt=0.5):
    law = TiltedFilm(GroovedBearing(0.5, ()), tilt, 0.7, (80, 8))
    return joint_of(rng, TiltedInterface(law, SCALE, CLEARANCE))


def test_power_and_balance_of_an_inclined_journal():
    """The film's dissipation is all the power of the joint's forces; angular momentum is kept."""
    rng = random.Random(7)
    for _ in range(4):
        joint = tilted_joint(rng)
        q, q_t = state_of(joint, rng, largest=0.4)
        q_t[2], q_t[5] = rng.uniform(-50, 50), rng.uniform(-50, 50)
        out = forces(joint, q, q_t)
        e, e_dot, v_t, w_j, w_b = joint._motion
        law = joint.interfaces[0].law
        eps_w, spin = (e * (w_j + w_b) - 2.0 * v_t) / CLEARANCE, w_j - w_b
        film = law.respond(e / CLEARANCE, e_dot / CLEARANCE, eps_w)
        loss = -film[0] * e_dot / CLEARANCE + 0.5 * film[1] * eps_w
        loss += 0.5 * film[10] * spin + film[8] * spin**2
        assert loss > 0.0
        assert out @ q_t == pytest.approx(-SCALE * CLEARANCE * loss, rel=1e-6)
        moment = 0.0
        for end, first in ((joint.journal, 0), (joint.bearing, 3)):
            x, y = np.array(end.reference[:2]) + q[first : first + 2]
            moment += x * out[first + 1] - y * out[first] + out[first + 2]
        assert moment == pytest.approx(0.0, abs=1e-9 * np.abs(out).max())
        assert joint.state.gap == pytest.approx(CLEARANCE * law.least_gap(e / CLEARANCE, law.angle))


def test_jacobian_of_an_inclined_journal():
    """But for the couple's derivatives by the speeds of the centre, and the moving grid."""
    rng = random.Random(8)
    for _ in range(3):
        joint = tilted_joint(rng, 0.3)
        state = q, q_t = state_of(joint, rng, largest=0.5)
        q_t[2] = 20.0
        forces(joint, q, q_t)
        joint._loads_before = [None]
        jacobian = np.reshape(joint.jacobian(1.0, 1e-3), (6, 6))
        assert_partials(jacobian, lambda: forces(joint, q, q_t), state, (1.0, 1e-3), 2e-2)  # noqa: B023
