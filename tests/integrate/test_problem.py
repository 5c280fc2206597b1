"""An assembled system as the integration sees it."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import InputError
from exu_press.integrate.problem import Problem
from exudyn_examples import EXAMPLES


def problem_of(name, bodies=None):
    mbs = exu.SystemContainer().AddSystem()
    EXAMPLES[name].build(mbs)
    mbs.Assemble()
    return Problem.of(mbs, bodies)


def test_nodes_come_in_the_order_of_their_coordinates_and_leave_none_out():
    problem = problem_of("slider-crank")
    assert [(node.start, node.size) for node in problem.nodes] == [(0, 3), (3, 3), (6, 2)]
    assert [node.displacements for node in problem.nodes] == [2, 2, 2]
    assert problem.length == pytest.approx(0.4 + np.sqrt(0.91))


@pytest.mark.parametrize(
    ("name", "switching", "untold", "quaternions"),
    [
        ("slider-crank", False, False, 0),
        ("driven crank", False, True, 0),
        ("mass points", False, True, 0),
        ("stick-slip", True, False, 0),
        ("rotor run-up", False, False, 1),
        ("flyball, angles", False, False, 0),
    ],
)
def test_what_a_system_has_is_seen(name, switching, untold, quaternions):
    problem = problem_of(name)
    assert problem.switching is switching
    assert problem.untold_rates is untold
    assert sum(node.quaternion for node in problem.nodes) == quaternions
    assert problem.joints is None and not problem.lubricated


def test_a_mass_on_a_line_is_displaced_and_a_rotor_is_not():
    """Exudyn's node numbers are not equal to integers in a set."""
    mbs = exu.SystemContainer().AddSystem()
    nodes = [mbs.AddNode(items.Node1D(referenceCoordinates=[0.5])) for _ in range(2)]
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=nodes[0]))
    mbs.AddObject(items.ObjectRotationalMass1D(inertia=1.0, nodeNumber=nodes[1]))
    mbs.Assemble()
    problem = Problem.of(mbs)
    assert [node.displacements for node in problem.nodes] == [1, 0]
    assert problem.length == 0.5


def rotor_with_an_angle(**numbers):
    """A rotor, and a connector that counts its turns in a data variable."""
    mbs = exu.SystemContainer().AddSystem()
    inertia = items.InertiaCuboid(1000.0, [0.1, 0.1, 0.1])
    rotor = mbs.CreateRigidBody(inertia=inertia, initialAngularVelocity=[0.0, 0.0, 9.0])
    ground = mbs.CreateGround()
    ends = [mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body)) for body in (ground, rotor)]
    turns = mbs.AddNode(items.NodeGenericData(initialCoordinates=[0], numberOfDataCoordinates=1))
    connector = items.TorsionalSpringDamper(markerNumbers=ends, nodeNumber=turns, **numbers)
    mbs.AddObject(connector)
    mbs.Assemble()
    return mbs


@pytest.mark.parametrize(
    ("numbers", "acts"),
    [({}, False), ({"stiffness": 1.0}, True), ({"damping": 1.0}, True), ({"torque": 1.0}, True)],
)
def test_a_connector_that_counts_turns_switches_nothing(numbers, acts):
    problem = Problem.of(rotor_with_an_angle(**numbers))
    assert not problem.switching and not problem.switching_forces
    assert problem.springs is acts


def test_data_variables_switch_where_something_could_use_them():
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.5]))
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=node))
    mbs.AddNode(items.NodeGenericData(initialCoordinates=[0], numberOfDataCoordinates=1))
    mbs.Assemble()
    assert not Problem.of(mbs).switching
    mbs.SetPostNewtonUserFunction(lambda mbs, time: [0.0, -1.0])
    assert Problem.of(mbs).switching


def test_nodes_that_are_not_named_have_no_say():
    problem = problem_of("slider-crank", {1: ("rod", 4.0)})
    assert [node.mass for node in problem.nodes] == [np.inf, 4.0, np.inf]
    assert problem.nodes[1].name == "rod"


def test_its_states_are_where_exudyn_keeps_them_in_a_whole_run():
    """What is written to a copy, or to where they were once, Exudyn would not see."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.5], initialVelocities=[1.0]))
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=node))
    mbs.Assemble()
    problem, seen = Problem.of(mbs), []
    current = exu.ConfigurationType.Current

    def look(mbs, time):
        seen.append([*problem.current.positions, *mbs.systemData.GetODE2Coordinates(current)])
        if len(seen) == 3:
            problem.current.velocities[:] = 3.0
        return True

    mbs.SetPostStepUserFunction(look)
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = 4
    settings.solution.file.write = False
    mbs.SolveDynamic(settings)
    assert [pair[0] for pair in seen] == pytest.approx([0.0, 0.25, 0.5, 1.25, 2.0])
    assert [pair[0] for pair in seen] == [pair[1] for pair in seen]


def test_lie_group_nodes_are_refused():
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.NodeRigidBodyRotVecLG(referenceCoordinates=[0.0] * 6))
    mbs.AddObject(items.ObjectRigidBody(nodeNumber=node, mass=1, inertia=[1, 1, 1, 0, 0, 0]))
    mbs.Assemble()
    with pytest.raises(InputError, match=r"node 0 .* is a RigidBodyRotVecLG: allowed"):
        Problem.of(mbs)
