"""Clearance joints: the only place where a law meets Exudyn. Names are loaded on first access."""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
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
    from exu_press.joints.compiled import COMPILED
    from exu_press.joints.ends import FlexiblePoint
    from exu_press.joints.history import JointHistory
    from exu_press.joints.joint import ClearanceJoint, JointState, States
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
    "holds_joints",
    "user_force_of",
]

__getattr__ = lazy_names(__name__)
