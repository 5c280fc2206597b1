"""The keys of [contact], [friction] and [film]: the scene's, over those of its mechanism."""

from collections.abc import Mapping
from typing import Any

from exu_press.scene.usage import LAWS
from exu_press.schema.table import changed_table, check_keys

__all__ = ["LawKeys"]


class LawKeys:
    """The keys from which each joint and guide takes those that it uses.

    Attributes:
        given: law -> the scene's keys, or None.
    """

    def __init__(self, given: Mapping[str, Any], defaults: Mapping[str, Any]) -> None:
        """Take a mechanism's defaults, too; InputError for a key that is not allowed."""
        self.given = given
        self._defaults = defaults
        self._checked: dict[str, dict[str, Any]] = {}
        for law, keys in given.items():
            if keys is not None:
                self.of(law)

    def of(self, law: str) -> dict[str, Any]:
        """Return the keys of a law, checked when they are first asked for."""
        if law not in self._checked:
            kinds = list(LAWS[law].values())
            keys = self.given[law]
            if keys is None or isinstance(keys, Mapping):
                keys = changed_table(kinds[0], self._defaults.get(law, {}), keys or {})
            self._checked[law] = check_keys(kinds, law, keys)
        return self._checked[law]
