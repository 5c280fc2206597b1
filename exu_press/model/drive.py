"""The drive of the crank, and the gears that turn with it."""

from collections.abc import Callable
from typing import Any

import exudyn as exu
from exudyn.itemInterface import (
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateSpringDamper,
)

from exu_press.mechanism import Gear
from exu_press.mechanism.parts import DRIVE, FLYWHEEL
from exu_press.model.system import System

__all__ = [
    "CrankAngle",
    "add_drive",
    "add_gear",
    "crank_angle_of",
    "turned_body",
]

CrankAngle = Callable[[], tuple[float, float]]
"""Angle, rad, and angular velocity, rad/s, of the driven body in the current state."""


def add_drive(system: System) -> None:
    """Drive the crank: by a constraint on its angular velocity, or by a motor's torque.

    Exudyn differentiates the torque of the motor's connector numerically for Newton's method.
    """
    scene, turned = system.scene, turned_body(system)
    if scene.drive is None:
        number = system.hold(turned, "angle", velocityLevel=True, offset=scene.angular_speed)
        system.record("drive", "force", number)
        return
    law = scene.drive.torque.law(scene.speed_rpm)

    def negative_torque(
        mbs: Any, t: float, item: int, angle: float, speed: float, k: float, d: float, zero: float
    ) -> float:
        return -law(speed)[0]

    function: Any = negative_torque
    motor = ObjectConnectorCoordinateSpringDamper(
        markerNumbers=[
            system.still,
            system.coordinate(FLYWHEEL if FLYWHEEL in system.rigid else turned, "angle"),
        ],
        springForceUserFunction=function,
    )
    system.record("drive", "force", system.mbs.AddObject(motor))


def add_gear(system: System, gear: Gear) -> None:
    """Hold the angles of two rigid bodies in their ratio; a flexible crank's is that of its disc.

    The force of the constraint is the torque on the geared body, N m.
    """
    to = turned_body(system) if gear.to == system.mechanism.crank else gear.to
    constraint = ObjectConnectorCoordinate(
        markerNumbers=[system.coordinate(gear.body, "angle"), system.coordinate(to, "angle")],
        factor1=gear.ratio,
    )
    system.record(f"gear_{gear.name}", "torque", system.mbs.AddObject(constraint))


def turned_body(system: System) -> str:
    """Return the rigid body that the drive turns: the crank, or a flexible crank's disc."""
    crank = system.mechanism.crank
    return DRIVE if crank in system.flexible else crank


def crank_angle_of(system: System) -> CrankAngle:
    """Return the function of the crank's angle from the mechanism's zero and its velocity."""
    data: Any = system.mbs.systemData
    turned, current = system.rigid[turned_body(system)], exu.ConfigurationType.Current
    column = turned.coordinates.index("angle")
    zero = float(turned.reference[2]) - system.mechanism.body(system.mechanism.crank).angle
    index: list[int] = []  # among all coordinates: not known before the system is assembled

    def angle() -> tuple[float, float]:
        if not index:
            index.append(system.mbs.GetNodeODE2Index(turned.node) + column)
        q = data.GetODE2Coordinates(current, False)[index[0]]
        return zero + float(q), float(data.GetODE2Coordinates_t(current, False)[index[0]])

    return angle
