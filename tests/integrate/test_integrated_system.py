"""An assembled system as the integration sees it."""

import exudyn as exu
import exudyn.utilities as items
import pytest
from stand_in_system import pendulum

from exu_press import InputError
from exu_press.integrate.system import System


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
