"""Scene: what is asked, checked at the door."""

from exu_press.scene.joint import DryJoint, IdealJoint, LubricatedJoint
from exu_press.scene.joints import Joints
from exu_press.scene.load import load_scene, parse_assignment
from exu_press.scene.scene import Scene
from exu_press.scene.tables import (
    Blanking,
    Contact,
    ElasticGuide,
    Film,
    Flexible,
    Friction,
    Press,
    SliderCrank,
    Solver,
)

__all__ = [
    "Blanking",
    "Contact",
    "DryJoint",
    "ElasticGuide",
    "Film",
    "Flexible",
    "Friction",
    "IdealJoint",
    "Joints",
    "LubricatedJoint",
    "Press",
    "Scene",
    "SliderCrank",
    "Solver",
    "load_scene",
    "parse_assignment",
]
