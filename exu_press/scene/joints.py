"""Every joint of a mechanism: ideal, dry or lubricated, from a scene's table of some of them."""

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any

from exu_press.errors import (
    InputError,
    MissingKeysError,
    Need,
    UnusedKeyError,
    collected_needs,
    error_prefix,
)
from exu_press.mechanism import Mechanism
from exu_press.scene.joint import JOINT_KINDS, SIZES, CustomJoint, IdealJoint, Joint
from exu_press.scene.usage import LAWS, LawKeys, law_kind
from exu_press.schema.checks import nearest, refuse_unknown
from exu_press.schema.table import (
    Table,
    changed_table,
    given_keys,
    key_values,
    refuse_unknown_keys,
    resolve,
    table_from,
    unused_reason,
    used_names,
)

__all__ = ["Joints", "joint_keys", "joints_of", "keys_of_kind"]

OF_JOINTS = ("kind", "clearance", "radius", *LAWS, "worn")
"""Keys that some kind of joint has."""

TOUCHING = ("contact", "friction")
"""Laws of a lubricated joint with a mixed film alone."""


class Joints(dict[str, Joint]):
    """Every joint of a mechanism by its name, in the mechanism's order.

    Attributes:
        spherical: names of the balls in their sockets.
        groups: names for several joints at once -> these joints.
    """

    def __init__(self, joints: Mapping[str, Joint], mechanism: Mechanism) -> None:
        super().__init__(joints)
        self.spherical = frozenset(joint.name for joint in mechanism.joints if joint.spherical)
        self.groups = dict(mechanism.groups)
        self._mechanism = mechanism.name

    def __missing__(self, name: str) -> Joint:
        raise InputError(_unknown(name, self._mechanism, self, {}))

    def __hash__(self) -> int:  # type: ignore[override]  # it is not changed
        return hash(tuple(self.items()))

    def __repr__(self) -> str:
        return f"Joints({self.with_clearance!r})"

    @property
    def ideal(self) -> frozenset[str]:
        """Names of the joints without clearance."""
        return frozenset(n for n, joint in self.items() if isinstance(joint, IdealJoint))

    @property
    def with_clearance(self) -> dict[str, Joint]:
        """The joints with clearance."""
        return {n: j for n, j in self.items() if not isinstance(j, IdealJoint)}

    @property
    def by_group(self) -> dict[str, Joint]:
        """The joints with clearance, those of a group that are all the same under its name."""
        loose = self.with_clearance
        joints: dict[str, Joint] = {}
        for name, joint in loose.items():
            group = next(
                (
                    group
                    for group, members in self.groups.items()
                    if name in members and all(loose.get(member) == joint for member in members)
                ),
                name,
            )
            joints.setdefault(group, joint)
        return joints

    def to_dict(self, laws: Mapping[str, Mapping[str, Any] | None]) -> dict[str, dict[str, Any]]:
        """Return the joints with clearance as nested mappings, each with its own keys of laws."""
        return {name: joint.to_dict(laws) for name, joint in self.with_clearance.items()}

    def unused_laws(self) -> dict[str, str]:
        """Return which of the scene's laws no joint has, and of its start -> the reason."""
        touching = "no joint is 'dry' or has a mixed film"
        reasons = {"contact": touching, "friction": touching, "film": "no joint is 'lubricated'"}
        joints = self.values()
        unused = {
            law: reason
            for law, reason in reasons.items()
            if all(getattr(joint, law) is None for joint in joints)
        }
        return unused if self.with_clearance else {**unused, "start": "every joint is ideal"}

    def law_keys(
        self, law: str, names: Iterable[str] | None = None
    ) -> dict[str, dataclasses.Field[Any]]:
        """Return the keys of a law that some joints, or all, use, with their declarations."""
        tables = (getattr(self[n], law) for n in (self if names is None else names))
        keys: dict[str, dataclasses.Field[Any]] = {}
        for table in filter(None, tables):
            for name, _, field in key_values(table):
                keys.setdefault(name, field)
        return keys

    def unused_reason(
        self, law: str, key: str, shared: Mapping[str, Any], names: Iterable[str]
    ) -> str:
        """Return why none of some joints uses a key of a law.

        Where a joint's own key decides, and not the shared one of the scene, the reason says so.
        """
        name, table = next((n, t) for n in names if (t := getattr(self[n], law)))
        own = {k: value for k, value, field in key_values(table)
               if value != shared.get(k, field.default)}  # fmt: skip

        def place_of(key: str) -> str:
            return f"joints.{name}.{law}.{key}" if key in own else f"{law}.{key}"

        shape = "spherical" if name in self.spherical else "revolute"
        return unused_reason(table, key, place_of) or f"the joint is {shape}"

    def members(self, name: str) -> tuple[str, ...]:
        """Return the joints that a joint's or a group's name stands for."""
        return self.groups.get(name, (name,))


