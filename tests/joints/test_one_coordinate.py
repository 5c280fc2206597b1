"""Joints hold on to bodies of one coordinate as to bodies that constraints hold."""

import math

import exudyn as exu
import numpy as np
import pytest
from exudyn.itemInterface import (
    MarkerNodeCoordinate,
    Node1D,
    NodePointGround,
    ObjectConnectorCoordinate,
    ObjectMass1D,
    ObjectRotationalMass1D,
)
from solving import solve
from stand_in_system import planar_body, recorded, settings

from exu_press import InputError, add_dry_revolute
from exu_press.joints import user_force_of
from exu_press.laws.contact import hertz, step_damping
from exu_press.laws.friction import lugre_steady

MASS, INERTIA = 4.0, 0.02
POINT = (0.1, 0.05)
SPEED = 0.3
UPWARDS = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
OBLIQUE = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]]
TILTED = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]


class OneJoint:
    """A body that may only slide or turn, and a free one whose bearing its journal sits in."""

    def __init__(self):
        self.SC = exu.SystemContainer()
        self.mbs = self.SC.AddSystem()

    def slide(self, rotation, start=0.02):
        """A body of one coordinate; returns body, journal point in its frame, and node."""
        node = self.mbs.AddNode(Node1D(referenceCoordinates=[start], initialVelocities=[SPEED]))
        item = ObjectMass1D(
            nodeNumber=node,
            mass=MASS,
            referencePosition=[0.3, 0.2, 0.0],
            referenceRotation=rotation,
        )
        local = np.array(rotation).T @ [*POINT, 0.0]
        return self.mbs.AddObject(item), (float(local[0]), float(local[1])), node

    def turn(self, angle=0.4):
        node = self.mbs.AddNode(Node1D(referenceCoordinates=[angle], initialVelocities=[3.0]))
        item = ObjectRotationalMass1D(
            nodeNumber=node, inertia=INERTIA, referencePosition=[0.3, 0.2, 0.0]
        )
        return self.mbs.AddObject(item), POINT, node

    def held(self, place, velocity, coordinates):
        body, node = planar_body(self.mbs, MASS, INERTIA, place, velocity)
        ground = self.mbs.AddMarker(
            MarkerNodeCoordinate(nodeNumber=self.mbs.AddNode(NodePointGround()), coordinate=0)
        )
        for coordinate in coordinates:
            marker = self.mbs.AddMarker(
                MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate)
            )
            self.mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=[ground, marker]))
        return body, POINT, node

    def run(self, body, point, node, bearing_at):
        """Let the journal hit the bearing of a free body; return the coordinates of both."""
        free, free_node = planar_body(self.mbs, MASS, INERTIA, [*bearing_at, 0.0])
        add_dry_revolute(
            self.mbs,
            (body, point),
            (free, (0.0, 0.0)),
            radius=0.05,
            clearance=1e-4,
            contact=step_damping(hertz(2.5545e10), 2.5545e6, 1e-5),
            friction=lugre_steady(0.15, 0.1, 0.0, 0.1, 2.0, 1e-4),
        )
        sensors = [recorded(self.mbs, each, "Coordinates") for each in (node, free_node)]
        self.mbs.Assemble()
        newton = {"newton__relativeTolerance": 1e-10}
        solve(self.mbs, settings(2e-3, 1000, generalizedAlpha__spectralRadius=0.8, **newton))
        return [np.asarray(self.mbs.GetSensorStoredData(s))[:, 1:] for s in sensors]


C, S = math.cos(0.4), math.sin(0.4)
TURNED = 0.3 + C * POINT[0] - S * POINT[1], 0.2 + S * POINT[0] + C * POINT[1]


@pytest.mark.parametrize(
    ("kind", "place", "velocity", "held", "centre"),
    [
        ("slide", [0.3, 0.22, 0.0], [0.0, SPEED, 0.0], (0, 2), (0.3 + POINT[0], 0.22 + POINT[1])),
        ("turn", [0.3, 0.2, 0.4], [0.0, 0.0, 3.0], (0, 1), TURNED),
    ],
)
def test_a_body_of_one_coordinate_is_hit_as_a_held_one(kind, place, velocity, held, centre):
    one, other = OneJoint(), OneJoint()
    moved, hit = one.run(*(one.slide(UPWARDS) if kind == "slide" else one.turn()), centre)
    constrained, expected = other.run(*other.held(place, velocity, held), centre)
    assert np.abs(expected).max() > 1e-4  # it was hit
    (free,) = {0, 1, 2} - {*held}
    assert moved[:, 0] == pytest.approx(constrained[:, free], abs=1e-9)
    assert hit == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("rotation", "says"), [(OBLIQUE, "moves at 53"), (TILTED, "tilted")])
def test_other_directions_are_refused(rotation, says):
    one = OneJoint()
    body, point, node = one.slide(rotation)
    with pytest.raises(InputError, match=f"body 0.*{says}.*allowed"):
        one.run(body, point, node, (0.0, 0.0))
    assert not user_force_of(one.mbs).joints
