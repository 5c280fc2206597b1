"""Every joint of a mechanism: ideal, dry or lubricated, from a scene's table of some of them."""

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from exu_press.errors import InputError, UnusedKeyError, prefixed
from exu_press.laws.catalogue import FILM_LAWS
from exu_press.scene.custom import CustomJoint, UnresolvedJoint, custom_class
from exu_press.scene.joint import (
    JOINT_KINDS,
    LAW_TABLES,
    IdealJoint,
    Joint,
    LooseJoint,
    LubricatedJoint,
    joint_dict,
    keys_used,
    refuse_missing,
)
from exu_press.scene.tables import Contact, Film
from exu_press.schema.checks import Table, given_in, nearest, refuse_unknown, table_from, table_with

__all__ = ["Joints", "joints_of", "keys_given"]

Laws = Mapping[str, Table]
"""The scene's own "contact", "friction" and "film"."""


class Joints(Mapping[str, Joint]):
    """Every joint of a mechanism by its name, in the mechanism's order.

    Attributes:
        mechanism: its name, for messages.
        spherical: names of the balls in their sockets.
        groups: names for several joints at once -> these joints.
    """

    def __init__(
        self,
        joints: Mapping[str, Joint],
        mechanism: str,
        groups: Mapping[str, tuple[str, ...]],
        spherical: Iterable[str] = (),
    ) -> None:
        self.spherical = frozenset(spherical)
        self._joints = dict(joints)
        self.mechanism = mechanism
        self.groups = dict(groups)

    def __getitem__(self, name: str) -> Joint:
        if name not in self._joints:
            raise InputError(_unknown(name, self.mechanism, self._joints, {}))
        return self._joints[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._joints)

    def __len__(self) -> int:
        return len(self._joints)

    def __contains__(self, name: object) -> bool:
        return name in self._joints

    def __hash__(self) -> int:
        return hash(tuple(self._joints.items()))

    def __repr__(self) -> str:
        return f"Joints({self.with_clearance!r})"

    @property
    def ideal(self) -> frozenset[str]:
        """Names of the joints without clearance."""
        return frozenset(n for n, joint in self._joints.items() if isinstance(joint, IdealJoint))

    @property
    def with_clearance(self) -> dict[str, LooseJoint]:
        """The joints with clearance."""
        return {n: j for n, j in self._joints.items() if not isinstance(j, IdealJoint)}

    @property
    def grouped(self) -> dict[str, LooseJoint]:
        """The joints with clearance, those of a group that are all the same under its name."""
        loose = self.with_clearance
        shown: dict[str, LooseJoint] = {}
        for name, joint in loose.items():
            group = next(
                (
                    group
                    for group, members in self.groups.items()
                    if name in members and all(loose.get(member) == joint for member in members)
                ),
                name,
            )
            shown.setdefault(group, joint)
        return shown

    def to_dict(self, laws: Mapping[str, Table | None]) -> dict[str, dict[str, Any]]:
        """Return the joints with clearance as nested mappings.

        Args:
            laws: the scene's; keys of a joint that differ from them are given.
        """
        return {name: joint_dict(joint, laws) for name, joint in self.with_clearance.items()}

    def unused_by_all(self, shared: Table, names: Iterable[str]) -> dict[str, str]:
        """Return the keys of a law that none of these joints uses, if it has it -> the reason.

        Args:
            shared: the scene's table of this law; where a joint's own decides, the reason says so.
            names: of joints.
        """
        law, of_all = shared.table, shared.unused()
        unused = []
        for name in names:
            table = getattr(self._joints[name], law, None)
            if table is not None:
                reasons = unused_in(table, spherical=name in self.spherical)
                unused.append(
                    {
                        key: f"joints.{name}.{reason}"
                        if reason.startswith(f"{law}.") and of_all.get(key) != reason
                        else reason
                        for key, reason in reasons.items()
                    }
                )
        common = set.intersection(*map(set, unused)) if unused else set()
        return {
            key: reason for key, reason in (unused[0] if unused else {}).items() if key in common
        }

    def members(self, name: str) -> tuple[str, ...]:
        """Return the joints that a joint's or a group's name stands for."""
        return self.groups.get(name, (name,))