def joints_of(tables: Any, mechanism: Mechanism, laws: LawKeys) -> tuple[Joints, list[Need]]:
    """Return every joint of a mechanism from a scene's table, and which keys they lack.

    A joint's own keys go before those of its group; a joint that is not named is ideal.

    Args:
        tables: joint or group -> its kind, a mapping of its keys or the joint itself.
        mechanism: with clearance and radius among its defaults, for joints that do not give them.
        laws: the scene's own, likewise.

    Raises:
        MissingKeysError: a joint has no kind, or its laws' tables lack keys.
        InputError: there is no such joint or group, a joint lies in two groups that are given, a
            key is not one of this kind of joint, or a law's parameters are outside its range.
    """
    if not isinstance(tables, Mapping):
        raise InputError(f"joints = {tables!r}: allowed is a table of joints")
    groups, names = mechanism.groups, [joint.name for joint in mechanism.joints]
    sizes = {name: mechanism.defaults[name] for name in SIZES if name in mechanism.defaults}
    own: dict[str, dict[str, Any]] = {}
    by_group: dict[str, str] = {}
    for group, members in groups.items():
        for member in members if group in tables else ():
            if member in by_group:
                raise InputError(
                    f"joints.{by_group[member]}, joints.{group}: {member} lies in both; allowed "
                    "is one of them"
                )
            by_group[member] = group
            own[member] = joint_keys(group, tables[group])
    for name, table in tables.items():
        if name in names:
            own[name] = {**own.get(name, {}), **joint_keys(name, table)}
        elif name in [guide.name for guide in mechanism.guides]:
            raise InputError(
                f"joints.{name} = {table!r}: {name} is a guide or slot of {mechanism.name}; "
                f"allowed is [guide.{name}] with its clearance"
            )
        elif name not in groups:
            raise InputError(_unknown(name, mechanism.name, names, groups, table))
    complete, needs, incomplete = dict[str, Joint](), list[Need](), list[Need]()
    for joint in mechanism.joints:
        shown_name = joint.name if joint.name in tables else by_group.get(joint.name, joint.name)
        keys = own.get(joint.name, {"kind": "ideal"})
        with collected_needs(incomplete):
            complete[joint.name] = _joint(shown_name, keys, laws, sizes, joint.spherical)
        table = complete.get(joint.name)
        if table is None:
            continue
        if missing := table.missing_keys(f"joints.{shown_name}"):
            needs += missing
        elif table.is_resolved:
            try:
                table.check_laws()
            except InputError as error:
                raise InputError(f"{error} (joints.{shown_name})") from None
    if incomplete:
        raise MissingKeysError([*needs, *incomplete])
    joints = Joints(complete, mechanism)
    for name, table in tables.items():
        _refuse_unused(name, joint_keys(name, table), joints, laws)
    return joints, needs


def _refuse_unused(name: str, table: Mapping[str, Any], joints: Joints, laws: LawKeys) -> None:
    """Raise InputError for a law's key of a joint or group that none of its joints uses."""
    members = joints.members(name)
    for law in LAWS:
        used = joints.law_keys(law, members)
        for key, value in given_keys(table.get(law)).items():
            if used and key not in used and value is not None:
                path = f"joints.{name}.{law}.{key}"
                reason = joints.unused_reason(law, key, laws.keys_of(law), members)
                raise UnusedKeyError(path, f"{path} = {value!r}", reason)


