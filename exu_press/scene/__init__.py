"""Scene: the task, validated once. Names are loaded on first access."""

from typing import TYPE_CHECKING

from exu_press.schema.checks import key
from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from exu_press.scene.blanking_load import BlankingLoad
    from exu_press.scene.bodies import Face, Flexible, flexible_press
    from exu_press.scene.contact import ContactDamping
    from exu_press.scene.file import parse_assignment
    from exu_press.scene.film import FilmLaw
    from exu_press.scene.friction import FrictionLaw
    from exu_press.scene.guide import ElasticGuide
    from exu_press.scene.joint import CustomJoint, DryJoint, IdealJoint, LubricatedJoint
    from exu_press.scene.joints import Joints
    from exu_press.scene.load import CustomLoad
    from exu_press.scene.motor import Motor
    from exu_press.scene.scene import Scene, mechanism_of
    from exu_press.scene.sheet_load import SheetLoad
    from exu_press.scene.solver import Solver
    from exu_press.scene.spring_load import SpringLoad
    from exu_press.scene.table_load import TableLoad

__all__ = [
    "BlankingLoad",
    "ContactDamping",
    "CustomJoint",
    "CustomLoad",
    "DryJoint",
    "ElasticGuide",
    "Face",
    "FilmLaw",
    "Flexible",
    "FrictionLaw",
    "IdealJoint",
    "Joints",
    "LubricatedJoint",
    "Motor",
    "Scene",
    "SheetLoad",
    "Solver",
    "SpringLoad",
    "TableLoad",
    "flexible_press",
    "key",
    "mechanism_of",
    "parse_assignment",
]

__getattr__ = lazy_names(__name__)
