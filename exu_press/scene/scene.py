"""The task: one frozen Scene, validated once."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, cast, overload

from exu_press.errors import (
    InputError,
    MissingKeysError,
    Need,
    UnusedKeyError,
    collected_needs,
    error_prefix,
)
from exu_press.files.digests import recorded_files
from exu_press.mechanism import (
    SHIPPED,
    Guide,
    Mechanism,
    Press,
    SliderCrank,
    mechanism_to_dict,
    press,
    shipped_mechanism,
    slider_crank,
)
from exu_press.mechanism import Joint as Drawn
from exu_press.mechanism.kinematics import MotionError
from exu_press.mechanism.spring_motion import joint_at
from exu_press.mechanism.turning import require_turning
from exu_press.scene.bodies import Flexible, bodies_of
from exu_press.scene.changes import asked_mechanism, by_group, changed_keys, drop, gives_key
from exu_press.scene.joint import oil_of
from exu_press.scene.joints import Joints, joints_of
from exu_press.scene.solver import RPM, Solver
from exu_press.scene.usage import LAWS, TABLES, LawKeys
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind, import_kinds, refusal, with_unresolved
from exu_press.schema.table import Table, given_names, missing_keys, plain, plain_value, table_from

__all__ = ["STARTS", "Scene", "mechanism_of"]

SHORTEST_RUN = 1e-7
"""s, as `solve_dynamic` takes it."""

LONGEST_RUN = 1e9
"""s, thirty years."""

WARM = 3.0
"""Revolutions in which films find their temperature."""

STARTS = ("loaded", "centred")
"""The first one is that of a mechanism without a default of its own."""

ONLY_WHERE_GIVEN = ("drive", "guide", "output", "wear")
"""Tables that a scene without them does not have: constant speed, ideal guides, no samples."""


if TYPE_CHECKING:
    from exu_press.scene.applied_load import AppliedLoad
    from exu_press.scene.guide import ElasticGuide
    from exu_press.scene.load import Load
    from exu_press.scene.motor import Motor
    from exu_press.scene.output import Output
    from exu_press.scene.wear import Wear, WearAt

    class LoadTables:
        """`load`: of the class it reads a file, of a scene it is its [load] tables."""

        @overload
        def __get__(self, scene: None, owner: "type[Scene]") -> "Callable[..., Scene]": ...
        @overload
        def __get__(self, scene: "Scene", owner: "type[Scene]") -> Mapping[str, Load]: ...
        def __get__(self, scene: Any, owner: Any) -> Any: ...
        def __set__(self, scene: "Scene", tables: Mapping[str, Any]) -> None: ...


@dataclasses.dataclass(frozen=True)
class Scene(Table):
    """One simulation, complete: a key that is not given has its default, an unused one is None.

    A table may be given as a mapping or as its dataclass. Angles count from top dead centre.

    Attributes:
        asked: dotted names of the keys that the user gave, be it with their defaults.
        files: sha256 of the files that were read for it, by name.
        origin: begins messages about it: the file that it was loaded from, or nothing.
        guides: name -> guide, of those that are not ideal; [guide.NAME] has its keys over [guide].
        wearing: "joints" and "guides" -> name -> law of wear, of those whose wear is asked for:
            revolute joints whose surfaces touch, guides with clearance, and slots with clearance
            and their pin's diameter.

    Raises:
        InputError: a key is unknown, has a wrong type or a value outside its range, a table or a
            key is not used by this scene, or the links cannot be assembled at some crank angle.
    """

    table: ClassVar[str] = ""
    asked: ClassVar[frozenset[str]]
    files: ClassVar[Mapping[str, str]]
    origin: ClassVar[str] = ""
    guides: ClassVar[Mapping[str, "ElasticGuide"]]
    wearing: ClassVar[Mapping[str, Mapping[str, "WearAt"]]]
    mechanism: str | Mechanism = key(
        "press",
        "the path of a mechanism file, .toml",
        choices=("press", "slider_crank", *SHIPPED),
        also=Mechanism,
    )
    speed_rpm: float = key(
        240.0,
        "crank speed; with [drive] at the start, of the flywheel, or nominal where that is at rest",
        "rpm",
        above=0,
    )
    revolutions: float = key(2.0, "length of the run, at speed_rpm", above=0, at_most=1e7)
    settle: float | None = key(
        None,
        "revolutions before quantities are read; one in a run of two or more (with a motor three), "
        "three where oil warms in a run of four or more, unless given",
        at_least=0,
    )
    start_angle_deg: float = key(0.0, "crank angle at the start", "deg", at_least=-1e5, at_most=1e5)
    start: str | None = key(
        None,
        "journals lie where the loads press them, or in the middle of their bearings",
        choices=STARTS,
        source="where the ideal motion presses them",
    )
    gravity: float = key(9.81, "gravitational acceleration, downwards", "m/s^2", at_least=0)
    joints: Joints = dataclasses.field(default=cast(Any, None))  # until its mechanism is known
    bodies: Mapping[str, Flexible] = dataclasses.field(default_factory=dict, hash=False)
    contact: Mapping[str, Any] | None = dataclasses.field(default=None, hash=False)
    friction: Mapping[str, Any] | None = dataclasses.field(default=None, hash=False)
    film: Mapping[str, Any] | None = dataclasses.field(default=None, hash=False)
    load: "LoadTables" = dataclasses.field(default_factory=cast(Any, dict), hash=False)
    drive: "Motor | None" = None
    guide: "ElasticGuide | None" = None
    output: "Output | None" = None
    wear: "Wear | None" = None
    solver: Solver = dataclasses.field(default=cast(Any, None))  # until it is completed
    press: Press | None = None
    slider_crank: SliderCrank | None = None

    def __post_init__(self) -> None:
        """Check the keys, refuse those that the scene does not use and fill in the others."""
        with recorded_files() as files:
            self._complete()
        object.__setattr__(self, "files", files)

    def _complete(self) -> None:
        """Check and complete every key."""
        object.__setattr__(self, "asked", frozenset(given_names(self.given_values)))
        object.__setattr__(self, "mechanism", asked_mechanism(self.mechanism))
        super().__post_init__()
        if not SHORTEST_RUN <= self.duration <= LONGEST_RUN:
            raise InputError(
                f"revolutions = {self.revolutions:g} at speed_rpm = {self.speed_rpm:g} is a run of "
                f"{self.duration:g} s: allowed are {SHORTEST_RUN:g} to {LONGEST_RUN:g} s"
            )
        shortest = SHORTEST_RUN * self.speed_rpm / 60.0
        if self.settle is not None and self.revolutions - self.settle < shortest:
            raise InputError(
                f"settle = {self.settle!r}: allowed is a number < revolutions = "
                f"{self.revolutions!r} by {shortest:.2g} or more, or nothing is left to read"
            )
        shown_name = repr(self.mechanism) if self.shipped_name else "the scene's own"
        dimensions = {"press", "slider_crank"} - {self.shipped_name}
        unused = dict.fromkeys(dimensions, f"mechanism is {shown_name}")
        needs: list[Need] = []
        for name in TABLES:
            table = getattr(self, name)
            if name in LAWS:  # their defaults are the mechanism's
                continue
            self._refuse(name, table, unused.get(name, ""))
            if table is None and (name in unused or name in ONLY_WHERE_GIVEN):
                continue
            object.__setattr__(self, name, None)
            with collected_needs(needs):
                table = table_from(TABLES[name], name, {} if table is None else table)
                object.__setattr__(self, name, table)
        sampled = self.output is not None and self.output.samples
        if sampled and self.solver.step is not None:
            raise InputError(
                "output.samples: allowed with solver.tolerance, as fixed steps end on a grid"
            )
        readings = None if self.output is None else self.output.readings
        if readings is not None and readings.average_deg and self.drive is not None:
            raise InputError(
                "output.readings.average_deg: allowed at constant speed; with [drive] give "
                "output.readings.average, in s"
            )
        self._check_start_stop()
        self._settle_guides()
        with collected_needs(needs):
            needs += self._settle_joints()
        for settle in (self._settle_bodies, self._settle_wear, self._settle_loads):
            with collected_needs(needs):
                settle()
        if needs:
            raise MissingKeysError(needs)

    def _check_start_stop(self) -> None:
        """Refuse keys that do not go with a press that starts or stops."""
        motor = self.drive
        if motor is None or not motor.has_schedule:
            return
        if self.settle:
            raise InputError(
                f"settle = {self.settle:g}: allowed is 0 with a [drive] that starts or stops, "
                "which is read from its start"
            )
        stop = None
        if motor.clutch is not None and motor.clutch.stop is not None:
            stop = motor.clutch.stop.stop_angle_deg
        if stop is not None and stop <= self.start_angle_deg:
            raise InputError(
                f"drive.stop_angle_deg = {stop:g}: allowed is a number > start_angle_deg = "
                f"{self.start_angle_deg:g}, as it goes on over revolutions"
            )

    def _settle_guides(self) -> None:
        """Complete the guides that are not ideal."""
        object.__setattr__(self, "guides", {})
        if self.guide is None:
            return
        from exu_press.scene.guides import guides_of

        table, guides = guides_of(self.guide, mechanism_of(self))
        object.__setattr__(self, "guide", table)
        object.__setattr__(self, "guides", guides)

    def _settle_joints(self) -> list[Need]:
        """Complete every joint of the mechanism, and return which keys joints and guides lack."""
        mechanism = mechanism_of(self)
        usual = mechanism.defaults
        tables = usual.get("joints", {}) if self.joints is None else self.joints
        object.__setattr__(self, "joints", None)
        _require_turning(mechanism)
        laws = LawKeys(self.laws, usual, self._law_tables(tables))
        if not self.shipped_name:  # a drawing of the user's own, which may hold what no joint uses
            for law in LAWS.keys() & usual.keys():
                with error_prefix("defaults."):
                    laws.keys_of(law)
        joints, needs = joints_of(tables, mechanism, laws)
        object.__setattr__(self, "joints", joints)
        unused = joints.unused_laws()
        self._refuse("start", self.start, unused.get("start", ""))
        if self.start is None and "start" not in unused:
            object.__setattr__(self, "start", usual.get("start", STARTS[0]))
        for guide in self._guide_tables:
            guide.take_laws(laws.keys_of)
        for law in LAWS:
            self._settle_law(law, laws, unused.get(law, ""))
        for name, guide in self.guides.items():
            self._check_guide(mechanism.guide(name), guide)
            missing = self._missing_keys_of_guide(name, guide)
            needs += missing
            if not missing:
                guide.check_laws()
        return needs

    def _missing_keys_of_guide(self, name: str, guide: "ElasticGuide") -> list[Need]:
        """Return which keys of its oil and of [contact] a guide needs."""
        needs: list[Need] = []
        if guide.oil is not None:
            path = self.guide_key(name, "viscosity")
            table = path.rpartition(".")[0]
            needs += missing_keys(path, guide.oil, (), table, f"[{table}]")
        if guide.contact is not None:
            path = self.guide_key(name, "clearance")
            needs += missing_keys(path, guide.contact, (), "contact", "[contact]")
        return needs

    def guide_key(self, guide: str, key: str) -> str:
        """Return the dotted name of a key of a guide, which is [guide]'s or its own."""
        own = self.guide is not None and key in self.guide.by_name.get(guide, ())
        return f"guide.{guide}.{key}" if own else f"guide.{key}"

    def _check_guide(self, drawn: Guide, guide: "ElasticGuide") -> None:
        """Raise InputError unless a guide can be as it is to be: a slot can have clearance."""
        if not drawn.is_slot or guide.kind == "dry":
            return
        ideal = f"or an ideal one, by guide.{drawn.name} = {{kind = 'ideal', friction = 'none'}}"
        if guide.oil is not None:
            raise InputError(
                f"{self.guide_key(drawn.name, 'viscosity')}: {drawn.key} holds a pin, which has no "
                "face for a film; allowed is a block there: a pin joint with a film, and a guide; "
                f"{ideal}"
            )
        raise InputError(
            f"[guide]: {drawn.key} holds a pin; allowed there is clearance without oil, {ideal}"
        )

    def _law_tables(self, joints: Any) -> Iterator[tuple[str, Mapping[str, Any]]]:
        """Yield law and keys of joints and guides, which may name laws of their own."""
        for table in joints.values() if isinstance(joints, Mapping) else ():
            for law in LAWS:
                keys = table.get(law) if isinstance(table, Mapping) else None
                if isinstance(keys, Mapping):
                    yield law, keys
        for guide in self._guide_tables:
            yield "friction", {"law": guide.friction.kind}

    def _settle_law(self, law: str, laws: LawKeys, unused: str) -> None:
        """Complete a law's keys; refuse those unused, with the reason why no joint has the law."""
        of_guides = {}
        if law != "film" and self._guide_tables:
            of_guides = self.law_keys_of_guides(law)
        used = {**self.joints.law_keys(law), **of_guides}
        if not of_guides:
            self._refuse(law, laws.scene_keys[law], unused)
        for name, value in (laws.scene_keys[law] or {}).items():
            if name not in used and value is not None:
                reason = f"{unused}, and guides do not use it" if unused else ""
                reason = reason or self.joints.unused_reason(
                    law, name, laws.keys_of(law), self.joints
                )
                path, value = f"{law}.{name}", plain_value(laws.keys_of(law)[name])
                raise UnusedKeyError(path, f"{path} = {value!r}", reason)
        keys = {name: laws.keys_of(law).get(name, field.default) for name, field in used.items()}
        keys = {name: value for name, value in keys.items() if value is not None}
        object.__setattr__(self, law, keys if used else None)

    def law_keys_of_guides(self, law: str) -> dict[str, Any]:
        """Return the keys of [contact] or [friction] that guides use, with declarations."""
        used: dict[str, Any] = {}
        for guide in self._guide_tables:
            used |= guide.law_keys(law)
        return used

    @property
    def _guide_tables(self) -> "list[ElasticGuide]":
        """The guides that are not ideal; [guide] where there are none."""
        return [*self.guides.values()] or ([] if self.guide is None else [self.guide])

    def _settle_wear(self) -> None:
        """Complete the wear of each place; a scene in which nothing wears has no such table."""
        object.__setattr__(self, "wearing", {"joints": {}, "guides": {}})
        if self.wear is None or not self.joints:
            return
        mechanism = mechanism_of(self)
        joints = {joint.name: self._why_unworn(joint) for joint in mechanism.joints}
        guides = {
            g.name: f"{g.key} has no clearance"
            if g.guideway is None
            else f"{self.guide_key(g.name, 'width')} = 0: {g.key} holds a pin of that diameter"
            if g.is_slot and g.guideway.half_width == 0.0
            else ""
            for g in mechanism.guides
        }
        if all((*joints.values(), *guides.values())):
            why = (
                "no revolute joint is dry or has a mixed film, and no guide has clearance, nor a "
                "slot clearance and its pin's diameter, guide.width"
            )
            self._refuse("wear", self.wear, why)
        wear, wearing = self.wear.check_places(joints, guides, mechanism.groups)
        object.__setattr__(self, "wear", wear)
        object.__setattr__(self, "wearing", wearing)

    def _why_unworn(self, drawn: Drawn) -> str:
        """Return why a joint does not wear, or nothing."""
        if drawn.spherical:
            return f"joints.{drawn.name} is a ball"
        rubs = self.joints[drawn.name].onset is not None
        return "" if rubs else f"surfaces of joints.{drawn.name} do not touch"

    def _settle_bodies(self) -> None:
        """Complete the flexible bodies."""
        mechanism = mechanism_of(self)
        bodies = bodies_of(self.bodies, mechanism)
        motor = self.drive
        if mechanism.crank in bodies and motor is not None and motor.on_crank == 0.0:
            raise InputError(
                f"drive.driven_inertia = 0.0: allowed is a number > 0 with a flexible "
                f"{mechanism.crank}, which a disc of this inertia turns"
            )
        object.__setattr__(self, "bodies", bodies)
        for gear in mechanism.gears:
            for body in {gear.body, gear.to} & (bodies.keys() - {mechanism.crank}):
                raise InputError(
                    f"gears.{gear.name}: bodies.{body} is flexible; allowed is a gear between "
                    "rigid bodies, or from the crank"
                )
        for spring in mechanism.springs:
            for body, at in zip(spring.between, spring.at, strict=True):
                if body in bodies and joint_at(mechanism, body, at) is None:
                    raise InputError(
                        f"springs.{spring.name}: bodies.{body} is flexible; allowed is an end in "
                        "the centre of one of its joints"
                    )
        for drawn in mechanism.joints if self.joints else ():  # none where they lack keys
            worn = self.joints[drawn.name].worn
            for body in (drawn.journal, drawn.bearing):
                if worn is not None and body in bodies:
                    raise InputError(
                        f"joints.{drawn.name}.worn: bodies.{body} is flexible; allowed is a "
                        "worn joint between rigid bodies"
                    )

    def _settle_loads(self) -> None:
        """Complete the loads; tables of forces are read."""
        if not self.load:
            object.__setattr__(self, "load", {})
            return
        from exu_press.scene.loads import loads_of

        mechanism = mechanism_of(self)
        loads = loads_of(self.load, mechanism, self.bodies, self.speed_rpm)
        for name, load in loads.items():
            if mechanism.output.rotation and load.over in ("height", "penetration"):
                raise InputError(
                    f"load.{name}: acts over the output's height, a rotation here; allowed are "
                    "loads over time and crank angle"
                )
        object.__setattr__(self, "load", loads)

    @classmethod
    def from_dict(
        cls, data: Mapping[str, Any], asked: Iterable[str] = (), *, resolve: bool = True
    ) -> "Scene":
        """Return the scene of a nested mapping, as a scene file holds it.

        Args:
            data: its tables.
            asked: as above.
            resolve: False takes kinds whose code is not loaded for ones that are shown, not built.
        """
        scene = table_from(cls, "", data if resolve else with_unresolved(data))
        object.__setattr__(scene, "asked", frozenset(asked))
        return scene

    @classmethod
    def from_result(cls, data: Mapping[str, Any], asked: Iterable[str]) -> "Scene":
        """Return the scene of a result, without keys that have no use, as earlier versions took.

        Kinds whose code is not loaded are shown, not built.
        """
        tables = dict(data)
        while True:
            try:
                return cls.from_dict(tables, asked, resolve=False)
            except UnusedKeyError as error:
                if error.name not in given_names(tables):
                    raise
                drop(tables, error.name)

    def to_dict(self) -> dict[str, Any]:
        """Return the complete scene as a nested mapping, for Scene.from_dict or a file."""
        complete: dict[str, Any] = {}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if isinstance(value, Joints):
                complete[field.name] = value.to_dict(self.laws)
            elif field.name in LAWS and value is not None:
                complete[field.name] = {name: plain_value(inner) for name, inner in value.items()}
            elif field.name in ("load", "bodies"):
                tables = {name: table.to_dict() for name, table in value.items()}
                complete |= {field.name: tables} if tables else {}
            elif isinstance(value, Table):
                complete[field.name] = plain(value)
            elif isinstance(value, Mechanism):
                complete[field.name] = mechanism_to_dict(value)
            elif value is not None:
                complete[field.name] = value
        return complete

    def save(self, path: str | Path, *, comments: bool = False, overwrite: bool = False) -> None:
        """Write the complete scene as TOML, for `Scene.load` and the command line.

        Args:
            path: of the file.
            comments: write meaning and unit behind every key.
            overwrite: replace an existing file, whose own comments would be lost.

        Raises:
            InputError: the file exists, or cannot be written.
        """
        from exu_press.scene.save import save_scene

        save_scene(self, path, comments=comments, overwrite=overwrite)

    def replace(self, changes: Mapping[str, Any]) -> "Scene":
        """Return the scene with other values: replace({"film.viscosity": 0.1}).

        The keys that the changed scene does not use are dropped (a scene made dry loses its film),
        but for those that the change itself names.

        Args:
            changes: dotted name of a key or table -> its value; None leaves it out.

        Raises:
            InputError: they are no such mapping, or the changed scene is not allowed.
        """
        if not isinstance(changes, Mapping) or not all(isinstance(name, str) for name in changes):
            raise InputError(f"{changes!r:.200}: allowed is a mapping of dotted names to values")
        if changes.get("mechanism", "") is None:  # the usual one
            changes = {**changes, "mechanism": Scene.mechanism}
        data, groups = self.to_dict(), self.joints.groups
        still_asked = [
            n for n in self.asked if not any(f"{n}.".startswith(f"{c}.") for c in changes)
        ]
        asked = frozenset([*still_asked, *given_names(changes)])
        if (mechanism := changes.get("mechanism", self.mechanism)) != self.mechanism:
            scene = Scene.from_dict({"mechanism": mechanism})
            same = {name: joint for name, joint in self.joints.items() if name in scene.joints}
            data["joints"] = {
                **scene.joints.to_dict(scene.laws),
                **{name: joint.to_dict(self.laws) for name, joint in same.items()},
            }
            own = {"start": STARTS[0], **mechanism_of(self).defaults}  # the other has its own
            if self.start == own["start"]:
                data.pop("start", None)
            for name in same:
                data["joints"][name] = _differing_keys(data["joints"][name], own)
            for name in LAWS:
                if name in data:
                    data[name] = _differing_keys(data[name], own.get(name, {}))
            groups, asked = scene.joints.groups, frozenset(given_names(changes))
            drawn = mechanism_of(scene)
            if self.guide is not None:
                gone = self.guide.by_name.keys() - {guide.name for guide in drawn.guides}
                data["guide"] = {n: k for n, k in data["guide"].items() if n not in gone}
            there = {body.name for body in drawn.bodies}
            data["bodies"] = {n: k for n, k in data.get("bodies", {}).items() if n in there}
        data = changed_keys(data, groups, changes)
        while True:
            try:
                scene = Scene.from_dict(data, asked, resolve=not self.has_unresolved_kinds)
                return _from_files(scene, self.files, self.origin)
            except MissingKeysError as error:
                needs = [(by_group(path, groups, changes), text) for path, text in error.needs]
                raise MissingKeysError(needs) from None
            except InputError as error:
                if not isinstance(error, UnusedKeyError) or gives_key(error.name, groups, changes):
                    raise InputError(by_group(str(error), groups, changes)) from None
                drop(data, error.name)

    def _repr_html_(self) -> str:
        """Return the scene in words and the keys it gives, for notebooks."""
        from exu_press import cell

        return cell(self)

    def build(self) -> Any:  # a Model, of which a scene knows nothing
        """Return the assembled `exu_press.model.Model`; its mbs and SC are the real Exudyn objects.

        Every body has graphics for Exudyn's own renderer and SolutionViewer.
        """
        from exu_press import build_with_graphics

        return build_with_graphics(self)

    @property
    def has_unresolved_kinds(self) -> bool:
        """Whether a kind is code that is not loaded: the scene can be shown, and not built."""
        return any(not kind.resolved for _, kind in self.kinds())

    def require_code(self) -> None:
        """Raise InputError for a kind whose code is not loaded."""
        for name, kind in self.kinds():
            if not kind.resolved:
                raise InputError(f"{name} = {kind.kind!r}: {refusal(kind.kind)}")

    def kinds(self) -> Iterator[tuple[str, CustomKind]]:
        """Yield the joints, loads and laws, by the keys that name their kinds."""
        for name, joint in self.joints.items():
            yield from ((f"joints.{name}.{path}", kind) for path, kind in joint.kinds().items())
        yield from ((f"load.{name}.kind", load) for name, load in self.load.items())
        for name, guide in self.guides.items():
            yield self.guide_key(name, "friction"), guide.friction
            if guide.contact is not None:
                yield "contact.damping", guide.contact.damping

    @cached_property
    def applied_loads(self) -> "dict[str, AppliedLoad]":
        """The loads on their mechanism that are not zero throughout, by name."""
        loads = {
            name: load.applied_load(
                mechanism_of(self), self.angular_speed, motor=self.drive is not None
            )
            for name, load in self.load.items()
        }
        # the peak of a load of a result may be unknown
        return {name: load for name, load in loads.items() if not load.curve.peak <= 0.0}

    def __getstate__(self) -> dict[str, Any]:
        """Return what other processes get: no applied loads, whose curves may be a user's own."""
        return {name: value for name, value in vars(self).items() if name != "applied_loads"}

    @property
    def shipped_name(self) -> str:
        """Name of the shipped mechanism; empty where the scene has its own."""
        return self.mechanism if isinstance(self.mechanism, str) else ""

    @property
    def laws(self) -> dict[str, Mapping[str, Any] | None]:
        """Keys of contact, friction and film of every joint that does not say otherwise."""
        return {name: getattr(self, name) for name in LAWS}

    @property
    def angular_speed(self) -> float:
        """Crank speed, rad/s; with a motor that of the start."""
        return self.speed_rpm * RPM

    @property
    def start_speed(self) -> float:
        """Crank speed at the start, rad/s."""
        return 0.0 if self.drive is not None and self.drive.stands else self.angular_speed

    @property
    def pin_speed(self) -> float:
        """Speed of the crank pin, m/s."""
        return self.angular_speed * mechanism_of(self).crank_radius

    @property
    def settle_revolutions(self) -> float:
        """Revolutions before quantities are read."""
        if self.settle is not None:
            return self.settle
        if self.drive is not None and self.drive.has_schedule:
            return 0.0
        usual = mechanism_of(self).defaults.get("settle", 1.0)
        if self.warms and self.revolutions >= WARM + 1.0:
            usual = max(usual, WARM)
        least = 2.0 if self.drive is None else 3.0  # a motor may lag behind its revolutions
        return float(usual) if self.revolutions >= least else 0.0

    @property
    def warms(self) -> bool:
        """Whether the oil of a film warms."""
        return any(oil_of(joint) is not None for joint in self.joints.values())

    def read_later(self, revolutions: float) -> "Scene":
        """Return a scene that settles, and ends, so many revolutions later."""
        changes = {"settle": self.settle_revolutions, "revolutions": self.revolutions}
        return self.replace({name: value + revolutions for name, value in changes.items()})

    @property
    def duration(self) -> float:
        """Length of the run, s."""
        return self.revolutions * 60 / self.speed_rpm

    @property
    def start_angle(self) -> float:
        """Crank angle at the start, rad from top dead centre."""
        return math.radians(self.start_angle_deg)

    @staticmethod
    def _refuse(name: str, value: Any, reason: str) -> None:
        if value is not None and reason:
            text = f"[{name}]" if name in TABLES else f"{name} = {value!r}"
            raise UnusedKeyError(name, text, reason)


