"""The tables of a scene; those of laws are shared by its joints and guides."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import Field
from typing import Any

from exu_press.errors import InputError, MissingKeysError
from exu_press.schema.registry import Registry
from exu_press.schema.table import Table, changed_table, check_keys, declared_keys, used_names

__all__ = ["LAWS", "TABLES", "LawKeys", "law_kind", "table_keys"]

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


class LawKeys:
    """The keys from which each joint and guide takes those that it uses.

    Attributes:
        scene_keys: law -> the scene's keys, or None.
    """

    def __init__(
        self,
        scene_keys: Mapping[str, Any],
        defaults: Mapping[str, Any],
        tables: Iterable[tuple[str, Mapping[str, Any]]] = (),
    ) -> None:
        """Check the scene's keys; its mechanism has the defaults.

        Tables are law and keys of joints and guides, which may name laws of their own.

        Raises:
            InputError: a key is not allowed.
        """
        self.scene_keys = scene_keys
        self._defaults = defaults
        self._tables = tuple(tables)
        self._checked: dict[str, dict[str, Any]] = {}
        for law, keys in scene_keys.items():
            if keys is not None:
                with suppress(MissingKeysError):  # said with those of the joints that need the law
                    self.keys_of(law)

    def keys_of(self, law: str) -> dict[str, Any]:
        """Return the keys of a law, checked when they are first asked for."""
        if law not in self._checked:
            kinds = list(LAWS[law].values())
            keys = self.scene_keys[law]
            if keys is None or isinstance(keys, Mapping):
                keys = changed_table(kinds[0], self._defaults.get(law, {}), keys or {})
            self._checked[law] = check_keys(kinds, law, keys, self._of_own_laws(law, keys))
        return self._checked[law]

    def _of_own_laws(self, law: str, keys: Any) -> set[str]:
        """Return the keys of the laws that joints and guides name."""
        names: set[str] = set()
        for name, table in self._tables:
            if name == law and isinstance(keys, Mapping):
                with suppress(InputError):  # said where the table is read
                    names |= used_names(LAWS[law]["revolute"], law, {**keys, **table})
        return names
