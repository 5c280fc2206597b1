"""The tables of a scene, and which of them a scene does not use."""

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any

__all__ = ["TABLES", "Tables", "unused_tables"]


class Tables(Mapping[str, type[Any]]):
    """Name of a table -> its dataclass, which is loaded when a scene has it."""

    def __init__(self, **homes: str) -> None:
        """Take the module and the class of each, with a colon between."""
        self._homes = homes

    def __getitem__(self, name: str) -> type[Any]:
        module, _, kind = self._homes[name].partition(":")
        table: type[Any] = getattr(import_module(f"exu_press.{module}"), kind)
        return table

    def __contains__(self, name: object) -> bool:
        return name in self._homes

    def __iter__(self) -> Iterator[str]:
        return iter(self._homes)

    def __len__(self) -> int:
        return len(self._homes)


TABLES = Tables(
    contact="scene.tables:Contact",
    friction="scene.tables:Friction",
    film="scene.tables:Film",
    drive="scene.motor:Motor",
    guide="scene.tables:ElasticGuide",
    output="scene.output:Output",
    wear="scene.wear:Wear",
    solver="scene.tables:Solver",
    press="mechanism.press:Press",
    slider_crank="mechanism.slider_crank:SliderCrank",
)


def unused_tables(mechanism: Any) -> dict[str, str]:
    """Return the tables that a scene of this mechanism does not use -> the reason."""
    shown = repr(mechanism) if isinstance(mechanism, str) else "the scene's own"
    reason = f"mechanism is {shown}"
    return {name: reason for name in ("press", "slider_crank") if name != mechanism}
