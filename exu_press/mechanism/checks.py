"""Checks of a mechanism's data, before anything is computed of it."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, TypeVar

from exu_press.errors import InputError
from exu_press.mechanism.gears import Gear, check_gears
from exu_press.mechanism.parts import (
    DRIVE,
    FLYWHEEL,
    GROUND,
    Body,
    Guide,
    Joint,
    Output,
    distinct_points,
    drawing_size,
)
from exu_press.mechanism.springs import SpringBetween, check_springs
from exu_press.schema.checks import (
    demand_at_least_zero,
    demand_known,
    demand_name,
    demand_number,
    demand_point,
    refuse_unknown,
)

__all__ = ["check_defaults", "check_drawing", "require_kind"]

Kind = TypeVar("Kind")

DEFAULTS = {
    "settle": (int, float),
    "start": (str,),
    **dict.fromkeys(("clearance", "radius"), (int, float)),
    **dict.fromkeys(("joints", "bodies", "contact", "friction", "film"), (Mapping,)),
}
"""Defaults that a mechanism may have for its scenes, and their types."""

SHAPES = ("revolute", "spherical")

RESERVED = {
    GROUND: "the frame",
    DRIVE: "the disc that turns a flexible crank",
    FLYWHEEL: "that of a clutch",
}
"""Names of further bodies of a system, which no body of a drawing may have."""

CHANNEL_NAMES = ("drive", "frame", "guide", "shaking")
BODY_CHANNELS = ("guide", "modes")
OTHER_CHANNELS = ("gear_", "load_", "spring_")
"""Prefixes of channels that belong to no joint; those of a body follow its name."""

PERPENDICULAR = 1e-9
"""Cosine of two directions that counts as a right angle."""


def require_kind(kind: type[Kind], where: str, values: Any) -> tuple[Kind, ...]:
    """Return values as a tuple; raise InputError for the first of another kind."""
    items = tuple(values) if isinstance(values, Iterable) else (values,)
    for item in items:
        if not isinstance(item, kind):
            raise InputError(f"{where}: {item!r:.80} is no {kind.__name__}, which alone is allowed")
    return items


def check_defaults(defaults: Any) -> None:
    """Raise InputError for the first default that no scene may have."""
    if not isinstance(defaults, Mapping):
        raise InputError(f"defaults = {defaults!r}: allowed is a table of keys")
    refuse_unknown("defaults", defaults, DEFAULTS)
    for key, value in defaults.items():
        if not isinstance(value, DEFAULTS[key]):
            types = {str: "a text", float: "a number"}
            kind = types.get(DEFAULTS[key][-1], "a table of keys")
            raise InputError(f"defaults.{key} = {value!r}: allowed is {kind}")
        if key in ("clearance", "radius"):
            demand_at_least_zero(f"defaults.{key}", value, "m", positive=True)
        elif key == "settle":
            demand_at_least_zero("defaults.settle", value)
        else:
            _check_numbers(f"defaults.{key}", value)


def _check_numbers(where: str, value: Any) -> None:
    """Raise InputError for the first number that none of a scene's keys can be."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            _check_numbers(f"{where}.{key}", inner)
    elif isinstance(value, list | tuple):
        for inner in value:
            _check_numbers(where, inner)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        demand_number(where, value)


