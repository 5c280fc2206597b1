"""Scene: the task, validated once."""

from exu_press.mechanism import Press, SliderCrank
from exu_press.scene.bodies import Face, Flexible, flexible_press
from exu_press.scene.custom import CustomJoint
from exu_press.scene.file import parse_assignment
from exu_press.scene.joint import DryJoint, IdealJoint, LubricatedJoint
from exu_press.scene.joints import Joints
from exu_press.scene.load import BlankingLoad, CustomLoad, SheetLoad, SpringLoad, TableLoad
from exu_press.scene.motor import Motor
from exu_press.scene.scene import Scene, mechanism_of
from exu_press.scene.tables import Contact, ElasticGuide, Film, Friction, Solver
from exu_press.schema.checks import key

__all__ = [
    "BlankingLoad",
    "Contact",
    "CustomJoint",
    "CustomLoad",
    "DryJoint",
    "ElasticGuide",
    "Face",
    "Film",
    "Flexible",
    "Friction",
    "IdealJoint",
    "Joints",
    "LubricatedJoint",
    "Motor",
    "Press",
    "Scene",
    "SheetLoad",
    "SliderCrank",
    "Solver",
    "SpringLoad",
    "TableLoad",
    "flexible_press",
    "key",
    "mechanism_of",
    "parse_assignment",
]
