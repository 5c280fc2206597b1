"""The Jacobian of contacts between the walls of a moving body, and what they do to its momentum."""

import numpy as np
import pytest

from exu_press.joints.interface import DryInterface
from exu_press.joints.moving_guideway import MovingGuidewayContact
from exu_press.joints.planar import PlanarEnd
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.friction import coulomb

CONTACT = step_damping(hertz(1e7, 1.0), damping_max=1e3, damping_depth=1e-6)
RATES = np.array([0.3, -0.2, 5.0, 0.1, 0.4, -3.0])


def contact(radius):
    """A point 0.1 m beside its body's centre, between walls 0.3 m beside those of another body."""
    end = PlanarEnd((0, 1, 2), (0.5, 0.2, 0.3), (0.1, 0.0))
    line = PlanarEnd((3, 4, 5), (0.2, 0.1, -0.4), (0.3, 0.05))
    interface = DryInterface(CONTACT, coulomb(0.2, 0.5), 0.02, 1e-4)
    return MovingGuidewayContact(end, line, 0.6, interface, radius)


def touching(radius):
    """Return a contact, and coordinates in which it touches by 0.1 mm."""
    joint, q = contact(radius), [0.0] * 6
    for _ in range(20):
        joint.add_force(q, [0.0] * 6, [0.0] * 6)
        normal = joint._rows[0]
        missing = 2e-4 - joint._motion[0]
        q[0], q[1] = q[0] + missing * normal[0], q[1] + missing * normal[1]
    return joint, np.array(q)


def forces(joint, q, q_t):
    out = [0.0] * 6
    joint.add_force(list(q), list(q_t), out)
    return np.array(out)


@pytest.mark.parametrize("radius", [None, 0.1])
def test_the_jacobian_is_the_derivative_but_for_turning_arms(radius):
    joint, q = touching(radius)
    step = 1e-7
    for by_q, by_q_t in ((1.0, 0.0), (0.0, 1.0)):
        differences = np.zeros((6, 6))
        for i, h in enumerate(step * np.eye(6)):
            ahead = forces(joint, q + by_q * h, RATES + by_q_t * h)
            behind = forces(joint, q - by_q * h, RATES - by_q_t * h)
            differences[:, i] = -(ahead - behind) / (2.0 * step)
        forces(joint, q, RATES)
        jacobian = np.array(joint.jacobian(by_q, by_q_t)).reshape(6, 6)
        assert jacobian == pytest.approx(differences, abs=2e-2 * np.abs(differences).max())


@pytest.mark.parametrize("radius", [None, 0.1])
def test_both_bodies_take_opposite_forces_at_the_same_point(radius):
    joint, q = touching(radius)
    out = forces(joint, q, RATES)
    assert np.hypot(*out[:2]) > 100.0
    assert out[:2] == pytest.approx(-out[3:5])
    apart = np.array([0.5, 0.2]) + q[:2] - np.array([0.2, 0.1])
    assert out[2] + out[5] + apart[0] * out[1] - apart[1] * out[0] == pytest.approx(0.0, abs=1e-9)