def check_drawing(
    name: str,
    bodies: Sequence[Body],
    joints: Sequence[Joint],
    guides: Sequence[Guide],
    crank: str,
    output: Output,
    groups: Mapping[str, Sequence[str]],
    counterweight: Sequence[str],
    gears: Sequence[Gear],
    springs: Sequence[SpringBetween],
) -> None:
    """Raise InputError for the first fault of a mechanism's data."""
    if not isinstance(name, str) or not name:
        raise InputError(f"name = {name!r}: allowed is a text")
    names = [body.name for body in bodies]
    if not bodies:
        raise InputError("bodies: none; allowed is at least the crank")
    _check_unique("bodies", names)
    _check_unique("joints", [joint.name for joint in joints])
    _check_unique("guides", [guide.name for guide in guides if not guide.is_slot])
    _check_unique("slots", [guide.name for guide in guides])
    _check_unique("gears", [gear.name for gear in gears])
    _check_unique("springs", [spring.name for spring in springs])
    for name, what in RESERVED.items():
        if name in names:
            raise InputError(f"bodies.{name}: this name means {what}; allowed is another one")
    for body in bodies:
        where = f"bodies.{body.name}"
        demand_at_least_zero(f"{where}.mass", body.mass, "kg", positive=True)
        demand_point(f"{where}.centre_of_mass", body.centre_of_mass)
        demand_number(f"{where}.angle", body.angle)
        if not _is_rod(body):
            demand_at_least_zero(f"{where}.inertia", body.inertia, "kg m^2", positive=True)
    for joint in joints:
        _check_joint(joint, names)
        _check_channels(joint.name, [*names, *(guide.name for guide in guides)])
    for guide in guides:
        pin, slot = ("pin", "slot") if guide.is_slot else ("body", "on")
        _check_known(f"{guide.key}.{pin}", guide.body, names)
        _check_known(f"{guide.key}.{slot}", guide.on, [*names, GROUND])
        if guide.on == guide.body:
            raise InputError(
                f"{guide.key}: guides {guide.body!r} on itself; allowed are two bodies"
            )
        if guide.centre is None:
            _check_direction(f"{guide.key}.direction", guide.direction)
        _check_slot(guide)
    _check_known("crank", crank, names)
    _check_known("output.body", output.body, names)
    _check_direction("output.direction", output.direction)
    if not isinstance(output.rotation, bool):
        raise InputError(f"output.rotation = {output.rotation!r}: allowed is true or false")
    demand_point("output.origin", output.origin)
    for guide in guides:
        if guide.body == output.body and guide.is_rail and output.rotation:
            raise InputError(
                f"output.rotation = true: {guide.key} holds the angle of {output.body}; allowed is "
                "a body that turns"
            )
        if (
            guide.body == output.body
            and guide.is_rail
            and abs(_cosine(guide.direction, output.direction)) < PERPENDICULAR
        ):
            raise InputError(
                f"output.direction = {output.direction!r}: across the guide of {output.body}, "
                "which holds it; allowed is a direction in which it moves"
            )
    _check_groups(groups, [joint.name for joint in joints])
    _check_list("counterweight", counterweight, "bodies")
    for body_name in counterweight:
        _check_known(
            "counterweight", body_name, [n for n in names if n not in (crank, output.body)]
        )
    check_gears(gears, names, crank)
    check_springs(springs, names)
    _check_connections(bodies, joints, guides, crank)


def _check_joint(joint: Joint, names: Collection[str]) -> None:
    where = f"joints.{joint.name}"
    demand_point(f"{where}.at", joint.at)
    _check_known(f"{where}.journal", joint.journal, [*names, GROUND])
    _check_known(f"{where}.bearing", joint.bearing, [*names, GROUND])
    if joint.journal == joint.bearing:
        raise InputError(f"{where}: joins {joint.journal!r} to itself; allowed are two bodies")
    _check_known(f"{where}.shape", joint.shape, SHAPES)


def _check_slot(guide: Guide) -> None:
    """Raise InputError for the first fault of a slot's own data."""
    if not guide.is_slot:
        for key in ("centre", "length", "middle"):
            if getattr(guide, key) is not None:
                raise InputError(f"{guide.key}.{key}: is that of a slot, which has a pin's `at`")
        return
    for key in ("at", "centre", "middle"):
        if key == "at" or getattr(guide, key) is not None:
            demand_point(f"{guide.key}.{key}", getattr(guide, key))
    if guide.centre == guide.at:
        raise InputError(
            f"{guide.key}.centre = {guide.centre!r}: is that of the pin; allowed is the centre of "
            "the circle on which the pin moves"
        )
    if guide.length is not None:
        demand_at_least_zero(f"{guide.key}.length", guide.length, "m", positive=True)


