"""Assumptions of a scene: its defaults, and those of them that decide its results.

The assumptions A-1 to A-14, which fill the paper's gaps, are listed here once;
meanings, defaults and their sources are in the modules of the tables.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any

from exu_press.mechanism import Mechanism
from exu_press.scene.changes import gives_key
from exu_press.scene.joint import SIZES, Joint
from exu_press.scene.scene import STARTS, Scene, mechanism_of
from exu_press.scene.usage import LAWS
from exu_press.schema.table import Table, dotted_name, key_values, plain

__all__ = [
    "ASSUMPTIONS",
    "Assumption",
    "Key",
    "assumed_line",
    "assumed_values",
    "engineering_values",
    "keys_of",
    "used_assumptions",
]


@dataclass(frozen=True)
class Assumption:
    """Something the paper leaves out or misprints.

    Attributes:
        number: n of A-n.
        text: the assumption in words.
        keys: of the scene, where to change it, * for any name; a table's name where its absence is
            the assumption.
    """

    number: int
    text: str
    keys: tuple[str, ...]


ASSUMPTIONS = (
    Assumption(1, "topology: two-point knuckle press, from the lengths in Table 2", ("press",)),
    Assumption(
        2,
        "distance of frame pivots and plungers from the middle, from the measured acceleration",
        ("press.pivot_distance",),
    ),
    Assumption(
        3,
        "counter-eccentric opposite the pin, cancels the first harmonic",
        ("press.counter_eccentricity",),
    ),
    Assumption(4, "mass of slide 4", ("press.slide_mass",)),
    Assumption(5, "ball 9 is part of plunger 8", ("press.plunger_mass",)),
    Assumption(
        6,
        "links are uniform rods; the crank's centre of mass half-way to its pin",
        ("press.crank_mass_offset", "press.linkage_mass_offset", "press.linkage_inertia"),
    ),
    Assumption(
        7,
        "lengths and masses of 5 to 8 are per side",
        ("press.link_5_mass", "press.link_6_mass", "press.link_7_mass", "press.plunger_mass"),
    ),
    Assumption(8, "slider position at the ideal bottom dead centre", ("press.bottom_dead_centre",)),
    Assumption(9, "guides are ideal", ("guide",)),
    Assumption(10, "contact does not pull", ("contact.tension",)),
    Assumption(11, "viscosity", ("film.viscosity",)),
    Assumption(12, "bearing length", ("film.length",)),
    Assumption(13, "behaviour of a film at eccentricity ratio 1", ("film.at_contact",)),
    Assumption(
        14,
        "length and end of the blanking pulse",
        ("load.*.rise", "load.*.fall", "load.*.end_angle_deg"),
    ),
)

OF_EVERY_SCENE = (9, 13, 14)
"""Assumptions that other mechanisms than the paper's press rest on, too."""

FIRST_OF_A_RUN = 10
"""From this assumption on they belong to a run; those before describe the machine."""


@dataclass(frozen=True)
class Key:
    """One key of a complete scene.

    Attributes:
        name: dotted.
        value: in the scene.
        default: its value, had it not been given.
        unit: SI, as the scene's table says it.
        meaning: in words.
        source: who gives the default, where that decides results.
        asked: whether the user gave it.
    """

    name: str
    value: Any
    default: Any
    unit: str
    meaning: str
    source: str = ""
    asked: bool = False

    @property
    def is_changed(self) -> bool:
        """Return whether it is not at its default."""
        return bool(self.value != self.default)

    @property
    def is_assumed(self) -> bool:
        """Return whether it is at its default, and not because the user said so."""
        return not (self.is_changed or self.asked)

    def __str__(self) -> str:
        return f"{self.name} = {_text(self.value)} {self.unit}".rstrip()


Entry = tuple[str, Any, dataclasses.Field[Any]]
"""Dotted name, value and declaration of a key."""