def _load(path: str | Path, assignments: Iterable[str] = (), *, allow_code: bool = False) -> Scene:
    """Return the scene of a TOML file, changed by "key=value" assignments.

    Args:
        path: of the file.
        assignments: as behind `--set`, for `parse_assignment`.
        allow_code: import the modules that kinds of joints name; they run with the user's rights.

    Raises:
        InputError: the file cannot be read or parsed, or the scene is not allowed.
    """
    from exu_press.scene.file import parse_assignment, scene_tables

    path = Path(path)
    with recorded_files() as files:
        data = scene_tables(path)
    changes = dict(map(parse_assignment, assignments))
    with error_prefix(f"{path}: "):
        if allow_code:
            import_kinds(data)
        scene = _from_files(Scene.from_dict(data, given_names(data)), files, f"{path}: ")
    with error_prefix(f"{path.name} with --set: "):
        if allow_code:
            import_kinds(changes)
        return scene.replace(changes) if changes else scene


def _from_files(scene: Scene, files: Mapping[str, str], origin: str) -> Scene:
    """Return a scene for which further files were read."""
    object.__setattr__(scene, "files", {**files, **scene.files})
    object.__setattr__(scene, "origin", origin)
    return scene


def _require_turning(mechanism: Mechanism) -> None:
    """Refuse a mechanism whose crank does not turn, with all that its examination finds."""
    try:
        require_turning(mechanism)
    except MotionError as refusal:
        from exu_press.mechanism.examine import explain_motion_error

        raise explain_motion_error(mechanism, refusal) from None


