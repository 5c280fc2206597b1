"""From a scene to an assembled Exudyn system: only what the scene uses is built."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    LoadCoordinate,
    LoadForceVector,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    MarkerNodeCoordinates,
    NodePointGround,
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateSpringDamper,
    ObjectConnectorCoordinateVector,
    ObjectConnectorLinearSpringDamper,
    ObjectGround,
    ObjectJointGeneric,
    ObjectJointRevolute2D,
    SensorLoad,
    SensorNode,
    SensorObject,
)
from exudyn.rigidBodyUtilities import RotationMatrixZ
from numpy.typing import NDArray

from exu_press.integrate import Outcome, Tuning
from exu_press.joints import (
    ClearanceJoint,
    add_dry_revolute,
    add_dry_spherical,
    add_lubricated_revolute,
)
from exu_press.laws.blanking import blanking_force
from exu_press.laws.friction import no_friction
from exu_press.mechanism import (
    GROUND,
    Body,
    Guide,
    Joint,
    Mechanism,
    Motion,
    Point,
    Spring,
)
from exu_press.mechanism.holding import HalfHeld, Holding, holding_of
from exu_press.quasi_static import quasi_static_motion
from exu_press.rigid import PivotedBody, RigidBody, SlidingBody
from exu_press.scene import DryJoint, IdealJoint, LubricatedJoint, Scene, mechanism_of
from exu_press.scene.laws import contact_law, film_law, friction_law
from exu_press.solving import DEFAULTS, solve

if TYPE_CHECKING:
    from exu_press.flexible import FrameStart
    from fe_models import FlexibleBody, ReducedPart

__all__ = ["DRIVE", "Model", "build"]

Array = NDArray[np.float64]

DRIVE = "drive"
"""Name of the disc that turns a flexible crank at its flange."""


@dataclass(frozen=True)
class Model:
    """An assembled system and what its items are called.

    Attributes:
        scene: what was asked.
        mechanism: bodies, joints and guides.
        SC: Exudyn's system container.
        mbs: Exudyn's main system, assembled.
        bodies: name -> object number.
        nodes: name -> node number.
        rigid: name -> rigid body.
        clearance_joints: name -> joint.
        ideal_joints: name -> object number; those that hold a coordinate.
        drive: object number of the constraint that turns the crank.
        parts: name -> flexible body's part; empty for rigid bodies.
        sensors: (name, quantity) -> sensor number.
        made: number of objects and loads that the scene was made of.
    """

    scene: Scene
    mechanism: Mechanism
    SC: exu.SystemContainer
    mbs: exu.MainSystem
    bodies: dict[str, int]
    nodes: dict[str, int]
    clearance_joints: dict[str, ClearanceJoint]
    ideal_joints: dict[str, int]
    rigid: Mapping[str, RigidBody]
    drive: int
    sensors: dict[tuple[str, str], int]
    parts: Mapping[str, "ReducedPart"]
    made: int

    @property
    def own_items(self) -> int:
        """Number of objects and loads that the user has added since."""
        return _items(self.mbs) - self.made

    @property
    def holding(self) -> Holding:
        """Which ideal joints and guides hold what."""
        return holding_of(self.mechanism, self.scene.joints.ideal)

    def solve(self, *, tuning: Tuning = DEFAULTS, quiet: bool = True) -> Outcome:
        """Run to the end time or to an early stop; what was computed stays in the sensors.

        Items that were added to `mbs` since, and assembled, take part.
        `exu_press.result.record(model, outcome)` makes a result of it.

        Args:
            tuning: the numbers of step control, to vary them.
            quiet: False shows the progress on standard error.
        """
        return solve(self, tuning=tuning, quiet=quiet)

    def next_corner(self, time: float) -> float:
        """Return the next instant at which the blanking force has a corner, s, or infinity."""
        pulse = self.scene.blanking
        if pulse is None or pulse.force == 0.0:
            return math.inf
        period, begin = _pulse_period(self.scene)
        corners = (0.0, pulse.rise, pulse.rise + pulse.fall)
        since = [(time - begin - corner) / period for corner in corners]
        return min(
            begin + corner + period * (math.floor(turns + 1e-9) + 1)
            for corner, turns in zip(corners, since, strict=True)
        )


class _Builder:
    """Puts a mechanism's parts into a new system, one kind after the other."""

    def __init__(self, scene: Scene, parts: Mapping[str, "ReducedPart"]) -> None:
        self.scene, self.parts = scene, parts
        self.flexible: dict[str, FlexibleBody] = {}
        self.mechanism = mechanism_of(scene)
        self.holding = holding_of(self.mechanism, scene.joints.ideal)
        angle = np.array([scene.start_angle])
        self.ideal = self.mechanism.motion(angle, scene.angular_speed)
        self.start = dict(self.ideal)
        self.frames: dict[str, FrameStart] = {}
        self.SC = exu.SystemContainer()
        self.mbs = self.SC.AddSystem()
        self.ground = int(self.mbs.AddObject(ObjectGround()))
        self.bodies = {GROUND: self.ground}
        self.nodes: dict[str, int] = {}
        self.rigid: dict[str, RigidBody] = {}
        self.sensors: dict[tuple[str, str], int] = {}
        self.local_forces: set[int] = set()
        self.ground_node = int(self.mbs.AddNode(NodePointGround()))
        still = MarkerNodeCoordinate(nodeNumber=self.ground_node, coordinate=0)
        self.still = self.mbs.AddMarker(still)

    def add_bodies(self) -> None:
        """Add every body in the ideal mechanism's position and velocity."""
        for body in self.mechanism.bodies:
            start = self.start[body.name]
            if body.name in self.parts:
                self._add_flexible_body(body.name, start)
                continue
            self._add_rigid_body(body, start)
            if self.scene.gravity > 0.0:
                weight = [0.0, -body.mass * self.scene.gravity, 0.0]
                centre = self._marker(body.name, (0.0, 0.0))
                self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))

    def _add_rigid_body(self, body: Body, start: Motion) -> None:
        """Add a rigid body with the coordinates that its ideal joints leave it."""
        pivot = self.holding.pivoted.get(body.name)
        relaxed = self.ideal[body.name].position[0]
        if pivot is not None:
            place = body.local(pivot.at)
            added: RigidBody = PivotedBody(self.mbs, body, start, pivot.at, place, relaxed)
        elif body.name in self.holding.sliding:
            guide = next(guide for guide in self.mechanism.guides if guide.body == body.name)
            added = SlidingBody(self.mbs, body, start, guide.direction, relaxed)
        else:
            added = RigidBody(self.mbs, body, start, relaxed)
        self._take_in(body.name, added)

    def _take_in(self, name: str, added: RigidBody) -> None:
        """Remember a rigid body by its name."""
        self.rigid[name] = added
        self.bodies[name], self.nodes[name] = added.number, added.node

    def _add_flexible_body(self, name: str, start: Motion) -> None:
        """Add a flexible body; its frame lies where the solid's does, not in the centre of mass."""
        from exu_press.flexible import MAIN_BEARINGS, add_part, undeformed

        assert self.scene.press is not None
        offset = self._in_frame(name, (0.0, 0.0))
        frame = start.at((-offset[0], -offset[1]))
        joints = {
            joint.name: self._in_frame(name, point)
            for joint in self.mechanism.joints
            for body, point in self.mechanism.ends(joint)
            if body == name and joint.name != "shaft"
        }
        if name == self.mechanism.crank:
            joints |= dict.fromkeys(MAIN_BEARINGS, (0.0, 0.0))
        begin = self.frames.get(name) or undeformed(frame)
        body = add_part(self.mbs, self.scene, name, self.parts[name], begin, joints)
        self.flexible[name] = body
        self.bodies[name], self.nodes[name] = body.object_number, body.node_rigid
        if body.node_modes is not None:
            self.nodes[f"{name}_modes"] = body.node_modes

    def start_deformed(self, ideal: "_Builder") -> None:
        """Start every body as the mechanism with ideal joints moves when its vibrations are over.

        Args:
            ideal: about to build that mechanism.
        """
        from exu_press.flexible import deformed

        model = ideal.build()
        drive = model.mbs.GetNodeODE2Index(model.nodes[DRIVE])
        speed = self.scene.angular_speed
        state = quasi_static_motion(model.mbs, model.drive, drive, speed)

        def parts_of(node: int) -> Iterator[Array]:
            places = model.mbs.systemData.GetNodeLTGODE2(node)
            return (values[places] for values in state)

        for name, rigid in model.rigid.items():
            q, q_t = (values[None, :] for values in parts_of(rigid.node))
            self.start[name] = rigid.motion(q, q_t, np.zeros_like(q))
        for name, body in ideal.flexible.items():
            assert body.node_modes is not None
            frame, modes = parts_of(body.node_rigid), parts_of(body.node_modes)
            self.frames[name] = deformed(model.mbs, body, *frame, *modes)

    def hold_flexible_bodies(self) -> dict[str, int]:
        """Hold crank and linkage in space; the crank is driven at its flange by a disc."""
        from exu_press.flexible import hold_crank, hold_linkage

        crank = self.ideal[self.mechanism.crank]
        shaft = self._in_frame(self.mechanism.crank, (0.0, 0.0))
        start = crank.at((-shaft[0], -shaft[1]))
        disc = PivotedBody(self.mbs, Body(DRIVE, 1.0, 1.0), start, (0.0, 0.0), (0.0, 0.0))
        self._take_in(DRIVE, disc)
        slide = self._marker("slide", (0.0, 0.0))
        hold_linkage(self.mbs, slide, self.flexible["linkage"])
        disc_marker = self._marker(DRIVE, (0.0, 0.0))
        return hold_crank(self.mbs, self.ground, self.flexible["crank"], disc_marker)

    def add_ideal_joint(self, joint: Joint) -> int:
        """Add a revolute joint, or what holds the one direction that nothing else holds."""
        half = self.holding.half_held.get(joint.name)
        if half is not None:
            return self._hold_half(joint, half)
        markers = [self._point(joint, *end) for end in self.mechanism.ends(joint)]
        return int(
            self.mbs.AddObject(ObjectJointRevolute2D(name=joint.name, markerNumbers=markers))
        )

    def add_clearance_joint(self, joint: Joint, kind: DryJoint | LubricatedJoint) -> ClearanceJoint:
        """Add a joint with clearance."""
        journal, bearing = (self._end(joint, *end) for end in self.mechanism.ends(joint))
        contact = None
        if kind.contact is not None:
            contact = contact_law(kind.contact, kind.clearance, revolute=not joint.spherical)
        friction = no_friction() if kind.friction is None else friction_law(kind.friction)
        if isinstance(kind, DryJoint):
            assert contact is not None
            add = add_dry_spherical if joint.spherical else add_dry_revolute
            return add(
                self.mbs,
                journal,
                bearing,
                radius=kind.radius,
                clearance=kind.clearance,
                contact=contact,
                friction=friction,
            )
        return add_lubricated_revolute(
            self.mbs,
            journal,
            bearing,
            radius=kind.radius,
            clearance=kind.clearance,
            length=kind.film.length,
            viscosity=kind.film.viscosity,
            law=film_law(kind.film, kind.radius, kind.clearance),
            contact=contact,
            friction=friction,
            asperity_onset=kind.onset or 0.0,
        )

    def add_guide(self, guide: Guide) -> dict[str, int]:
        """Hold the way across a guide and the angle, by constraints or springs.

        Returns:
            "force" and "moment", as far as it holds them, -> object number.
        """
        holds_across, holds_angle = self.holding.guides[guide.body]
        added = {}
        if guide.lateral is not None:
            added["force"] = self._lateral_spring(guide, guide.lateral)
        elif holds_across:
            added["force"] = self._hold_across(guide)
        if guide.tilting is not None:
            added["moment"] = self._spring(guide.body, "angle", guide.tilting)
        elif holds_angle:
            added["moment"] = self._hold(guide.body, "angle")
        return added

    def add_drive(self) -> int:
        """Turn the crank at constant speed, by a constraint on its angular velocity."""
        turned = DRIVE if self.flexible else self.mechanism.crank
        return self._hold(turned, "angle", velocityLevel=True, offset=self.scene.angular_speed)

    def add_blanking(self) -> None:
        """Press the slider in its direction once a revolution, at a place of the frame."""
        pulse = self.scene.blanking
        if pulse is None or pulse.force == 0.0:
            return
        period, begin = _pulse_period(self.scene)
        slider, direction = self.mechanism.slider, self.mechanism.output.direction

        def force(mbs: exu.MainSystem, t: float, load: float) -> float:
            return blanking_force((t - begin) % period, pulse.force, pulse.rise, pulse.fall)

        def along(mbs: exu.MainSystem, t: float, load: Any) -> list[float]:
            size = force(mbs, t, 0.0)
            return [size * direction[0], size * direction[1], 0.0]

        vector: Any = along

        def moment(mbs: exu.MainSystem, t: float, load: float) -> float:
            return pulse.eccentricity * force(mbs, t, load)

        upwards = direction == (0.0, 1.0) and "y" in self.rigid[slider].coordinates
        if upwards:
            pressed: Any = LoadCoordinate(
                markerNumber=self._coordinate(slider, "y"), load=0.0, loadUserFunction=force
            )
        else:
            pressed = LoadForceVector(
                markerNumber=self._marker(slider, (0.0, 0.0)), loadVectorUserFunction=vector
            )
        number = self.mbs.AddLoad(pressed)
        if pulse.eccentricity != 0.0 and "angle" in self.rigid[slider].coordinates:
            turned = self._coordinate(slider, "angle")
            self.mbs.AddLoad(LoadCoordinate(markerNumber=turned, load=0.0, loadUserFunction=moment))
        self.sensors["blanking", "force"] = self.mbs.AddSensor(
            SensorLoad(loadNumber=number, storeInternal=True)
        )

    def add_sensors(self, joints: dict[str, int], guides: dict[str, dict[str, int]]) -> None:
        """Record bodies' coordinates and the constraints' forces in memory, every step."""
        levels = {
            "position": exu.OutputVariableType.Coordinates,
            "velocity": exu.OutputVariableType.Coordinates_t,
            "acceleration": exu.OutputVariableType.Coordinates_tt,
        }
        for name, node in self.nodes.items():
            for level, output in levels.items():
                self.sensors[name, level] = self.mbs.AddSensor(
                    SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=output)
                )
        forces = {(name, "force"): number for name, number in joints.items()}
        for body, numbers in guides.items():
            forces |= {(f"{body}_guide", kind): number for kind, number in numbers.items()}
        for key, number in forces.items():
            self.sensors[key] = self.mbs.AddSensor(
                SensorObject(
                    objectNumber=number,
                    storeInternal=True,
                    outputVariableType=exu.OutputVariableType.ForceLocal
                    if number in self.local_forces
                    else exu.OutputVariableType.Force,
                )
            )

    def build(self) -> Model:
        """Put everything together."""
        self.add_bodies()
        clearance = {
            joint.name: self.add_clearance_joint(joint, kind)
            for joint in self.mechanism.joints
            if not isinstance(kind := self.scene.joints[joint.name], IdealJoint)
        }
        held = {*self.holding.joints, *self.holding.half_held}
        ideal = {
            joint.name: self.add_ideal_joint(joint)
            for joint in self.mechanism.joints
            if joint.name in held
        }
        if self.flexible:
            ideal |= self.hold_flexible_bodies()
        guides = {
            guide.body: self.add_guide(guide)
            for guide in self.mechanism.guides
            if guide.body not in self.holding.sliding
        }
        drive = self.add_drive()
        self.add_blanking()
        self.add_sensors(ideal | {"drive": drive}, guides)
        self.mbs.Assemble()
        return Model(
            scene=self.scene,
            mechanism=self.mechanism,
            SC=self.SC,
            mbs=self.mbs,
            bodies=self.bodies,
            nodes=self.nodes,
            rigid=self.rigid,
            clearance_joints=clearance,
            ideal_joints=ideal,
            drive=drive,
            sensors=self.sensors,
            parts=self.parts,
            made=_items(self.mbs),
        )

    def _marker(self, body: str, point: Point) -> int:
        """Add a marker on a rigid body."""
        local = point if body == GROUND else self.rigid[body].local(point)
        marker = MarkerBodyRigid(bodyNumber=self.bodies[body], localPosition=[*local, 0.0])
        return int(self.mbs.AddMarker(marker))

    def _point(self, joint: Joint, body: str, point: Point) -> int:
        """Add a marker for a joint; on a flexible body it follows the interface's mean motion."""
        if body not in self.flexible:
            return self._marker(body, point)
        return self.flexible[body].add_point_marker(self.mbs, joint.name)

    def _in_frame(self, body: str, point: Point) -> Point:
        """Return a point given from the centre of mass in the frame of a flexible body's solid."""
        size = self.scene.press
        assert size is not None
        if body == self.mechanism.crank:
            return point[0], point[1] + size.crank_mass_offset
        return point[0] + size.linkage_mass_offset, point[1]

    def _end(self, joint: Joint, body: str, point: Point) -> Any:
        """Return what a clearance joint holds on to."""
        if body == GROUND:
            return self.ground, point
        if body not in self.flexible:
            return self.bodies[body], self.rigid[body].local(point)
        from exu_press.flexible import FACES, joint_end

        face = FACES[body, joint.name]
        return joint_end(self.flexible[body], face, self._in_frame(body, point))

    def _hold_half(self, joint: Joint, half: HalfHeld) -> int:
        """Hold a joint's two bodies together in one direction, which turns with one of them."""
        journal, bearing = self.mechanism.ends(joint)
        (body, point), end = (
            (journal, bearing) if half.body == joint.journal else (bearing, journal)
        )
        place, angle = point, half.angle
        if body != GROUND:
            place, angle = self.rigid[body].local(point), angle + self.rigid[body].turned
        frame = exu.HT().Set(RotationMatrixZ(angle), [*place, 0.0])
        along = self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.bodies[body], localHT=frame))
        number = self.mbs.AddObject(
            ObjectJointGeneric(
                name=joint.name,
                markerNumbers=[along, self._point(joint, *end)],
                constrainedAxes=[1, 0, 0, 0, 0, 0],
            )
        )
        self.local_forces.add(int(number))
        return int(number)

    def _hold_across(self, guide: Guide) -> int:
        """Hold a body across its guide; linear in the coordinates, and exact."""
        rigid = self.rigid[guide.body]
        place = np.dot(self.mechanism.body(guide.body).centre_of_mass, guide.across)
        row = dict(zip(("x", "y", "angle"), (*guide.across, 0.0), strict=True))
        return int(
            self.mbs.AddObject(
                ObjectConnectorCoordinateVector(
                    markerNumbers=[
                        self.mbs.AddMarker(MarkerNodeCoordinates(nodeNumber=node))
                        for node in (self.ground_node, rigid.node)
                    ],
                    scalingMarker0=[],
                    scalingMarker1=[[row[coordinate] for coordinate in rigid.coordinates]],
                    offset=[float(place)],
                )
            )
        )

    def _lateral_spring(self, guide: Guide, spring: Spring) -> int:
        """Add a spring across a guide, relaxed where the body starts."""
        body = guide.body
        start = self.ideal[body].position[0]
        place = MarkerBodyRigid(bodyNumber=self.ground, localPosition=[start[0], start[1], 0.0])
        number = self.mbs.AddObject(
            ObjectConnectorLinearSpringDamper(
                markerNumbers=[self.mbs.AddMarker(place), self._marker(body, (0.0, 0.0))],
                stiffness=spring.stiffness,
                damping=spring.damping,
                axisMarker0=[*guide.across, 0.0],
            )
        )
        self.local_forces.add(int(number))
        return int(number)

    def _coordinate(self, body: str, coordinate: str) -> int:
        rigid = self.rigid[body]
        number = rigid.coordinates.index(coordinate)
        marker = MarkerNodeCoordinate(nodeNumber=rigid.node, coordinate=number)
        return int(self.mbs.AddMarker(marker))

    def _hold(self, body: str, coordinate: str, **options: Any) -> int:
        return int(
            self.mbs.AddObject(
                ObjectConnectorCoordinate(
                    markerNumbers=[self.still, self._coordinate(body, coordinate)], **options
                )
            )
        )

    def _spring(self, body: str, coordinate: str, spring: Spring) -> int:
        return int(
            self.mbs.AddObject(
                ObjectConnectorCoordinateSpringDamper(
                    markerNumbers=[self.still, self._coordinate(body, coordinate)],
                    stiffness=spring.stiffness,
                    damping=spring.damping,
                )
            )
        )


