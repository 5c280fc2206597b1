"""An Exudyn system of a scene: its items by name, and how to add bodies, markers and springs."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodePointGround,
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateSpringDamper,
    ObjectGround,
    SensorObject,
)

from exu_press.joints.joint import ClearanceJoint, States
from exu_press.mechanism import GROUND, Guide, Joint, Mechanism, Point, Spring
from exu_press.mechanism.independent_constraints import (
    independent_constraints,
    with_all_coordinates,
)
from exu_press.model.rigid_body import RigidBody
from exu_press.scene import Scene, mechanism_of

if TYPE_CHECKING:
    from exu_press.model.placed_part import PlacedPart
    from fe_models import FlexibleBody

__all__ = ["System"]


class System:
    """A system, under construction or assembled.

    Attributes:
        scene: of the system.
        parts: name -> flexible body's part; empty for rigid bodies.
        mechanism: bodies, joints and guides.
        constraints: independent ones of ideal joints and guides.
        ideal: name -> motion of the ideal mechanism at the start.
        applied_loads: name -> load.
        clocks: of pulses and sheets, updated at the end of every step, each with a function that
            reads its coordinate and rate at a time.
        ahead: [angle, rad, of a crank at constant speed at time 0 from its start]; not 0 where a
            run continues one of another start.
        SC: Exudyn's system container.
        mbs: Exudyn's main system, not yet assembled.
        ground: object number of the frame.
        ground_node: node number of the frame.
        still: marker of a coordinate of the frame.
        bodies: name -> object number.
        nodes: name -> node number.
        rigid: name -> rigid body.
        flexible: name -> flexible body.
        carriers: (slot or guide of a moving body, flexible body) -> name of the rigid disc that
            moves with the body's face there.
        forces: (name, quantity) -> number of the object that exerts a recorded force or moment.
        sensors: (name, quantity) -> sensor number.
        clearance_joints: name -> joint.
        guideways: name of a guide with clearance -> the contacts of a body's two ends, and the film
            where there is one.
        states: of clearance joints and guideways at the steps of the last run.
    """

    states: States

    def __init__(self, scene: Scene, parts: Mapping[str, "PlacedPart"]) -> None:
        self.scene, self.parts = scene, parts
        solids = {name: (placed.reduced.mass, placed.inertia) for name, placed in parts.items()}
        self.mechanism = mechanism_of(scene)
        if scene.guides:
            from exu_press.scene.guides import with_elastic_guides

            self.mechanism = with_elastic_guides(self.mechanism, scene.guides, solids)
        bodies = _beside_flexible(scene, self.mechanism) | _guided_bodies(scene, self.mechanism)
        constraints = independent_constraints(self.mechanism, scene.joints.ideal)
        self.constraints = with_all_coordinates(constraints, self.mechanism, bodies)
        self.ideal = self.mechanism.motion(np.array([scene.start_angle]), scene.start_speed)
        self.applied_loads = {
            name: replace(load, point=parts[load.body].middles.get(name, load.point))
            if load.body in parts
            else load
            for name, load in scene.applied_loads.items()
        }
        self.clocks: list[tuple[Any, Callable[[float], tuple[float, float]]]] = []
        self.ahead = [0.0]
        self.SC = exu.SystemContainer()
        self.mbs = self.SC.AddSystem()
        self.ground = int(self.mbs.AddObject(ObjectGround()))
        self.ground_node = int(self.mbs.AddNode(NodePointGround()))
        self.bodies = {GROUND: self.ground}
        self.nodes: dict[str, int] = {}
        self.rigid: dict[str, RigidBody] = {}
        self.flexible: dict[str, FlexibleBody] = {}
        self.carriers = {
            (guide, body): self.mechanism.guide(guide).disc_of(body)
            for body, placed in parts.items()
            for guide in placed.carriers
        }
        self.forces: dict[tuple[str, str], int] = {}
        self.sensors: dict[tuple[str, str], int] = {}
        self.clearance_joints: dict[str, ClearanceJoint] = {}
        self.guideways: dict[str, tuple[ClearanceJoint, ...]] = {}
        still = MarkerNodeCoordinate(nodeNumber=self.ground_node, coordinate=0)
        self.still = self.mbs.AddMarker(still)

    def add_rigid(self, name: str, body: RigidBody) -> None:
        """Register a rigid body under its name."""
        self.rigid[name] = body
        self.bodies[name], self.nodes[name] = body.number, body.node

    def marker(self, body: str, point: Point) -> int:
        """Add a marker on a rigid body or the frame."""
        number, local = self.end(body, point)
        marker = MarkerBodyRigid(bodyNumber=number, localPosition=[*local, 0.0])
        return int(self.mbs.AddMarker(marker))

    def end(self, body: str, point: Point, joint: Joint | None = None) -> Any:
        """Return the end of a joint, or of guideways, at a point of a body's frame, m.

        Of a rigid body or the frame that is the number of its object, and the point in that.
        """
        if body not in self.flexible:
            return self.bodies[body], point if body == GROUND else self.rigid[body].local(point)
        placed, flexible = self.parts[body], self.flexible[body]
        if joint is None:
            return placed.guide_end(flexible, point)
        return placed.joint_end(flexible, joint, point)

    def frame_angle(self, body: str) -> float:
        """Return the angle of a body's frame in that of Exudyn's object, rad."""
        return self.rigid[body].frame_angle if body in self.rigid else 0.0

    def in_guide(self, guide: Guide) -> tuple[str, str]:
        """Return both rigid bodies of a slot or moving guide: a flexible body's is its disc."""
        both = guide.body, guide.on
        guided, on = (self.carriers.get((guide.name, body), body) for body in both)
        return guided, on

    def joint_marker(self, joint: Joint, body: str, point: Point) -> int:
        """Add a marker for a joint; on a flexible body it follows its faces' mean motion."""
        if body not in self.flexible:
            return self.marker(body, point)
        points = self.parts[body].joint_points(joint.name)
        return self.flexible[body].add_point_marker(self.mbs, *(point for _, point in points))

    def coordinate(self, body: str, coordinate: str) -> int:
        """Return a marker of a rigid body's "x", "y" or "angle", or of one that stands still."""
        if body == GROUND or coordinate not in self.rigid[body].coordinates:
            return int(self.still)
        rigid = self.rigid[body]
        number = rigid.coordinates.index(coordinate)
        marker = MarkerNodeCoordinate(nodeNumber=rigid.node, coordinate=number)
        return int(self.mbs.AddMarker(marker))

    def hold(self, body: str, coordinate: str, on: str = GROUND, **options: Any) -> int:
        """Hold a rigid body's coordinate by a constraint, relative to another body's."""
        markers = [self.coordinate(on, coordinate), self.coordinate(body, coordinate)]
        return int(self.mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers, **options)))

    def record(
        self,
        name: str,
        quantity: str,
        number: int,
        output: exu.OutputVariableType = exu.OutputVariableType.Force,
    ) -> None:
        """Record the output of an object over the run, as that of a name and a quantity."""
        sensor = SensorObject(objectNumber=number, storeInternal=True, outputVariableType=output)
        self.sensors[name, quantity] = int(self.mbs.AddSensor(sensor))
        self.forces[name, quantity] = number

    def spring(self, body: str, coordinate: str, spring: Spring) -> int:
        """Hold a rigid body's coordinate by a spring and damper."""
        connector = ObjectConnectorCoordinateSpringDamper(
            markerNumbers=[self.still, self.coordinate(body, coordinate)],
            stiffness=spring.stiffness,
            damping=spring.damping,
        )
        return int(self.mbs.AddObject(connector))


def _guided_bodies(scene: Scene, mechanism: Mechanism) -> frozenset[str]:
    """Return the bodies of guides that need all their coordinates.

    These are flexible ones, those that rub, and those of moving guides that give way.
    """
    rubbing = {name for name, guide in scene.guides.items() if guide.rubs}
    return frozenset(
        body
        for guide in mechanism.guides
        for body in guide.bodies - {GROUND}
        if guide.name in rubbing
        or body in scene.bodies
        or not (guide.is_rail or guide.holds_across)
    )


def _beside_flexible(scene: Scene, mechanism: Mechanism) -> frozenset[str]:
    """Return the rigid bodies that a joint with clearance connects to flexible ones.

    Such joints are spatial, so these bodies need all their coordinates.
    """
    pairs = (
        {joint.journal, joint.bearing}
        for joint in mechanism.joints
        if joint.name not in scene.joints.ideal
    )
    neighbours = (pair for pair in pairs if pair & scene.bodies.keys())
    return frozenset().union(*neighbours) - scene.bodies.keys()
