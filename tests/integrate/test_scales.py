"""Kinetic norms, and scales of errors that grow with the motion."""

from types import SimpleNamespace

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from patched import PATCHED
from stand_in import problem_at

from exu_press import solve_dynamic
from exu_press.integrate.problem import Node
from exu_press.integrate.scales import ErrorScales, FoundScales, weights
from exudyn_examples.planar import truss


def bodies(*masses):
    """Nodes of planar bodies, whose masses are given or to be found (None)."""
    return [
        Node(i, f"body {i}", 3 * i, 3, mass, 2 if mass is None else 0)
        for i, mass in enumerate(masses)
    ]


def scales(nodes, inertias, velocities, given=None, **changes):
    problem = problem_at(nodes, velocities, length=2.0, **changes)
    found = FoundScales(given or ErrorScales(), problem, longest=0.1)
    found.begin(np.diag(inertias))
    return found


def test_the_largest_body_counts_by_its_kinetic_energy():
    found = scales(bodies(None, None), [2.0, 2.0, 0.5, 8.0, 8.0, 1.0], [0.0] * 6)
    assert found.squares([3.0, 4.0, 0.0, 0.0, 0.0, 8.0]) == pytest.approx([25.0, 8.0])
    assert found.norm([3.0, 4.0, 0.0, 0.0, 0.0, 8.0]) == pytest.approx(5.0)


def test_speed_and_force_are_the_largest_so_far():
    found = scales(bodies(None), [2.0, 2.0, 0.5], [3.0, 4.0, 0.0])
    assert found.speed == pytest.approx(5.0)
    found.update([6.0, 8.0, 0.0], [1.0, 0.0, 0.0])
    found.update([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    assert (found.speed, found.force) == pytest.approx((10.0, 2.0))


def test_what_is_given_stays():
    given = ErrorScales(speed=7.0, force=9.0)
    found = scales(bodies(None), [2.0, 2.0, 0.5], [3.0, 4.0, 0.0], given)
    found.update([60.0, 80.0, 0.0], [100.0, 0.0, 0.0])
    assert found.fixed and (found.speed, found.force) == (7.0, 9.0)


STILL = {"velocities": [0.0] * 3, "accelerations": [10.0, 0.0, 0.0]}


def test_a_system_at_rest_has_the_speed_that_it_will_have_within_the_largest_step():
    assert scales(bodies(None), [2.0, 2.0, 0.5], **STILL).speed == pytest.approx(1.0)


def test_speeds_that_are_expected_fade():
    """A vibration turns back before: its scale was ten times its speed, to the end of the run."""
    found = scales(bodies(None), [2.0, 2.0, 0.5], **STILL)
    for speed, expected in ((0.1, np.exp(-1.0)), (0.3, 0.3), (0.2, 0.3)):
        found.update([speed, 0.0, 0.0], [1.0, 0.0, 0.0], 0.01)
        found.update([0.0, 0.0, 0.0], [1.0, 0.0, 0.0])
        assert found.speed == pytest.approx(expected)


def test_what_is_expected_of_coordinates_that_are_no_displacements_fades_too():
    """It stayed to the end of the run, and errors were as much larger than stated."""
    still = {"velocities": [0.0], "accelerations": [10.0]}
    found = scales([Node(0, "modes", 0, 1, mass=None)], [2.0], **still)
    assert found.norm([1.0]) == pytest.approx(1.0)
    for _ in range(100):
        found.update([0.1], [1.0], 0.01)
    assert found.norm([0.1]) == pytest.approx(1.0)


@PATCHED
def test_a_body_at_rest_in_a_clearance_has_the_speed_at_which_it_arrives():
    narrow = scales(bodies(None), [2.0, 2.0, 0.5], **STILL, joints=SimpleNamespace(widest=1e-3))
    assert narrow.speed == pytest.approx(np.sqrt(4.0 * 1e-3 * 10.0))


def test_what_is_not_displaced_counts_by_its_own_largest_energy():
    nodes = [Node(0, "rotor", 0, 1, mass=None), Node(1, "mass", 1, 1, mass=None, displacements=1)]
    found = scales(nodes, [0.5, 2.0], [100.0, 4.0])
    assert found.speed == pytest.approx(4.0)
    assert found.norm([100.0, 0.0]) == pytest.approx(4.0), "a whole speed, whatever its inertia"


def test_three_angles_count_by_the_turning_of_their_body():
    """Turned by 80 degrees about y, fast angles about x and z all but cancel."""
    nodes = [Node(0, "body", 0, 6, displacements=3, rotations=3)]
    rates = np.array([0.0, 0.0, 0.0, 100.0, 1.0, -99.0])
    found = scales(nodes, [2.0] * 3 + [0.5] * 3, rates.tolist(), positions=[0.0] * 4 + [1.4, 0.0])
    square = 100.0**2 + 1.0 + 99.0**2 - 2.0 * np.sin(1.4) * 100.0 * 99.0
    assert found.speed == pytest.approx(np.sqrt(0.25 * square))
    other = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    along = 0.25 * (-99.0 + np.sin(1.4) * 100.0) / found.speed
    assert found.along(other.tolist(), rates.tolist()) == pytest.approx(abs(along))
    assert found.squares(rates.tolist()) == pytest.approx([0.25 * square])


def test_three_angles_are_followed_where_all_scales_are_given():
    nodes = [Node(0, "body", 0, 6, displacements=3, rotations=3)]
    places, given = np.zeros(6), ErrorScales(speed=7.0, force=9.0)
    found = scales(nodes, [2.0] * 3 + [0.5] * 3, [0.0] * 6, given, positions=places)
    both = [0.0, 0.0, 0.0, 1.0, 0.0, 1.0]
    assert found.norm(both) == pytest.approx(np.sqrt(0.25 * 2.0))
    places[4] = 1.4
    found.update([0.0] * 6, [100.0] * 6)
    assert found.norm(both) == pytest.approx(np.sqrt(0.25 * (2.0 + 2.0 * np.sin(1.4))))
    assert (found.speed, found.force) == (7.0, 9.0)


@PATCHED
@pytest.mark.parametrize("contact", [False, True])
@pytest.mark.parametrize(("rise", "least", "most"), [(0.5, 1.0, 3.0), (1e-3, 100.0, 1e3)])
def test_rounding_counts_by_what_constraints_make_of_it(rise, least, most, contact, monkeypatch):
    """In a roof a last digit moves joints as far as it is; nearly in a line it moves them far."""
    mbs = exu.SystemContainer().AddSystem()
    truss(mbs, rise)
    if contact:
        stop_far_away(mbs)
    assert least <= shaken(mbs, monkeypatch) <= most


@PATCHED
@pytest.mark.parametrize(("contact", "part"), [(False, 0.1), (True, 1.0)])
def test_forces_feel_a_tenth_of_rounding_unless_bodies_strike(contact, part, monkeypatch):
    mbs = exu.SystemContainer().AddSystem()
    mbs.CreateMassPoint(referencePosition=[1.0, 0.0, 0.0], physicsMass=1.0, gravity=[9.81, 0, 0])
    if contact:
        stop_far_away(mbs)
    assert shaken(mbs, monkeypatch) == pytest.approx(part)


def stop_far_away(mbs):
    """Add a contact to a system, a metre from its first coordinate."""
    ground = mbs.AddNode(items.NodePointGround())
    markers = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))
        for node in (ground, 0)
    ]
    gap = mbs.AddNode(items.NodeGenericData(initialCoordinates=[1.0], numberOfDataCoordinates=1))
    contact = items.ObjectContactCoordinate(
        markerNumbers=markers, nodeNumber=gap, contactStiffness=1e6, offset=1.0
    )
    mbs.AddObject(contact)