def joint_keys(name: str, table: Any) -> dict[str, Any]:
    """Return the keys of a joint or group, with its kind, as a mapping."""
    if isinstance(table, Joint):
        fields = {field.name: getattr(table, field.name) for field in dataclasses.fields(table)}
        kind = type(table) if isinstance(table, CustomJoint) else table.kind
        return {"kind": kind, **{k: v for k, v in fields.items() if v is not None}}
    if isinstance(table, str):
        return {"kind": table}
    if not isinstance(table, Mapping):
        kinds = ", ".join(map(repr, JOINT_KINDS))
        raise InputError(
            f"joints.{name} = {table!r}: allowed is a table of keys, or one of {kinds}"
        )
    return dict(table)


def keys_of_kind(kind: type[Joint]) -> tuple[str, ...]:
    """Return the keys of a kind of the user's own, or those that some kind of ours has."""
    own = ("kind", *(field.name for field in dataclasses.fields(kind)))
    return own if issubclass(kind, CustomJoint) else OF_JOINTS


def _joint(
    name: str,
    table: Mapping[str, Any],
    laws: LawKeys,
    sizes: Mapping[str, float],
    spherical: bool,
) -> Joint:
    path, kind = f"joints.{name}", table.get("kind")
    chosen = JOINT_KINDS.choose(f"{path}.kind", kind, table)
    keys = [field.name for field in dataclasses.fields(chosen)]
    refuse_unknown(path, table, keys_of_kind(chosen))
    given_laws = [law for law in LAWS if table.get(law) is not None]
    own = {law: _law(path, law, table[law], laws, spherical) for law in given_laws}
    values: dict[str, Any] = {**sizes, **table}
    if "film" in keys:
        values["film"] = film = own.get("film") or _law(path, "film", None, laws, spherical)
        if film.contact_gap is None:
            keys = [key for key in keys if key not in TOUCHING]
    for unused in [key for key in table if key not in ("kind", *keys)]:
        stops = "film" in keys and unused in TOUCHING
        reason = "film.at_contact is 'stop'" if stops else f"{path} is {kind!r}"
        raise UnusedKeyError(f"{path}.{unused}", f"{path}.{unused}", reason)
    for law in [key for key in keys if key in TOUCHING]:
        values[law] = own.get(law) or _law(path, law, None, laws, spherical)
    if table.get("worn") is not None:
        if spherical:
            raise UnusedKeyError(f"{path}.worn", f"{path}.worn", f"{path} is a ball")
        with error_prefix(f"{path}."):
            from exu_press.scene.worn import WornDepths

            values["worn"] = table_from(WornDepths, "worn", table["worn"])
    with error_prefix(f"{path}."):
        joint: Joint = chosen(**{key: values[key] for key in keys if key in values})
    return joint


def _law(path: str, law: str, own: Any, laws: LawKeys, spherical: bool) -> Any:
    """Return a joint's law: the scene's, but for its own keys."""
    if own is not None and not isinstance(own, Mapping | Table):
        raise InputError(f"{path}.{law} = {own!r:.200}: allowed is a table of keys")
    kind, keys = law_kind(law, spherical), given_keys(own)
    if law == "contact" and spherical and keys.get("shape") == "cylindrical":
        raise InputError(
            f"{path}.contact.shape = 'cylindrical': a ball has Hertz's point contact; allowed is "
            "'point', or [contact] shape, which is that of the pins"
        )
    shared = laws.keys_of(law)
    with error_prefix(f"{path}."):
        merged = changed_table(kind, shared, keys)
        refuse_unknown_keys([*LAWS[law].values()], law, keys, used_names(kind, law, merged))
        return resolve(kind, law, merged)


def _unknown(
    name: str, mechanism: str, joints: Iterable[str], groups: Iterable[str], table: Any = None
) -> str:
    groups = list(groups)
    known = [*joints, *groups]
    value_text = "" if table is None else f" = {table!r}"
    return (
        f"joints.{name}{value_text}: {mechanism} has no such joint{' or group' if groups else ''}"
        f"{nearest(name, known)}; allowed are {', '.join(known)}"
    )
