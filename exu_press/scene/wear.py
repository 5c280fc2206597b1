"""The [wear] table of a scene."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError, MissingKeysError, Need, UnusedKeyError
from exu_press.schema.checks import key
from exu_press.schema.table import Table, missing_keys, table_from

__all__ = ["Wear", "WearAt"]


@dataclass(frozen=True)
class WearAt(Table):
    """Archard's law at one joint or guide."""

    coefficient: float = key(
        None, "Archard's, of each of the two surfaces", above=0, at_most=1, example=1e-5
    )
    hardness: float = key(None, "of the surfaces", "Pa", above=0, example=2e9)
    length: float = key(
        None,
        "of a bearing along its axis; of a guideway as deep as that",
        "m",
        above=0,
        example=0.1,
    )


def _own(meaning: str) -> Any:
    metadata = {**key(None, meaning, also=Mapping).metadata, "by_place": True}
    return dataclasses.field(default=None, hash=False, metadata=metadata)


@dataclass(frozen=True)
class Wear(WearAt):
    """Archard's law for joints whose surfaces touch and guides with clearance.

    It changes nothing in the run.
    """

    table: ClassVar[str] = "wear"
    joints: Mapping[str, Mapping[str, float]] | None = _own(
        "joint = {coefficient, hardness, length}, those that differ there"
    )
    guides: Mapping[str, Mapping[str, float]] | None = _own(
        "guided body = {coefficient, hardness, length}, those that differ there"
    )

    def __post_init__(self) -> None:
        for kind in ("joints", "guides"):
            tables = getattr(self, kind)
            if tables is None:
                continue
            if not isinstance(tables, Mapping):
                raise InputError(f"wear.{kind} = {tables!r:.200}: allowed is a table of {kind}")
            checked = {
                name: table_from(WearAt, f"wear.{kind}.{name}", keys).given_values
                for name, keys in tables.items()
            }
            object.__setattr__(self, kind, checked)
        super().__post_init__()

    def check_places(
        self, joints: Mapping[str, str], guides: Mapping[str, str], groups: Mapping[str, Any]
    ) -> tuple["Wear", dict[str, dict[str, WearAt]]]:
        """Return the table with groups as their joints, and the law of each place that wears.

        Args:
            joints: every joint -> why it does not wear, or nothing.
            guides: every guided body likewise.
            groups: names for several joints at once -> these joints.

        Raises:
            InputError: there is no such place, it does not wear, or keys are missing.
        """
        by_joint: dict[str, Mapping[str, float]] = {}
        for name, keys in (self.joints or {}).items():
            for member in groups.get(name, (name,)):
                by_joint[member] = {**by_joint.get(member, {}), **keys}
        whole, places = dataclasses.replace(self, joints=by_joint or None), {}
        needs: list[Need] = []
        for kind, tables, known in (
            ("joints", by_joint, joints),
            ("guides", self.guides or {}, guides),
        ):
            for name in tables:
                path = f"wear.{kind}.{name}"
                if name not in known:
                    names = ", ".join(known) or "none"
                    raise InputError(f"{path}: there is no such place; allowed are {names}")
                if known[name]:
                    raise UnusedKeyError(path, path, known[name])
            usual = {key: getattr(self, key) for key in KEYS}
            laws = {
                name: WearAt(**{**usual, **tables.get(name, {})})
                for name, why in known.items()
                if not why
            }
            for name, law in laws.items():
                where = "[wear] or [wear.{path}]"
                needs += missing_keys(f"{kind}.{name}", law, KEYS, "wear", where)
            places[kind] = laws
        if needs:
            raise MissingKeysError(needs)
        return whole, places


KEYS = tuple(field.name for field in dataclasses.fields(WearAt))
