"""A planar mechanism as plain data, checked before anything is computed of it."""

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
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
    Point,
    distinct_points,
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

__all__ = ["Drawing", "require_kind"]

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


@dataclass(frozen=True)
class Drawing:
    """Bodies, joints and guides in the coordinates of one assembled drawing, y upwards.

    A joint has one position, common to both of its bodies, so that the drawing closes by itself.
    Crank angles count from the crank's angle in the drawing, counter-clockwise.

    Attributes:
        name: for messages and pictures.
        bodies: in the order of the result's body channels.
        joints: ideal or with clearance, as a scene says.
        guides: in the frame, or between moving bodies.
        gears: between two bodies' rotations.
        springs: between points of two bodies, or of a body and the frame.
        crank: name of the driven body.
        output: whose motion the result's slider channels record.
        groups: name -> joints that a scene can address together.
        counterweight: names of balancing bodies; the shaking force is recorded without them, too.
        defaults: keys of its scenes: "start", "settle", "clearance" and "radius" of a joint,
            "joints" with their kinds where a scene names none, "contact", "friction" and "film";
            "bodies" with their shipped parts or STEP files, which comparisons take as flexible.
    """

    name: str
    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    guides: tuple[Guide, ...]
    crank: str
    output: Output
    groups: Mapping[str, tuple[str, ...]] = field(default_factory=dict, hash=False)
    counterweight: tuple[str, ...] = ()
    defaults: Mapping[str, Any] = field(default_factory=dict, hash=False)
    gears: tuple[Gear, ...] = ()
    springs: tuple[SpringBetween, ...] = ()

    @property
    def size(self) -> float:
        """Largest distance of two joints or pins along x or y in the drawing, m."""
        points = [joint.at for joint in self.joints]
        points += [guide.at for guide in self.guides if guide.at is not None]
        return max((max(values) - min(values) for values in zip(*points, strict=True)), default=0.0)

    def joints_of(self, body: str) -> list[Joint]:
        """Return the joints of a body."""
        return [joint for joint in self.joints if body in (joint.journal, joint.bearing)]

    def held_points(self, body: str) -> list[Point]:
        """Return the places of a body's joints and pins in the drawing, each of them once."""
        pins = [guide.at for guide in self.guides if guide.body == body and guide.at is not None]
        return distinct_points([*(joint.at for joint in self.joints_of(body)), *pins], self.size)

    def check(self) -> None:
        """Raise InputError for the first fault of the data."""
        if not isinstance(self.name, str) or not self.name:
            raise InputError(f"name = {self.name!r}: allowed is a text")
        names = [body.name for body in self.bodies]
        if not names:
            raise InputError("bodies: none; allowed is at least the crank")
        _check_unique("bodies", names)
        _check_unique("joints", [joint.name for joint in self.joints])
        _check_unique("guides", [guide.name for guide in self.guides if not guide.is_slot])
        _check_unique("slots", [guide.name for guide in self.guides])
        _check_unique("gears", [gear.name for gear in self.gears])
        _check_unique("springs", [spring.name for spring in self.springs])
        for name, what in RESERVED.items():
            if name in names:
                raise InputError(f"bodies.{name}: this name means {what}; allowed is another one")
        for body in self.bodies:
            where = f"bodies.{body.name}"
            demand_at_least_zero(f"{where}.mass", body.mass, "kg", positive=True)
            demand_point(f"{where}.centre_of_mass", body.centre_of_mass)
            demand_number(f"{where}.angle", body.angle)
            if not _is_rod(body):
                demand_at_least_zero(f"{where}.inertia", body.inertia, "kg m^2", positive=True)
        for joint in self.joints:
            _check_joint(joint, names)
            _check_channels(joint.name, [*names, *(guide.name for guide in self.guides)])
        for guide in self.guides:
            _check_guide(guide, names)
        _check_known("crank", self.crank, names)
        self._check_output(names)
        _check_groups(self.groups, [joint.name for joint in self.joints])
        _check_list("counterweight", self.counterweight, "bodies")
        free = [name for name in names if name not in (self.crank, self.output.body)]
        for name in self.counterweight:
            _check_known("counterweight", name, free)
        check_gears(self.gears, names, self.crank)
        check_springs(self.springs, names)
        self._check_connections()
        _check_defaults(self.defaults)

    def _check_output(self, names: Collection[str]) -> None:
        output = self.output
        _check_known("output.body", output.body, names)
        _check_direction("output.direction", output.direction)
        if not isinstance(output.rotation, bool):
            raise InputError(f"output.rotation = {output.rotation!r}: allowed is true or false")
        demand_point("output.origin", output.origin)
        for guide in self.guides:
            if guide.body != output.body or not guide.is_rail:
                continue
            if output.rotation:
                raise InputError(
                    f"output.rotation = true: {guide.key} holds the angle of {output.body}; "
                    "allowed is a body that turns"
                )
            if abs(_cosine(guide.direction, output.direction)) < PERPENDICULAR:
                raise InputError(
                    f"output.direction = {output.direction!r}: across the guide of {output.body}, "
                    "which holds it; allowed is a direction in which it moves"
                )

    def _check_connections(self) -> None:
        """Refuse bodies on nothing, rods without two ends, and a crank that is not in the frame."""
        crank, of_guides = self.crank, [guide.bodies for guide in self.guides]
        moves_others = any(crank in pair and GROUND not in pair for pair in of_guides) or any(
            gear.to == crank for gear in self.gears
        )
        if self.size == 0.0:
            raise InputError(
                f"crank = {crank!r}: all joints and pins lie on its shaft, so that it moves "
                "nothing; allowed is one beside the shaft"
            )
        for body in self.bodies:
            points = self.held_points(body.name)
            if not points and not any(body.name in pair for pair in of_guides):
                raise InputError(f"bodies.{body.name}: no joint and no guide holds it")
            if _is_rod(body) and len(points) != 2:
                raise InputError(
                    f"bodies.{body.name}.inertia: missing; allowed is a number > 0 (kg m^2): only "
                    "a body with joints in two places is a uniform rod, this one has "
                    f"{len(points)}"
                )
        pairs = [joint.bodies for joint in self.joints]
        if not (moves_others or any(crank in pair and GROUND not in pair for pair in pairs)):
            raise InputError(
                f"crank = {crank!r}: has no joint, guide or gear with another body, which it could "
                "move"
            )
        shafts, is_guided = pairs.count(frozenset((crank, GROUND))), {crank, GROUND} in of_guides
        if shafts != 1 or is_guided:
            raise InputError(
                f"crank = {crank!r}: has {shafts} joints with the {GROUND}"
                f"{' and a guide' if is_guided else ''}; allowed is one joint, its shaft"
            )
        pins = (joint.at for joint in self.joints_of(crank))
        if len(distinct_points(pins, self.size)) == 1 and not moves_others:
            raise InputError(
                f"crank = {crank!r}: all of its joints lie on its shaft, so that it moves nothing; "
                "allowed is a joint beside the shaft"
            )


def _check_defaults(defaults: Any) -> None:
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


def _check_joint(joint: Joint, names: Collection[str]) -> None:
    where = f"joints.{joint.name}"
    demand_point(f"{where}.at", joint.at)
    _check_known(f"{where}.journal", joint.journal, [*names, GROUND])
    _check_known(f"{where}.bearing", joint.bearing, [*names, GROUND])
    if joint.journal == joint.bearing:
        raise InputError(f"{where}: joins {joint.journal!r} to itself; allowed are two bodies")
    _check_known(f"{where}.shape", joint.shape, SHAPES)


def _check_guide(guide: Guide, names: Collection[str]) -> None:
    """Raise InputError for the first fault of a guide's or a slot's own data."""
    pin, slot = ("pin", "slot") if guide.is_slot else ("body", "on")
    _check_known(f"{guide.key}.{pin}", guide.body, names)
    _check_known(f"{guide.key}.{slot}", guide.on, [*names, GROUND])
    if guide.on == guide.body:
        raise InputError(f"{guide.key}: guides {guide.body!r} on itself; allowed are two bodies")
    if guide.centre is None:
        _check_direction(f"{guide.key}.direction", guide.direction)
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
