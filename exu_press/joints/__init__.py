"""Clearance joints: the only place where a law meets Exudyn."""

from pathlib import Path

from exu_press.joints import interface
from exu_press.joints.add import (
    add_dry_revolute,
    add_dry_spherical,
    add_guideway_contact,
    add_guideway_film,
    add_joint_sensor,
    add_lubricated_revolute,
    add_lubricated_spherical,
    add_revolute,
)
from exu_press.joints.ends import FlexiblePoint
from exu_press.joints.history import JointHistory, history
from exu_press.joints.joint import ClearanceJoint, JointState
from exu_press.joints.states import States
from exu_press.joints.user_force import holds_joints, user_force_of

__all__ = [
    "COMPILED",
    "ClearanceJoint",
    "FlexiblePoint",
    "JointHistory",
    "JointState",
    "States",
    "add_dry_revolute",
    "add_dry_spherical",
    "add_guideway_contact",
    "add_guideway_film",
    "add_joint_sensor",
    "add_lubricated_revolute",
    "add_lubricated_spherical",
    "add_revolute",
    "history",
    "holds_joints",
    "user_force_of",
]

COMPILED = Path(interface.__file__).suffix != ".py"
"""True where forces and Jacobians are compiled; setup.py compiles the same sources."""
