"""The keys of [contact], [friction] and [film]: the scene's, over those of its mechanism."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any

from exu_press.errors import InputError
from exu_press.scene.usage import LAWS
from exu_press.schema.table import changed_table, check_keys, used_names

__all__ = ["LawKeys"]


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
        """Check the scene's keys.

        Args:
            scene_keys: law -> the scene's keys, or None.
            defaults: of its mechanism, likewise.
            tables: law and keys of joints and guides, which may name laws of their own.

        Raises:
            InputError: a key is not allowed.
        """
        self.scene_keys = scene_keys
        self._defaults = defaults
        self._tables = tuple(tables)
        self._checked: dict[str, dict[str, Any]] = {}
        for law, keys in scene_keys.items():
            if keys is not None:
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
