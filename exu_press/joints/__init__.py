"""Clearance joints: the only place where a law meets Exudyn."""

from exu_press.joints.add import (
    add_dry_revolute,
    add_dry_spherical,
    add_joint_sensor,
    add_lubricated_revolute,
    add_ways_contact,
)
from exu_press.joints.compiled import COMPILED
from exu_press.joints.ends import FlexiblePoint
from exu_press.joints.joint import ClearanceJoint, JointState, history
from exu_press.joints.overlay import overlay_of

__all__ = [
    "COMPILED",
    "ClearanceJoint",
    "FlexiblePoint",
    "JointState",
    "add_dry_revolute",
    "add_dry_spherical",
    "add_joint_sensor",
    "add_lubricated_revolute",
    "add_ways_contact",
    "history",
    "overlay_of",
]
