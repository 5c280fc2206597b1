"""What a run is asked for, its system and constraints, and Exudyn's settings that are put back."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in_system import pendulum, settings

from exu_press import InputError, Scene
from exu_press.integrate.constraints import Constraints, normalise
from exu_press.integrate.scales import ErrorScales
from exu_press.integrate.system import System
from exu_press.integrate.task import SolverTuning, Task, prepared_settings


def test_a_mass_on_a_line_is_displaced_and_a_rotor_is_not():
    """Exudyn's node numbers are not equal to integers in a set."""
    mbs = exu.SystemContainer().AddSystem()
    nodes = [mbs.AddNode(items.Node1D(referenceCoordinates=[0.5])) for _ in range(2)]
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=nodes[0]))
    mbs.AddObject(items.ObjectRotationalMass1D(inertia=1.0, nodeNumber=nodes[1]))
    mbs.Assemble()
    system = System.of_mbs(mbs)
    assert [node.displacements for node in system.nodes] == [1, 0]
    assert system.length == 0.5


def test_contacts_of_exudyns_own_are_named_and_a_connector_that_counts_turns_is_none():
    mbs = pendulum("dry")
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (mbs.AddNode(items.NodePointGround()), 0)
    ]
    bodies = [mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=number)) for number in (0, 1)]
    data = [
        mbs.AddNode(items.NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
        for _ in range(2)
    ]
    mbs.AddObject(items.TorsionalSpringDamper(markerNumbers=bodies, nodeNumber=data[0]))
    contact = {"contactStiffness": 1e5, "name": "stop"}
    mbs.AddObject(items.ObjectContactCoordinate(markerNumbers=ends, nodeNumber=data[1], **contact))
    mbs.Assemble()
    assert System.of_mbs(mbs).contacts == ("stop (ContactCoordinate)",)


def test_lie_group_nodes_are_refused():
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.NodeRigidBodyRotVecLG(referenceCoordinates=[0.0] * 6))
    mbs.AddObject(items.ObjectRigidBody(nodeNumber=node, mass=1, inertia=[1, 1, 1, 0, 0, 0]))
    mbs.Assemble()
    with pytest.raises(InputError, match=r"node 0 .* is a RigidBodyRotVecLG: allowed"):
        System.of_mbs(mbs)


LUBRICATED = Scene(mechanism="slider_crank", joints={"crank_pin": "lubricated"})
IDEAL = Scene(mechanism="slider_crank", joints={})


@pytest.mark.parametrize(
    ("scene", "tolerance", "changes", "expected"),
    [
        (IDEAL, 1e-3, {}, 0.02 / 64.0),
        (LUBRICATED, 1e-3, {}, 2e-6),
        (LUBRICATED, 1e-3, {"minimumStepSize": 1e-6}, 1e-5),  # room to repeat it
        (IDEAL, 1e-3, {"initialStepSize": 1e-5}, 1e-5),
        (IDEAL, 1e-3, {"initialStepSize": 1.0}, 0.02),
        (IDEAL, None, {}, 0.02),
        (LUBRICATED, None, {}, 0.02 / 512.0),
    ],
)
def test_the_first_step(scene, tolerance, changes, expected):
    system = System.of_mbs(scene.build().mbs)
    task = Task(system, settings(2.0, **changes), tolerance, ErrorScales(), SolverTuning())
    assert task.largest == pytest.approx(0.02)
    assert task.first == pytest.approx(expected)


@pytest.mark.parametrize(("radius", "times"), [(0.8, 25.0), (1.0, 400.0)])
def test_rounding_alternates_by_the_spectral_radius(radius, times):
    """By 1 / (1 - rho)^2, with rho up to 0.95."""
    chosen = settings(2.0, generalizedAlpha__spectralRadius=radius)
    system = System.of_mbs(IDEAL.build().mbs)
    task = Task(system, chosen, None, ErrorScales(), SolverTuning(rounding=1e-15))
    size = len(system.current.positions)
    task.scales.begin([[float(i == j) for i in range(size)] for j in range(size)])
    assert task.scales.roundoff == pytest.approx(1e-15 * task.scales.length * times)


def test_settings_are_put_back_even_after_an_error():
    chosen = settings(2.0)
    before = chosen.GetDictionary()
    task = Task(System.of_mbs(IDEAL.build().mbs), chosen, 1e-3, ErrorScales(), SolverTuning())
    task.smallest = 1e-7
    with pytest.raises(ZeroDivisionError), prepared_settings(chosen, task):
        assert chosen.timeIntegration.minimumStepSize == 1e-7
        assert chosen.linearSolver.solverType == exu.LinearSolverType.EigenDense
        assert chosen.timeIntegration.discontinuous.maxIterations == 1
        raise ZeroDivisionError
    assert chosen.GetDictionary() == before


def constraints_of(scene):
    system = System.of_mbs(scene.build().mbs)
    return Constraints(Task(system, settings(), 1e-3, ErrorScales(), SolverTuning()))


@pytest.mark.parametrize("twice", [False, True])
def test_the_projection_is_the_least_change_in_the_norm_of_masses(twice):
    """x + y = 1 of masses of 1 and 3 kg: the light one takes three quarters; also twice."""
    constraints = constraints_of(Scene(mechanism="slider_crank", joints={}))
    directions, lengths = normalise(np.array([[1.0, 1.0]] * (2 if twice else 1)))
    project = constraints.projection(np.diag([1.0, 3.0]), directions)
    change = project(np.ones((len(directions), 1)) / lengths[:, None])
    assert change[:, 0] == pytest.approx([0.75, 0.25], rel=1e-6)
