"""What is asked: one frozen Scene, checked once at the door."""

import dataclasses
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from exu_press.errors import InputError
from exu_press.scene.checks import Table, key, table_from
from exu_press.scene.laws import contact_law, film_law, friction_law
from exu_press.scene.tables import (
    Blanking,
    Clearance,
    Contact,
    ElasticGuide,
    Film,
    Flexible,
    Friction,
    Press,
    SliderCrank,
    Solver,
)

if TYPE_CHECKING:
    from exu_press.model import Model

__all__ = ["Scene"]

DEFAULT_CLEARANCE = 1e-4  # m, Table 2
RPM = math.pi / 30  # rad/s

PARTS_ARE_MADE_FOR = {
    "crank_radius": 0.03,
    "linkage_length": 0.383,
    "crank_mass": 217.6,
    "linkage_mass": 184.5,
}

OF_THE_COUNTERWEIGHT = (
    "counter_eccentricity",
    "counter_linkage_length",
    "counter_linkage_mass",
    "counterweight_mass",
)

TABLES = {
    "clearance": Clearance,
    "contact": Contact,
    "friction": Friction,
    "film": Film,
    "blanking": Blanking,
    "guide": ElasticGuide,
    "flexible": Flexible,
    "solver": Solver,
    "press": Press,
    "slider_crank": SliderCrank,
}

ONLY_WHERE_GIVEN = ("blanking", "guide")
"""Tables that a scene without them does not have: no load, ideal guides."""


@dataclasses.dataclass(frozen=True)
class Scene(Table):
    """One simulation, complete: what is not given has its default, what is not used is None.

    A table may be given as a mapping or as its dataclass. Angles count from top dead centre.

    Raises:
        InputError: a key is unknown, has a wrong type or a value outside its range, a table or a
            key is not used by this scene, or the links cannot be assembled at some crank angle.
    """

    table: ClassVar[str] = ""
    mechanism: str = key("press", "mechanism", choices=("press", "slider_crank"))
    bodies: str = key("rigid", "bodies", choices=("rigid", "flexible"))
    crank_pin: str = key("lubricated", "joint 2-3", choices=("ideal", "dry", "lubricated"))
    balls: str | None = key(None, "joints 9-10, press only", choices=("ideal", "dry"))
    speed_rpm: float = key(240.0, "crank speed", "rpm", above=0)
    revolutions: float = key(2.0, "length of the run", above=0)
    start_angle_deg: float = key(0.0, "crank angle at the start", "deg")
    gravity: float = key(9.81, "gravitational acceleration, downwards", "m/s^2", at_least=0)
    clearance: Clearance | None = None
    contact: Contact | None = None
    friction: Friction | None = None
    film: Film | None = None
    blanking: Blanking | None = None
    guide: ElasticGuide | None = None
    flexible: Flexible | None = None
    solver: Solver | None = None
    press: Press | None = None
    slider_crank: SliderCrank | None = None

    def __post_init__(self) -> None:
        """Check the keys, refuse what the scene does not use and fill in what it does."""
        super().__post_init__()
        if self.mechanism == "press" and self.balls is None:
            object.__setattr__(self, "balls", "dry")
        unused = _unused({field.name: getattr(self, field.name) for field in _fields(self)})
        self._refuse(unused, "balls", self.balls)
        for name, table in TABLES.items():
            given = getattr(self, name)
            if given is not None:
                self._refuse(unused, name, given)
                checked: Table = table_from(table, name, given)
                object.__setattr__(self, name, checked)
                for field in _fields(checked):
                    if (value := getattr(checked, field.name)) != field.default:
                        self._refuse(unused, f"{name}.{field.name}", value)
            elif name not in unused and name not in ONLY_WHERE_GIVEN:
                object.__setattr__(self, name, table())
        if self.clearance is not None:
            object.__setattr__(self, "clearance", self._all_clearances(self.clearance, unused))
        self._check_laws()
        self._check_geometry()

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> "Scene":
        """Return the scene of a nested mapping, as a scene file holds it."""
        return table_from(cls, "", data)

    def to_dict(self) -> dict[str, Any]:
        """Return the complete scene as a nested mapping, for Scene.from_dict or a file."""

        def given(table: Mapping[str, Any]) -> dict[str, Any]:
            return {k: v for k, v in table.items() if v is not None}

        nested = given(dataclasses.asdict(self))
        return {k: given(v) if isinstance(v, dict) else v for k, v in nested.items()}

    def save(self, path: str | Path, *, comments: bool = False, overwrite: bool = False) -> None:
        """Write the complete scene as TOML, for `load_scene` and the command line.

        Args:
            path: of the file.
            comments: write meaning and unit behind every key.
            overwrite: replace an existing file, whose own comments would be lost.

        Raises:
            InputError: the file exists, or cannot be written.
        """
        from exu_press.scene.save import save_scene

        save_scene(self, path, comments=comments, overwrite=overwrite)

    def replace(self, *change: Any, **changes: Any) -> "Scene":
        """Return the scene with other values: replace("film.viscosity", 0.1) or replace({...}).

        Top-level keys may be keyword arguments. What the changed scene no longer uses is dropped
        (a scene made dry loses its film); what the change itself names is not.
        """
        if len(change) == 2:
            changes[change[0]] = change[1]
        elif change:
            changes.update(change[0])
        data = self.to_dict()
        for name, value in changes.items():
            table, _, inner = name.rpartition(".")
            place = data.setdefault(table, {}) if table else data
            if not isinstance(place, dict) or (table and table not in TABLES):
                raise InputError(f"{name} = {value!r}: {table} is no table of a scene")
            place[inner] = value
        for kept, dropped in (("step", "tolerance"), ("tolerance", "step")):
            if f"solver.{kept}" in changes and f"solver.{dropped}" not in changes:
                data["solver"].pop(dropped, None)
        if data["mechanism"] != "press" and "balls" not in changes:
            data.pop("balls", None)
        unused = _unused(data)
        for name in unused.keys() - changes.keys():
            table, _, inner = name.rpartition(".")
            place = data.get(table) if table else data
            named = any(changed.startswith(f"{name}.") for changed in changes)
            if isinstance(place, dict) and not named:
                place.pop(inner, None)
        return Scene.from_dict(data)

    def build(self) -> "Model":
        """Return the assembled Exudyn model; model.mbs and model.SC are the real objects.

        Every body has graphics for Exudyn's own renderer and SolutionViewer.
        """
        from exu_press.graphics import add_graphics
        from exu_press.model import build

        model = build(self)
        add_graphics(model)
        return model

    @property
    def angular_speed(self) -> float:
        """Crank speed, rad/s."""
        return self.speed_rpm * RPM

    @property
    def pin_speed(self) -> float:
        """Speed of the crank pin, m/s."""
        size = self.press or self.slider_crank
        assert size is not None
        return self.angular_speed * size.crank_radius

    @property
    def duration(self) -> float:
        """Length of the run, s."""
        return self.revolutions * 60 / self.speed_rpm

    @property
    def start_angle(self) -> float:
        """Crank angle at the start, rad from top dead centre."""
        return math.radians(self.start_angle_deg)

    @staticmethod
    def _refuse(unused: Mapping[str, str], name: str, given: Any) -> None:
        if given is not None and name in unused:
            shown = f"[{name}]" if name in TABLES else f"{name} = {given!r}"
            raise InputError(f"{shown}: not used by this scene ({unused[name]}); remove it")

    def _all_clearances(self, given: Clearance, unused: Mapping[str, str]) -> Clearance:
        """Return the clearances of exactly the scene's clearance joints."""
        values = {}
        for field in dataclasses.fields(Clearance):
            name, value = f"clearance.{field.name}", getattr(given, field.name)
            if name not in unused:
                values[field.name] = DEFAULT_CLEARANCE if value is None else value
                assert self.contact is not None
                if values[field.name] >= self.contact.radius:
                    raise InputError(
                        f"{name} = {value!r}: allowed is a number < contact.radius = "
                        f"{self.contact.radius!r}"
                    )
        return Clearance(**values)

    def _check_laws(self) -> None:
        """Make every law once, so that what is outside its range is refused at the door."""
        if self.contact is not None and self.clearance is not None:
            for clearance in (self.clearance.crank_pin, self.clearance.balls):
                if clearance is not None:
                    contact_law(self.contact, clearance, revolute=True)
            if self.film is not None and self.clearance.crank_pin is not None:
                film_law(self.film, self.contact.radius, self.clearance.crank_pin)
        if self.friction is not None:
            friction_law(self.friction)

    def _check_geometry(self) -> None:
        """Refuse links that do not assemble at every crank angle, and pulses that overlap."""
        from exu_press.mechanism import check_assembly

        check_assembly(self)
        if self.flexible is not None:
            if self.press is None:
                raise InputError("bodies = 'flexible': allowed with mechanism = 'press' alone")
            for name, fitted in PARTS_ARE_MADE_FOR.items():
                if getattr(self.press, name) != fitted:
                    raise InputError(
                        f"press.{name} = {getattr(self.press, name)!r}: allowed with "
                        f"bodies = 'flexible' is {fitted!r}, for which the parts are made"
                    )
        if self.blanking is not None:
            pulse, period = self.blanking.rise + self.blanking.fall, 60 / self.speed_rpm
            if pulse > period:
                raise InputError(
                    f"blanking.rise + blanking.fall = {pulse!r}: allowed is at most one "
                    f"revolution, {period:g} s"
                )