def keys_of(scene: Scene) -> dict[str, Key]:
    """Return every key that a scene uses, by name, with the default it would have."""
    own = mechanism_of(scene).defaults
    of_mechanism = {f"{law}.{key}": v for law in LAWS for key, v in own.get(law, {}).items()}
    of_mechanism |= {"start": own["start"]} if "start" in own else {}
    defaults = {"start": STARTS[0], **of_mechanism}
    if scene.guide is not None:
        shared = plain(scene.guide)
        defaults |= {
            f"guide.{name}.{key}": shared[key]
            for name, keys in scene.guide.by_name.items()
            for key in keys.keys() & shared.keys()
        }
    scene_keys = {
        entry[0]: _key(entry, defaults, with_source=entry[0] not in of_mechanism)
        for entry in _scene_entries(scene)
    }
    scene_keys |= _joint_keys(scene)
    for name, body in scene.bodies.items():
        defaults[f"bodies.{name}.flexible"] = ""
        scene_keys |= {e[0]: _key(e, defaults) for e in _entries(f"bodies.{name}", body)}
    for name, load in scene.load.items():
        scene_keys |= {e[0]: _key(e, defaults) for e in _entries(f"load.{name}", load)}
    return {
        name: dataclasses.replace(key, asked=name in scene.asked)
        for name, key in scene_keys.items()
    }


def used_assumptions(scene: Scene) -> dict[Assumption, tuple[Key, ...]]:
    """Return the assumptions that a scene rests on, with those of their keys that it leaves alone.

    An assumption is left out where the scene does not use its keys, or has changed all of them.
    """
    keys = _decisive(scene)
    used = {}
    for assumption in ASSUMPTIONS:
        if scene.press is None and assumption.number not in OF_EVERY_SCENE:
            continue
        unchanged = tuple(
            key
            for name, key in keys.items()
            if key.is_assumed and any(fnmatchcase(name, pattern) for pattern in assumption.keys)
        )
        drawn = mechanism_of(scene).guides
        ideal = not drawn or any(g.holds_across for g in drawn)
        by_absence = assumption.keys == ("guide",) and ideal
        by_kind = assumption.keys == ("press",) and scene.press is not None
        if unchanged or by_absence or by_kind:
            used[assumption] = unchanged
    return used


def engineering_values(scene: Scene) -> list[Key]:
    """Return the defaults that decide results and are neither the scene's nor its mechanism's."""
    deciding = [key for key in _decisive(scene).values() if key.source and key.is_assumed]
    return deciding + _slowest_impacts(scene)


def _slowest_impacts(scene: Scene) -> list[Key]:
    """Return the key of the speed as which slow contacts are damped, where clearances give it."""
    touching: list[tuple[Any, float]] = [
        (joint.contact, joint.clearance)
        for joint in scene.joints.with_clearance.values()
        if joint.contact is not None
    ]
    touching += [
        (guide.contact, guide.clearance)
        for guide in scene.guides.values()
        if guide.clearance is not None
    ]
    usual = [(table.damping, scene.angular_speed * clearance) for table, clearance in touching]
    speeds = sorted(filter(None, (law.assumed_slowest_impact(speed) for law, speed in usual)))
    if not speeds:
        return []
    value = speeds[0] if speeds[0] == speeds[-1] else f"{speeds[0]:g} to {speeds[-1]:g}"
    meaning = "contacts that begin slower are damped as one at this speed"
    source = "speed of the crank times the clearance"
    return [Key("contact.slowest_impact", value, value, "m/s", meaning, source)]


def _decisive(scene: Scene) -> dict[str, Key]:
    """Return the keys that a scene uses, without those of laws that all joints have themselves."""
    return {name: key for name, key in keys_of(scene).items() if _is_used_by_some(scene, key)}


def _is_used_by_some(scene: Scene, key: Key) -> bool:
    """Return whether a key is none of a law, or the law's for some joint or guide."""
    law, _, name = key.name.partition(".")
    if law not in LAWS:
        return True
    if law != "film" and name in scene.law_keys_of_guides(law):
        return True
    asked = dict.fromkeys(scene.asked)
    for joint_name, joint in scene.joints.with_clearance.items():
        if gives_key(f"joints.{joint_name}.{key.name}", scene.joints.groups, asked):
            continue
        own = getattr(joint, law)
        if own is not None and {n: v for n, v, _ in _entries("", own)}.get(name) == key.value:
            return True
    return False