def shaken(mbs, monkeypatch):
    """Return by how much what rounds at the start of a system changes the rounding that counts."""
    mbs.Assemble()
    found, shake = [], FoundScales.shake

    def watched(scales, change, **keys):
        before = scales.alternating
        shake(scales, change, **keys)
        found.append(scales.alternating / before)

    monkeypatch.setattr(FoundScales, "shake", watched)
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    with pytest.warns(UserWarning, match="too many steps"):
        solve_dynamic(mbs, settings, max_steps=1)
    return found[0]


def test_weights_of_nodes():
    """Euler parameters have their mean, modes their frame's; what has no inertia is excluded."""
    nodes = [
        Node(0, "frame", 0, 7, displacements=3, rotations=4),
        Node(1, "modes", 7, 2, carrier=0),
        Node(2, "massless", 9, 1, displacements=1),
    ]
    matrix = np.diag([3.0, 3.0, 3.0, 1.0, 2.0, 3.0, 6.0, 1.0, 1.0, 0.0])
    inertias, masses = weights(nodes, matrix)
    assert inertias == pytest.approx([3.0] * 7 + [1.0, 1.0, 0.0])
    assert masses == [3.0, 3.0, np.inf]


def test_forces_count_by_what_they_move_a_body():
    """A node of 2 kg, 2 kg and 0.5 kg m2, beside one of 8 kg and one without a say."""
    nodes = [*bodies(None), Node(3, "pin", 3, 1, mass=None, displacements=1)]
    nodes.append(Node(4, "frame", 4, 1, mass=np.inf))
    found = scales(nodes, [2.0, 2.0, 0.5, 8.0, 1e-6], [0.0] * 5)
    assert found.lightest() == pytest.approx(np.sqrt(0.5 * 2.0) / 8.0)