def joints_of(
    given: Any,
    mechanism: str,
    spherical: Mapping[str, bool],
    groups: Mapping[str, tuple[str, ...]],
    laws: Laws,
    sizes: Mapping[str, float],
) -> Joints:
    """Return every joint of a mechanism from a scene's table.

    A joint's own keys go before those of its group; a joint that is not named is ideal.

    Args:
        given: joint or group -> its kind, a mapping of its keys or one of the three dataclasses.
        mechanism: its name.
        spherical: every joint of it -> whether it is a ball in a socket.
        groups: names for several joints at once -> these joints.
        laws: the scene's own, for keys that a joint does not give.
        sizes: the mechanism's clearance and radius, likewise, where it has them.

    Raises:
        InputError: there is no such joint or group, a joint lies in two groups that are given, a
            key is not one of this kind of joint or is missing, or a law's parameters are outside
            its range.
    """
    if not isinstance(given, Mapping):
        raise InputError(f"joints = {given!r}: allowed is a table of joints")
    own: dict[str, dict[str, Any]] = {}
    by_group: dict[str, str] = {}
    for group, members in groups.items():
        for member in members if group in given else ():
            if member in by_group:
                raise InputError(
                    f"joints.{by_group[member]}, joints.{group}: {member} lies in both; allowed "
                    "is one of them"
                )
            by_group[member] = group
            own[member] = keys_given(group, given[group])
    for joint, value in given.items():
        if joint in spherical:
            own[joint] = {**own.get(joint, {}), **keys_given(joint, value)}
        elif joint not in groups:
            raise InputError(_unknown(joint, mechanism, spherical, groups, value))
    found, complete = {}, {law: _law("joints", law, {}, laws[law]) for law in LAW_TABLES}
    for joint, ball in spherical.items():
        shown, keys = by_group.get(joint, joint), own.get(joint, {"kind": "ideal"})
        shown = joint if joint in given else shown
        found[joint] = _joint(shown, keys, complete, sizes, spherical=ball)
    joints = Joints(found, mechanism, groups, [name for name, ball in spherical.items() if ball])
    for name, value in given.items():
        for law in LAW_TABLES:
            idle = joints.unused_by_all(laws[law], joints.members(name))
            for key, each in given_in(keys_given(name, value).get(law)).items():
                if key in idle:
                    place = f"joints.{name}.{law}.{key}"
                    raise UnusedKeyError(place, f"{place} = {each!r}", idle[key])
    return joints


def keys_given(name: str, given: Any) -> dict[str, Any]:
    """Return the given keys of a joint or group as a mapping with its kind."""
    if isinstance(given, Joint):
        fields = {field.name: getattr(given, field.name) for field in dataclasses.fields(given)}
        kind = type(given) if isinstance(given, CustomJoint) else given.kind
        return {"kind": kind, **{k: v for k, v in fields.items() if v is not None}}
    if isinstance(given, str):
        return {"kind": given}
    if not isinstance(given, Mapping):
        kinds = ", ".join(map(repr, JOINT_KINDS))
        raise InputError(
            f"joints.{name} = {given!r}: allowed is a table of keys, or one of {kinds}"
        )
    return dict(given)


