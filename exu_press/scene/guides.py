"""The guides of a scene by their names: [guide], over which [guide.NAME] has the keys of one.

Those that give way replace the ideal ones of a drawing (A-9): springs and dampers, or clearance.
"""

import math
import re
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import Field, replace
from typing import Any

from exu_press.errors import InputError, UnusedKeyError
from exu_press.mechanism import Guide, Guideway, Mechanism, Spring
from exu_press.scene.guide import ElasticGuide, ElasticSupport, GuideOil, GuidewaySupport
from exu_press.schema.checks import demand_known, key
from exu_press.schema.table import (
    changed_table,
    declared_keys,
    key_values,
    plain,
    plain_value,
    table_from,
)

__all__ = ["fields_of", "guides_of", "with_elastic_guides"]

ELASTIC, WITH_CLEARANCE = ({*declared_keys(kind)} for kind in (ElasticSupport, GuidewaySupport))

KINDS: Mapping[str, Collection[str]] = {
    "ideal": ELASTIC | WITH_CLEARANCE,
    "elastic": WITH_CLEARANCE - ELASTIC,
    "dry": {*declared_keys(GuideOil)},
    "lubricated": (),
}
"""Kind of a guide -> keys of [guide] that do not hold for one that asks for this kind."""

KIND = key("", "of this guide, over what [guide] says", choices=tuple(KINDS))

NEEDED = {
    "ideal": "neither lateral_stiffness nor clearance",
    "elastic": "lateral_stiffness and no clearance",
    "dry": "clearance and no viscosity",
    "lubricated": "clearance and viscosity",
}


def guides_of(
    table: ElasticGuide, mechanism: Mechanism
) -> tuple[ElasticGuide, dict[str, ElasticGuide]]:
    """Return [guide] with complete tables by name, and the guides that are not ideal.

    Raises:
        InputError: there is no guide of a name, or a key of its table is not allowed.
    """
    names = [guide.name for guide in mechanism.guides]
    if not (table.soft or table.rubs or table.by_name):
        raise UnusedKeyError(
            "guide",
            "[guide]",
            "it has neither lateral_stiffness nor clearance nor friction, of which it needs at "
            "least one, as in guide.friction = 'coulomb'; without [guide] the guides are ideal",
        )
    shared = {key: value for key, value in plain(table).items() if key not in table.by_name}
    usual = replace(table, by_name={}) if table.soft or table.rubs else None
    guides: dict[str, ElasticGuide | None] = dict.fromkeys(names, usual)
    by_name = {}
    for name, own in table.by_name.items():
        demand_known(f"guide.{name}: {mechanism.name} has no such guide", name, names)
        with _with_guide_named(name):
            by_name[name], guides[name] = _own_guide(shared, own)
    _refuse_overridden(table, guides)
    return replace(table, by_name=by_name), {n: guide for n, guide in guides.items() if guide}


def _refuse_overridden(table: ElasticGuide, guides: Mapping[str, ElasticGuide | None]) -> None:
    """Raise UnusedKeyError for a key of [guide] that no guide, and no other key, has use for."""
    used = {
        key
        for name, guide in guides.items()
        if guide is not None
        for key in {key for key, _, _ in key_values(guide)} - {*table.by_name.get(name, ())}
    }
    shared = {
        name: plain_value(value)
        for name, value, field in key_values(table)
        if name not in table.by_name and value not in (None, field.default)
    }
    for name, value in shared.items():
        if name in used:
            continue
        try:
            table_from(ElasticGuide, "guide", {n: v for n, v in shared.items() if n != name})
        except InputError:  # others, which guides do have from there, are not allowed without it
            continue
        path = f"guide.{name}"
        raise UnusedKeyError(path, f"{path} = {value!r}", "every guide has its own")


