"""Scene: what is asked, checked at the door."""

from exu_press.scene.load import load_scene, parse_assignment
from exu_press.scene.scene import Scene
from exu_press.scene.tables import (
    Blanking,
    Clearance,
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
    "Clearance",
    "Contact",
    "ElasticGuide",
    "Film",
    "Flexible",
    "Friction",
    "Press",
    "Scene",
    "SliderCrank",
    "Solver",
    "load_scene",
    "parse_assignment",
]
