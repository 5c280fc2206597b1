"""The springs of a system."""

from typing import Any

import exudyn as exu
from exudyn.itemInterface import ObjectConnectorSpringDamper

from exu_press.mechanism.parts import Point
from exu_press.mechanism.spring_motion import joint_at, spring_ends
from exu_press.mechanism.springs import LinearSpring, SpringBetween
from exu_press.model.system import System

__all__ = ["add_spring"]


def add_spring(system: System, spring: SpringBetween) -> None:
    """Add a spring, and record the vector between its ends and its rate.

    Exudyn's force, unlike ours, counts positive where it pulls. That of a gas spring is
    differentiated numerically for Newton's method.
    """
    law: dict[str, Any]
    if isinstance(spring, LinearSpring):
        law = {"stiffness": spring.stiffness, "force": -spring.static_force(spring.drawn_length)}
    else:
        law = {"springForceUserFunction": _pull(spring)}
    ends = zip(spring_ends(system.mechanism, spring), spring.at, strict=True)
    connector = ObjectConnectorSpringDamper(
        name=f"spring_{spring.name}",
        markerNumbers=[_marker(system, *end, at) for end, at in ends],
        referenceLength=spring.drawn_length,
        damping=spring.damping,
        **law,
    )
    number = system.mbs.AddObject(connector)
    system.record(connector.name, "ends", number, exu.OutputVariableType.Displacement)
    system.record(connector.name, "velocity", number, exu.OutputVariableType.Velocity)


def _pull(spring: SpringBetween) -> Any:
    """Return Exudyn's function of a spring's tension, N."""

    def pull(
        mbs: Any, t: float, item: int, elongation: float, rate: float, k: float, d: float, f: float
    ) -> float:
        return -float(spring.force(spring.drawn_length + elongation, rate))

    return pull


def _marker(system: System, body: str, point: Point, at: Point) -> int:
    """Add a marker on an end; on a flexible body it follows the faces of the joint there."""
    if body not in system.flexible:
        return system.marker(body, point)
    joint = joint_at(system.mechanism, body, at)
    assert joint is not None  # the scene has checked it
    return system.joint_marker(joint, body, point)
