"""Clearance joints: the only place where a law meets Exudyn."""

from exu_press.joints.add import add_dry_revolute, add_dry_spherical, add_lubricated_revolute
from exu_press.joints.overlay import overlay_of
from exu_press.joints.planar import PlanarJoint, PlanarState

__all__ = [
    "PlanarJoint",
    "PlanarState",
    "add_dry_revolute",
    "add_dry_spherical",
    "add_lubricated_revolute",
    "overlay_of",
]
