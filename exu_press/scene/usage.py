"""The tables of a scene, and which of them a scene does not use."""

from typing import Any

from exu_press.mechanism import Press, SliderCrank
from exu_press.scene.motor import Motor
from exu_press.scene.output import Output
from exu_press.scene.tables import Contact, ElasticGuide, Film, Friction, Solver
from exu_press.scene.wear import Wear

__all__ = ["TABLES", "unused_tables"]

TABLES = {
    "contact": Contact,
    "friction": Friction,
    "film": Film,
    "drive": Motor,
    "guide": ElasticGuide,
    "output": Output,
    "wear": Wear,
    "solver": Solver,
    "press": Press,
    "slider_crank": SliderCrank,
}


def unused_tables(mechanism: Any) -> dict[str, str]:
    """Return the tables that a scene of this mechanism does not use -> the reason."""
    shown = repr(mechanism) if isinstance(mechanism, str) else "the scene's own"
    reason = f"mechanism is {shown}"
    return {name: reason for name in ("press", "slider_crank") if name != mechanism}