def _items(mbs: exu.MainSystem) -> int:
    """Return the number of objects and loads of a system."""
    return int(mbs.systemData.NumberOfObjects() + mbs.systemData.NumberOfLoads())


def _pulse_period(scene: Scene) -> tuple[float, float]:
    """Return the time between two blanking pulses and the begin of one of them, s."""
    pulse, period = scene.blanking, 60.0 / scene.speed_rpm
    assert pulse is not None
    end = (pulse.end_angle_deg - scene.start_angle_deg) / 360.0 * period
    return period, end - pulse.rise - pulse.fall


def build(scene: Scene, *, quiet: bool = True) -> Model:
    """Return the assembled Exudyn model of a scene, on the ideal mechanism's start.

    Flexible bodies start in the deformation, and its rate, that this motion asks for.

    Args:
        scene: what is asked.
        quiet: False shows the progress of what takes long, the modes of flexible bodies.
    """
    parts: Mapping[str, ReducedPart] = {}
    if scene.flexible is not None:
        from exu_press.flexible import reduced_parts

        parts = reduced_parts(scene, quiet=quiet)
    builder = _Builder(scene, parts)
    if any(part.mode_count for part in parts.values()):
        ideal = scene.replace({f"joints.{name}": "ideal" for name in scene.joints.with_clearance})
        builder.start_deformed(_Builder(ideal, parts))
    return builder.build()