def _own_guide(
    shared: Mapping[str, Any], own: Mapping[str, Any]
) -> tuple[dict[str, Any], ElasticGuide | None]:
    """Return the complete keys of one guide's own table, and the guide; None where it is ideal."""
    kind, own = own.get("kind"), {key: value for key, value in own.items() if key != "kind"}
    if kind is not None:
        demand_known(f"guide.kind = {kind!r}: unknown", kind, KINDS)
    inherited = {
        key: value for key, value in shared.items() if key not in KINDS.get(kind or "", ())
    }
    keys = changed_table(ElasticGuide, inherited, own)
    while True:
        try:
            guide = table_from(ElasticGuide, "guide", keys)
            break
        except UnusedKeyError as error:
            unused = error.name.removeprefix("guide.")
            if unused in own:
                raise
            del keys[unused]
    for name in guide.by_name:
        demand_known(f"guide.{name}: unknown key", name, fields_of())
    if kind is not None and guide.kind != kind:
        raise InputError(f"guide.kind = {kind!r}: allowed is a guide with {NEEDED[kind]}")
    complete = {} if kind is None else {"kind": kind}
    complete |= {k: v for k, v in plain(guide).items() if k in own or k not in inherited}
    return complete, guide if guide.soft or guide.rubs else None


def fields_of(guide: ElasticGuide | None = None) -> dict[str, Field[Any]]:
    """Return the declarations of the keys of one guide's own table, first those of the guide."""
    used = {} if guide is None else {name: field for name, _, field in key_values(guide)}
    return {"kind": KIND, **declared_keys(ElasticGuide), **used}


@contextmanager
def _with_guide_named(name: str) -> Iterator[None]:
    """Name the table of one guide in the messages of errors."""
    try:
        yield
    except InputError as error:
        text = re.sub(r"\bguide\.", f"guide.{name}.", str(error))
        error.args = (text.replace("[guide]", f"[guide.{name}]"),)
        if isinstance(error, UnusedKeyError):
            error.name = error.name.replace("guide.", f"guide.{name}.", 1)
        raise


def with_elastic_guides(
    drawn: Mechanism,
    guides: Mapping[str, ElasticGuide],
    solids: Mapping[str, tuple[float, float]] | None = None,
) -> Mechanism:
    """Return a mechanism with the guides that a scene asks for.

    Args:
        drawn: the mechanism.
        guides: name -> guide; one that is not among them, or has no stiffness, stays ideal.
        solids: body -> mass, kg, and inertia, kg m^2, where these are not the drawn ones.
    """
    if not any(guide.soft for guide in guides.values()):
        return drawn
    drawn_ones = {guide.body: drawn.body(guide.body) for guide in drawn.guides}
    inertias = {name: (body.mass, body.inertia) for name, body in drawn_ones.items()}
    inertias |= solids or {}
    return replace(
        drawn,
        guides=tuple(
            _elastic(guide, inertias[guide.body], guides[guide.name])
            if guide.name in guides
            else guide
            for guide in drawn.guides
        ),
    )


def _elastic(guide: Guide, inertia: tuple[float, float], elastic: ElasticGuide) -> Guide:
    """Return a guide of springs, or of guideways with clearance, in place of an ideal one."""
    support = elastic.support
    if support is None:
        return guide
    lateral = support.lateral_stiffness
    if isinstance(support, GuidewaySupport):
        half_width = 0.5 * support.width
        if guide.is_slot:
            pin = Guideway(support.clearance, 0.0, half_width, lateral)
            return replace(guide, guideway=pin)
        guideway = Guideway(support.clearance, support.length, half_width, 0.5 * lateral)
        return replace(guide, guideway=guideway)
    mass, about_centre = inertia
    ratio = support.damping_ratio
    return replace(
        guide,
        lateral=_spring(lateral, support.lateral_damping, ratio, mass),
        tilting=_spring(
            support.stiffness_against_tilting, support.tilting_damping, ratio, about_centre
        ),
    )


def _spring(stiffness: float, damping: float | None, ratio: float, inertia: float) -> Spring:
    """Return a spring damped as asked for, or with a part of the critical damping."""
    critical = 2.0 * math.sqrt(stiffness * inertia)
    return Spring(stiffness, ratio * critical if damping is None else damping)