def assumed_values(scene: Scene) -> list[str]:
    """Return the defaults of laws, loads and the start that were assumed, each with its source."""
    numbered = [
        f"{key} (A-{assumption.number})"
        for assumption, keys in used_assumptions(scene).items()
        if assumption.number >= FIRST_OF_A_RUN
        for key in keys
    ]
    return numbered + [f"{key} ({key.source})" for key in engineering_values(scene)]


def assumed_line(scene: Scene) -> str:
    """Return the assumptions in one line; empty without any."""
    named = assumed_values(scene)
    return f"assumed: {', '.join(named)}" if named else ""


def _key(entry: Entry, defaults: Mapping[str, Any], *, with_source: bool = False) -> Key:
    """Return a key with its own default, or the declared one."""
    name, value, field = entry
    meta, default = field.metadata, defaults.get(name, field.default)
    if isinstance(value, Mechanism):
        value = f"{value.name}, the scene's own"
    source = meta["source"] if with_source else ""
    return Key(name, value, default, meta["unit"], meta["meaning"], source)


def _joint_keys(scene: Scene) -> dict[str, Key]:
    """Return the keys of the joints with clearance, and of those that are ideal against habit."""
    mechanism = mechanism_of(scene)
    usual = mechanism.defaults.get("joints", {}) if scene.shipped_name else {}
    by_joint = {j: kind for name, kind in usual.items() for j in scene.joints.members(name)}
    joints: dict[str, Joint] = {**scene.joints.by_group}
    joints |= {name: scene.joints[name] for name in by_joint if name in scene.joints.ideal}
    keys = {}
    for name, joint in joints.items():
        path = f"joints.{name}"
        default = by_joint.get(scene.joints.members(name)[0], "ideal")
        keys[f"{path}.kind"] = Key(
            f"{path}.kind", joint.kind, default, "", "ideal, dry or lubricated"
        )
        defaults = {f"{path}.{size}": mechanism.defaults.get(size) for size in SIZES}
        defaults |= {f"{path}.{name}": v for law in LAWS for name, v, _ in _law_entries(scene, law)}
        for entry in _entries(path, joint):
            key, table = _key(entry, defaults), entry[0].split(".")[2]
            if table != "worn" and (key.is_changed or table not in LAWS):
                keys[key.name] = key
    return keys


def _scene_entries(scene: Scene) -> Iterator[Entry]:
    """Yield every key in use but those of joints, bodies and loads; those of laws are shared."""
    for field in dataclasses.fields(scene):
        value = getattr(scene, field.name)
        if field.name in LAWS:
            yield from _law_entries(scene, field.name)
        elif isinstance(value, Table):
            yield from _entries(field.name, value)
        elif value is not None and "meaning" in field.metadata:
            yield field.name, value, field
    for guide, keys in () if scene.guide is None else scene.guide.by_name.items():
        from exu_press.scene.guides import fields_of  # loaded by these tables

        fields = fields_of(scene.guides.get(guide))
        yield from ((f"guide.{guide}.{name}", value, fields[name]) for name, value in keys.items())


def _law_entries(scene: Scene, law: str) -> Iterator[Entry]:
    """Yield the keys of [contact], [friction] or [film]."""
    keys = scene.laws[law] or {}
    fields = {**scene.joints.law_keys(law), **scene.law_keys_of_guides(law)}
    for name, value in keys.items():
        if isinstance(value, Table):
            yield from _entries(f"{law}.{name}", value)
        else:
            yield f"{law}.{name}", value, fields[name]


def _entries(path: str, table: Table) -> Iterator[Entry]:
    """Yield the keys that a table gives, and those of tables within it."""
    for key, value, field in key_values(table):
        name = dotted_name(path, key)
        if isinstance(value, Table):
            yield from _entries(name, value)
        elif value is not None and "meaning" in field.metadata:
            yield name, value, field


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)