def _fields(table: Any) -> tuple[dataclasses.Field[Any], ...]:
    return dataclasses.fields(table)


def _peek(table: Any, name: str) -> Any:
    """Return a key of a table before the table itself is checked, or None."""
    return table.get(name) if isinstance(table, Mapping) else getattr(table, name, None)


def _unused(scene: Mapping[str, Any]) -> dict[str, str]:
    """Return the names a scene does not use, each with its reason."""
    mechanism, bodies = scene["mechanism"], scene["bodies"]
    crank_pin, balls = scene["crank_pin"], scene.get("balls")
    at_contact = _peek(scene.get("film"), "at_contact")
    touching = "dry" in (crank_pin, balls) or (crank_pin == "lubricated" and at_contact == "mixed")
    pin, ball = f"crank_pin is {crank_pin!r}", f"balls is {balls!r}"
    press = mechanism == "press", f"mechanism is {mechanism!r}"
    countered = _peek(scene.get("press"), "counterweight") is not False
    counterweight = (countered, "press.counterweight is false") if press[0] else press
    wanted = {
        "balls": press,
        "press": press,
        "slider_crank": (mechanism == "slider_crank", f"mechanism is {mechanism!r}"),
        "clearance": (crank_pin != "ideal" or balls == "dry", "every joint is 'ideal'"),
        "clearance.crank_pin": (crank_pin != "ideal", pin),
        "clearance.balls": (balls == "dry", ball),
        "contact": (crank_pin != "ideal" or balls == "dry", "every joint is 'ideal'"),
        "friction": (touching, "no joint is 'dry' or has a mixed film"),
        "film": (crank_pin == "lubricated", pin),
        "flexible": (bodies == "flexible", f"bodies is {bodies!r}"),
        "guide.slide_inertia": press,
        "guide.counterweight_inertia": counterweight,
        **{f"press.{name}": counterweight for name in OF_THE_COUNTERWEIGHT},
    }
    return {name: reason for name, (used, reason) in wanted.items() if not used}