def _joint(
    name: str, given: Mapping[str, Any], laws: Laws, sizes: Mapping[str, float], *, spherical: bool
) -> Joint:
    place = f"joints.{name}"
    kind = given.get("kind")
    with prefixed(f"{place}."):
        own_class = None if kind in [*JOINT_KINDS] else custom_class(kind, CustomJoint)
    if kind not in [*JOINT_KINDS] and own_class is None:
        what = f"{place}.kind = {kind!r}" if "kind" in given else f"{place} has no kind"
        raise InputError(f"{what}: allowed is one of {', '.join(map(repr, JOINT_KINDS))}")
    known = ("kind", "clearance", "radius", *LAW_TABLES, "worn")
    if own_class is not None:
        known = ("kind", *keys_used(kind, None))
    refuse_unknown(place, given, known)
    own = {
        law: usual if given.get(law) is None else _law(place, law, given[law], usual)
        for law, usual in laws.items()
    }
    film = own["film"]
    assert isinstance(film, Film)
    used = keys_used(kind, film.at_contact)
    for unused in [key for key in given if key not in ("kind", *used)]:
        mixed = kind == "lubricated" and unused in ("contact", "friction")
        reason = "film.at_contact is 'stop'" if mixed else f"{place} is {kind!r}"
        raise UnusedKeyError(f"{place}.{unused}", f"{place}.{unused}", reason)
    for law, table in own.items():
        own[law] = table.without(unused_in(table, spherical=spherical))
    values: dict[str, Any] = {**sizes, **given, **own}
    if given.get("worn") is not None:
        if spherical:
            raise UnusedKeyError(f"{place}.worn", f"{place}.worn", f"{place} is a ball")
        with prefixed(f"{place}."):
            from exu_press.scene.worn import Worn

            values["worn"] = table_from(Worn, "worn", given["worn"])
    chosen: type[Any] = own_class or JOINT_KINDS[str(kind)]
    with prefixed(f"{place}."):
        joint: Joint = chosen(**{key: values[key] for key in used if key in values})
    refuse_missing(place, joint, revolute=not spherical)
    _check_laws(place, joint, spherical)
    return joint


def unused_in(law: Table, *, spherical: bool) -> dict[str, str]:
    """Return the keys of a joint's law that it does not use -> the reason."""
    if isinstance(law, Film):
        return law.unused(joint="spherical" if spherical else "revolute")
    ball = {"shape": "point"} if spherical and isinstance(law, Contact) else {}
    return law.unused(**ball)


def _law(place: str, law: str, given: Any, usual: Table) -> Table:
    """Return a joint's law: the scene's, but for its own keys."""
    complete = {field.name: getattr(usual, field.name) for field in dataclasses.fields(usual)}
    with prefixed(f"{place}."):
        return table_with(LAW_TABLES[law], law, given, complete)


def _check_laws(place: str, joint: Joint, spherical: bool) -> None:
    """Make every law once, so that values outside its range are refused before anything is run."""
    if isinstance(joint, IdealJoint | UnresolvedJoint):
        return
    from exu_press.scene.laws import contact_law, film_law, friction_law

    try:
        if isinstance(joint, CustomJoint):
            laws = joint.interfaces()
            if not isinstance(laws, list | tuple) or not laws:
                raise InputError(
                    f"{joint.kind}.interfaces() returns {laws!r:.80}: allowed is a list of one "
                    "interface law or more"
                )
        if joint.contact is not None:
            contact_law(joint, revolute=not spherical, crank_speed=1.0)
        if joint.friction is not None:
            friction_law(joint.friction)
        if isinstance(joint, LubricatedJoint):
            film_law(joint.film, joint.radius, joint.clearance)
            _check_cooling(joint.film)
    except InputError as error:
        raise InputError(f"{error} ({place})") from None


def _check_cooling(film: Film) -> None:
    """Raise InputError for a film of which nothing carries the heat off, or a ball's that warms."""
    if film.oil is not None and film.length is None:
        raise InputError(
            "film.oil: the film of a ball does not warm; allowed is film.viscosity of its own"
        )
    if film.oil is not None and not film.oil.conductance and not FILM_LAWS[film.law].flows_out:
        raise InputError(
            f"film.oil.conductance = 0 with film.law = {film.law!r}: allowed is a number > 0, as a "
            "long bearing has no side flow that carries heat off, or film.law = 'finite'"
        )


def _unknown(
    name: str, mechanism: str, joints: Iterable[str], groups: Iterable[str], value: Any = None
) -> str:
    groups = list(groups)
    known = [*joints, *groups]
    given = "" if value is None else f" = {value!r}"
    return (
        f"joints.{name}{given}: {mechanism} has no such joint{' or group' if groups else ''}"
        f"{nearest(name, known)}; allowed are {', '.join(known)}"
    )