def _check_channels(joint: str, bodies: Sequence[str]) -> None:
    """Refuse a joint whose channels, such as NAME_force, would be those of something else."""
    if joint in bodies:
        raise InputError(f"joints.{joint}: is a body's name too; allowed is another one")
    reserved = {*CHANNEL_NAMES, *(f"{b}_{what}" for b in bodies for what in BODY_CHANNELS)}
    if joint in reserved or joint.startswith(OTHER_CHANNELS):
        raise InputError(
            f"joints.{joint}: {joint}_force is recorded of something else; allowed is another name"
        )


def _check_groups(groups: Mapping[str, Sequence[str]], joints: Sequence[str]) -> None:
    for name, members in groups.items():
        if name in joints:
            raise InputError(f"groups.{name}: is a joint's name too; allowed is another one")
        _check_list(f"groups.{name}", members, "joints")
        if not members:
            raise InputError(f"groups.{name}: is empty; allowed are names of joints")
        _check_unique(f"groups.{name}", members)
        for member in members:
            _check_known(f"groups.{name}", member, joints)


def _check_connections(
    bodies: Sequence[Body], joints: Sequence[Joint], guides: Sequence[Guide], crank: str
) -> None:
    """Refuse bodies on nothing, rods without two ends, and a crank that is not in the frame."""
    pairs = [guide.bodies for guide in guides]
    guided = {name for pair in pairs for name in pair}
    moves_guides = any(crank in pair and GROUND not in pair for pair in pairs)
    size = drawing_size(joints, guides)
    if size == 0.0:
        raise InputError(
            f"crank = {crank!r}: all joints and pins lie on its shaft, so that it moves nothing; "
            "allowed is one beside the shaft"
        )
    for body in bodies:
        ends = [joint.at for joint in joints if body.name in (joint.journal, joint.bearing)]
        ends += [guide.at for guide in guides if guide.body == body.name and guide.at is not None]
        points = distinct_points(ends, size)
        if not points and body.name not in guided:
            raise InputError(f"bodies.{body.name}: no joint and no guide holds it")
        if _is_rod(body) and len(points) != 2:
            raise InputError(
                f"bodies.{body.name}.inertia: missing; allowed is a number > 0 (kg m^2): only a "
                f"body with joints in two places is a uniform rod, this one has {len(points)}"
            )
    is_guided = {crank, GROUND} in pairs
    pairs = [joint.bodies for joint in joints]
    if not (moves_guides or any(crank in pair and GROUND not in pair for pair in pairs)):
        raise InputError(f"crank = {crank!r}: has no joint with another body, which it could move")
    shafts = pairs.count(frozenset((crank, GROUND)))
    if shafts != 1 or is_guided:
        raise InputError(
            f"crank = {crank!r}: has {shafts} joints with the {GROUND}"
            f"{' and a guide' if is_guided else ''}; allowed is one joint, its shaft"
        )
    pins = (joint.at for joint in joints if crank in (joint.journal, joint.bearing))
    if len(distinct_points(pins, size)) == 1 and not moves_guides:
        raise InputError(
            f"crank = {crank!r}: all of its joints lie on its shaft, so that it moves nothing; "
            "allowed is a joint beside the shaft"
        )


def _check_known(where: str, name: Any, known: Iterable[str]) -> None:
    demand_known(f"{where} = {name!r}: unknown", name, known)


def _check_list(where: str, value: Any, what: str) -> None:
    if not isinstance(value, list | tuple):
        raise InputError(f"{where} = {value!r}: allowed is a list of names of {what}")


def _check_unique(where: str, names: Iterable[str]) -> None:
    seen: set[str] = set()
    for name in names:
        demand_name(where, name)
        if name in seen:
            raise InputError(f"{where}.{name}: given twice")
        seen.add(name)


def _is_rod(body: Body) -> bool:
    return isinstance(body.inertia, float) and math.isnan(body.inertia)


def _cosine(a: Sequence[float], b: Sequence[float]) -> float:
    return (a[0] * b[0] + a[1] * b[1]) / (math.hypot(*a) * math.hypot(*b))


def _check_direction(where: str, value: Any) -> None:
    demand_point(where, value)
    if math.hypot(*value) == 0.0:
        raise InputError(f"{where} = {value!r}: allowed is a direction, such as (0, 1)")