type.__setattr__(Scene, "load", staticmethod(_load))  # of a scene `load` has its [load] tables


def mechanism_of(scene: Scene) -> Mechanism:
    """Return the mechanism of a scene, with the guides and the flywheel that it asks for."""
    if isinstance(scene.mechanism, Mechanism):
        drawn = scene.mechanism
    elif scene.press is not None:
        drawn = press(scene.press)
    elif scene.slider_crank is not None:
        drawn = slider_crank(scene.slider_crank)
    else:
        drawn = shipped_mechanism(scene.mechanism)
    if scene.drive is not None:
        drawn = _with_flywheel(drawn, scene.drive.on_crank)
    if not scene.guides:
        return drawn
    from exu_press.scene.guides import with_elastic_guides

    return with_elastic_guides(drawn, scene.guides)


def _differing_keys(keys: Mapping[str, Any], usual: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in keys.items() if usual.get(key) != value}


def _with_flywheel(drawn: Mechanism, inertia: float) -> Mechanism:
    """Return a mechanism whose crank has a flywheel's inertia, kg m^2, beside its own."""
    bodies = tuple(
        dataclasses.replace(body, inertia=body.inertia + inertia)
        if body.name == drawn.crank
        else body
        for body in drawn.bodies
    )
    return dataclasses.replace(drawn, bodies=bodies)
