"""An assembled system as the integration sees it."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in_system import pendulum, settings

from exu_press import InputError, Scene
from exu_press.integrate.system import System


def test_nodes_come_in_the_order_of_their_coordinates_and_leave_none_out():
    system = System.of_mbs(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}).build().mbs)
    ends = [node.start + node.size for node in system.nodes]
    assert [node.start for node in system.nodes] == [0, *ends[:-1]]
    assert ends[-1] == len(system.current.positions)
    assert len(system.joints.joints) == 1 and not system.has_film
    assert system.contacts == ()


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


@pytest.mark.parametrize("offset", [True, False])
def test_rates_of_prescribed_offsets_are_not_provided(offset):
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=node))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (mbs.AddNode(items.NodePointGround()), node)
    ]
    keys = {"offsetUserFunction": lambda mbs, time, item, offset: time} if offset else {}
    mbs.AddObject(items.ObjectConnectorCoordinate(markerNumbers=ends, **keys))
    mbs.Assemble()
    assert System.of_mbs(mbs).rates_not_provided is offset


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


def test_nodes_that_are_not_named_are_excluded():
    system = System.of_mbs(pendulum("dry"), {7: ("rod", 4.0)})
    assert [node.mass for node in system.nodes] == [np.inf]
    system = System.of_mbs(pendulum("dry"), {0: ("rod", 4.0)})
    assert [(node.name, node.mass) for node in system.nodes] == [("rod", 4.0)]


def test_its_states_are_where_exudyn_keeps_them_in_a_whole_run():
    """What is written to a copy, or to where they were once, Exudyn would not see."""
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.5], initialVelocities=[1.0]))
    mbs.AddObject(items.ObjectMass1D(mass=1.0, nodeNumber=node))
    mbs.Assemble()
    system, seen = System.of_mbs(mbs), []
    current = exu.ConfigurationType.Current

    def look(mbs, time):
        seen.append([*system.current.positions, *mbs.systemData.GetODE2Coordinates(current)])
        if len(seen) == 3:
            system.current.velocities[:] = 3.0
        return True

    mbs.SetPostStepUserFunction(look)
    mbs.SolveDynamic(settings(1.0, steps=4))
    assert [pair[0] for pair in seen] == pytest.approx([0.0, 0.25, 0.5, 1.25, 2.0])
    assert [pair[0] for pair in seen] == [pair[1] for pair in seen]


def test_lie_group_nodes_are_refused():
    mbs = exu.SystemContainer().AddSystem()
    node = mbs.AddNode(items.NodeRigidBodyRotVecLG(referenceCoordinates=[0.0] * 6))
    mbs.AddObject(items.ObjectRigidBody(nodeNumber=node, mass=1, inertia=[1, 1, 1, 0, 0, 0]))
    mbs.Assemble()
    with pytest.raises(InputError, match=r"node 0 .* is a RigidBodyRotVecLG: allowed"):
        System.of_mbs(mbs)
