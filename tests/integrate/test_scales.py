"""Kinetic norms, and scales of errors that grow with the motion."""

from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED
from stand_in_system import system_at

from exu_press.integrate.scales import ErrorScales, RunningScales, kinetic_weights
from exu_press.integrate.system import Node

PLANAR = [2.0, 2.0, 0.5]
STILL = {"velocities": [0.0] * 3, "accelerations": [10.0, 0.0, 0.0]}


def bodies(count):
    """Nodes of planar bodies, whose masses are read from the mass matrix."""
    return [Node(i, f"body {i}", 3 * i, 3, None, 2) for i in range(count)]


def scales(nodes, inertias, velocities, given=None, **changes):
    system = system_at(nodes, velocities, length=2.0, **changes)
    running = RunningScales(given or ErrorScales(), system, 0.1, 1e-3, 4e-15)
    running.begin(np.diag(inertias))
    return running


def test_the_largest_body_counts_by_its_kinetic_energy_and_rounding_by_the_length():
    running = scales(bodies(2), [*PLANAR, 8.0, 8.0, 1.0], [0.0] * 6)
    assert running.norm([3.0, 4.0, 0.0, 0.0, 0.0, 8.0]) == pytest.approx(5.0)
    assert running.roundoff == pytest.approx(4e-15 * 2.0)
    assert running.roundoff_speed == pytest.approx(4e-15 * 2.0 / 1e-3)


def test_speed_and_force_are_the_largest_so_far_unless_they_are_given():
    running = scales(bodies(1), PLANAR, [3.0, 4.0, 0.0])
    assert running.speed == pytest.approx(5.0)
    running.update([6.0, 8.0, 0.0], [1.0, 0.0, 0.0])
    running.update([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    assert (running.speed, running.force) == pytest.approx((10.0, 2.0))
    running = scales(bodies(1), PLANAR, [3.0, 4.0, 0.0], ErrorScales(speed=7.0, force=9.0))
    running.update([60.0, 80.0, 0.0], [100.0, 0.0, 0.0])
    assert not running.updates and (running.speed, running.force) == (7.0, 9.0)


@PATCHED
def test_a_system_at_rest_has_the_speed_that_it_will_have_within_the_largest_step():
    """In a clearance it has that at which it arrives."""
    assert scales(bodies(1), PLANAR, **STILL).speed == pytest.approx(1.0)
    narrow = scales(bodies(1), PLANAR, **STILL, joints=SimpleNamespace(widest=1e-3))
    assert narrow.speed == pytest.approx(np.sqrt(4.0 * 1e-3 * 10.0))


def test_weights_of_nodes():
    """Euler parameters have their mean, modes their frame's; what has no inertia is excluded.

    A rotor of 6 kg m^2 counts as at a radius of the length.
    """
    nodes = [
        Node(0, "frame", 0, 7, displacements=3, rotations=4),
        Node(1, "modes", 7, 2, carrier=0),
        Node(2, "massless", 9, 1, displacements=1),
        Node(3, "rotor", 10, 1),
    ]
    matrix = np.diag([3.0, 3.0, 3.0, 1.0, 2.0, 3.0, 6.0, 1.0, 1.0, 0.0, 6.0])
    inertias, masses = kinetic_weights(nodes, matrix, length=2.0)
    assert inertias == pytest.approx([3.0] * 7 + [1.0, 1.0, 0.0, 6.0])
    assert masses == [3.0, 3.0, np.inf, 1.5]
