"""From a scene to an assembled Exudyn system: only what the scene uses is built."""

import math
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    LoadCoordinate,
    LoadMassProportional,
    MarkerBodyMass,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    MarkerNodeCoordinates,
    NodePointGround,
    NodeRigidBody2D,
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateVector,
    ObjectGround,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
    SensorLoad,
    SensorNode,
    SensorObject,
)

from exu_press.joints import (
    ClearanceJoint,
    add_dry_revolute,
    add_dry_spherical,
    add_lubricated_revolute,
)
from exu_press.laws.blanking import blanking_force
from exu_press.laws.friction import no_friction
from exu_press.mechanism import GROUND, Guide, Joint, Mechanism, mechanism_of
from exu_press.scene import Scene
from exu_press.scene.laws import asperity_onset, contact_law, film_law, friction_law

__all__ = ["Model", "build"]


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
        clearance_joints: name -> joint.
        ideal_joints: name -> object number.
        guides: name of the body -> object numbers of what holds x and, if held, the angle.
        drive: object number of the constraint that turns the crank.
        sensors: (name, quantity) -> sensor number.
    """

    scene: Scene
    mechanism: Mechanism
    SC: exu.SystemContainer
    mbs: exu.MainSystem
    bodies: dict[str, int]
    nodes: dict[str, int]
    clearance_joints: dict[str, ClearanceJoint]
    ideal_joints: dict[str, int]
    guides: dict[str, tuple[int, ...]]
    drive: int
    sensors: dict[tuple[str, str], int]

    def joint_clearances(self) -> list[tuple[ClearanceJoint, float]]:
        """Return every clearance joint with its radial clearance, m."""
        sizes = self.scene.clearance
        return [
            (joint, getattr(sizes, "balls" if name.startswith("ball") else name))
            for name, joint in self.clearance_joints.items()
        ]

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

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.mechanism = mechanism_of(scene)
        self.SC = exu.SystemContainer()
        self.mbs = self.SC.AddSystem()
        self.ground = int(self.mbs.AddObject(ObjectGround()))
        self.bodies = {GROUND: self.ground}
        self.nodes: dict[str, int] = {}
        self.sensors: dict[tuple[str, str], int] = {}
        ground_node = self.mbs.AddNode(NodePointGround())
        self.still = self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=ground_node, coordinate=0))

    def add_bodies(self) -> None:
        """Add every body in the ideal mechanism's position and velocity."""
        angle = np.array([self.scene.start_angle])
        motion = self.mechanism.motion(angle, self.scene.angular_speed)
        for body in self.mechanism.bodies:
            start = motion[body.name]
            node = self.mbs.AddNode(
                NodeRigidBody2D(
                    name=body.name,
                    referenceCoordinates=start.position[0],
                    initialVelocities=start.velocity[0],
                )
            )
            number = self.mbs.AddObject(
                ObjectRigidBody2D(
                    name=body.name, nodeNumber=node, mass=body.mass, inertia=body.inertia
                )
            )
            self.nodes[body.name], self.bodies[body.name] = int(node), int(number)
            if self.scene.gravity > 0.0:
                self.mbs.AddLoad(
                    LoadMassProportional(
                        markerNumber=self.mbs.AddMarker(MarkerBodyMass(bodyNumber=number)),
                        loadVector=[0.0, -self.scene.gravity, 0.0],
                    )
                )

    def add_ideal_joint(self, joint: Joint) -> int:
        """Add a revolute joint, or what holds a ball of a guided body in a guided body."""
        if joint.vertical_only:
            return self._hold_vertically(joint)
        markers = [
            self._point(joint.journal, joint.journal_point),
            self._point(joint.bearing, joint.bearing_point),
        ]
        return int(
            self.mbs.AddObject(ObjectJointRevolute2D(name=joint.name, markerNumbers=markers))
        )

    def add_clearance_joint(self, joint: Joint) -> ClearanceJoint:
        """Add a joint with clearance."""
        scene = self.scene
        assert scene.clearance is not None
        assert scene.contact is not None
        journal = self.bodies[joint.journal], joint.journal_point
        bearing = self.bodies[joint.bearing], joint.bearing_point
        clearance = scene.clearance.balls if joint.spherical else scene.clearance.crank_pin
        assert clearance is not None
        radius = scene.contact.radius
        contact = contact_law(scene.contact, clearance, revolute=not joint.spherical)
        friction = no_friction() if scene.friction is None else friction_law(scene.friction)
        if joint.kind == "dry":
            add = add_dry_spherical if joint.spherical else add_dry_revolute
            return add(
                self.mbs,
                journal,
                bearing,
                radius=radius,
                clearance=clearance,
                contact=contact,
                friction=friction,
            )
        assert scene.film is not None
        onset = asperity_onset(scene.film)
        return add_lubricated_revolute(
            self.mbs,
            journal,
            bearing,
            radius=radius,
            clearance=clearance,
            length=scene.film.length,
            viscosity=scene.film.viscosity,
            law=film_law(scene.film, radius, clearance),
            contact=None if onset is None else contact,
            friction=friction,
            asperity_onset=onset or 0.0,
        )

    def add_guide(self, guide: Guide) -> tuple[int, ...]:
        """Hold a body's x and, if the guide does so, its angle."""
        held = (0, 2) if guide.holds_angle else (0,)
        return tuple(self._hold(guide.body, coordinate) for coordinate in held)

    def add_drive(self) -> int:
        """Turn the crank at constant speed, by a constraint on its angular velocity."""
        return self._hold(
            self.mechanism.crank, 2, velocityLevel=True, offset=self.scene.angular_speed
        )

    def add_blanking(self) -> None:
        """Press the slider upwards once a revolution."""
        pulse = self.scene.blanking
        if pulse is None or pulse.force == 0.0:
            return
        period, begin = _pulse_period(self.scene)

        def load(mbs: exu.MainSystem, t: float, load: float) -> float:
            return blanking_force((t - begin) % period, pulse.force, pulse.rise, pulse.fall)

        marker = self._coordinate(self.mechanism.slider, 1)
        number = self.mbs.AddLoad(
            LoadCoordinate(markerNumber=marker, load=0.0, loadUserFunction=load)
        )
        self.sensors["blanking", "force"] = self.mbs.AddSensor(
            SensorLoad(loadNumber=number, storeInternal=True)
        )

    def add_sensors(self, joints: dict[str, int], guides: dict[str, tuple[int, ...]]) -> None:
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
            forces |= {
                (f"{body}_guide", kind): n
                for kind, n in zip(("force", "moment"), numbers, strict=False)
            }
        for key, number in forces.items():
            self.sensors[key] = self.mbs.AddSensor(
                SensorObject(
                    objectNumber=number,
                    storeInternal=True,
                    outputVariableType=exu.OutputVariableType.Force,
                )
            )

    def build(self) -> Model:
        """Put everything together."""
        self.add_bodies()
        clearance = {
            joint.name: self.add_clearance_joint(joint)
            for joint in self.mechanism.joints
            if joint.kind != "ideal"
        }
        ideal = {
            joint.name: self.add_ideal_joint(joint)
            for joint in self.mechanism.joints
            if joint.kind == "ideal"
        }
        guides = {guide.body: self.add_guide(guide) for guide in self.mechanism.guides}
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
            clearance_joints=clearance,
            ideal_joints=ideal,
            guides=guides,
            drive=drive,
            sensors=self.sensors,
        )

    def _point(self, body: str, point: tuple[float, float]) -> int:
        return int(
            self.mbs.AddMarker(
                MarkerBodyRigid(bodyNumber=self.bodies[body], localPosition=[*point, 0.0])
            )
        )

    def _hold_vertically(self, joint: Joint) -> int:
        """Hold the y of two guided bodies' points together; the guides hold x already.

        Linear in the coordinates, exact while the guides keep both bodies upright.
        """
        markers, rows = [], []
        for body, (x, _) in (
            (joint.journal, joint.journal_point),
            (joint.bearing, joint.bearing_point),
        ):
            node = self.nodes[body]
            markers.append(self.mbs.AddMarker(MarkerNodeCoordinates(nodeNumber=node)))
            rows.append([[0.0, 1.0, x]])
        return int(
            self.mbs.AddObject(
                ObjectConnectorCoordinateVector(
                    name=joint.name,
                    markerNumbers=markers,
                    scalingMarker0=rows[0],
                    scalingMarker1=rows[1],
                    offset=[joint.journal_point[1] - joint.bearing_point[1]],
                )
            )
        )

    def _coordinate(self, body: str, coordinate: int) -> int:
        return int(
            self.mbs.AddMarker(
                MarkerNodeCoordinate(nodeNumber=self.nodes[body], coordinate=coordinate)
            )
        )

    def _hold(self, body: str, coordinate: int, **options: Any) -> int:
        return int(
            self.mbs.AddObject(
                ObjectConnectorCoordinate(
                    markerNumbers=[self.still, self._coordinate(body, coordinate)], **options
                )
            )
        )


def _pulse_period(scene: Scene) -> tuple[float, float]:
    """Return the time between two blanking pulses and the begin of one of them, s."""
    pulse, period = scene.blanking, 60.0 / scene.speed_rpm
    assert pulse is not None
    end = (pulse.end_angle_deg - scene.start_angle_deg) / 360.0 * period
    return period, end - pulse.rise - pulse.fall


def build(scene: Scene) -> Model:
    """Return the assembled Exudyn model of a scene, on the ideal mechanism's start."""
    return _Builder(scene).build()
