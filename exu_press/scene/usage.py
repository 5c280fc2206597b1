"""The tables of a scene."""

from collections.abc import Mapping
from dataclasses import Field
from typing import Any

from exu_press.schema.registry import Registry
from exu_press.schema.table import Table, declared_keys

__all__ = ["LAWS", "TABLES", "law_kind", "table_keys"]

LAWS: dict[str, Registry] = {
    "contact": Registry(
        {"revolute": "scene.contact:JournalContact", "spherical": "scene.contact:BallContact"}
    ),
    "friction": Registry(dict.fromkeys(("revolute", "spherical"), "scene.friction:Friction")),
    "film": Registry({"revolute": "scene.film:JournalFilm", "spherical": "scene.film:BallFilm"}),
}
"""Tables that hold for every joint unless it has its own -> shape of a joint -> their dataclass."""

TABLES = Registry(
    {
        "contact": "scene.contact:JournalContact",
        "friction": "scene.friction:Friction",
        "film": "scene.film:JournalFilm",
        "drive": "scene.motor:Motor",
        "guide": "scene.guide:ElasticGuide",
        "output": "scene.output:Output",
        "wear": "scene.wear:Wear",
        "solver": "scene.solver:Solver",
        "press": "mechanism.press:Press",
        "slider_crank": "mechanism.slider_crank:SliderCrank",
    }
)
"""Name of a table -> its dataclass, which is loaded when a scene has it."""


def law_kind(law: str, spherical: bool) -> type[Table]:
    """Return the table of a law for a ball in its socket, or a journal in its bearing."""
    return LAWS[law]["spherical" if spherical else "revolute"]


def table_keys(name: str) -> Mapping[str, Field[Any]]:
    """Return every key that a table of a scene may have, with its declaration."""
    kinds = [*LAWS[name].values()] if name in LAWS else [TABLES[name]]
    keys: dict[str, Field[Any]] = {}
    for kind in kinds:
        for key, field in declared_keys(kind).items():
            keys.setdefault(key, field)
    return keys
