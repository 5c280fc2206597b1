"""What is asked: one frozen Scene, checked once at the door."""

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from exu_press.errors import InputError
from exu_press.scene.checks import Table, key, table_from
from exu_press.scene.laws import contact_law, film_law, friction_law
from exu_press.scene.tables import (
    Blanking,
    Clearance,
    Contact,
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

TABLES = {
    "clearance": Clearance,
    "contact": Contact,
    "friction": Friction,
    "film": Film,
    "blanking": Blanking,
    "flexible": Flexible,
    "solver": Solver,
    "press": Press,
    "slider_crank": SliderCrank,
}


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
    flexible: Flexible | None = None
    solver: Solver | None = None
    press: Press | None = None
    slider_crank: SliderCrank | None = None

    def __post_init__(self) -> None:
        """Check the keys, refuse what the scene does not use and fill in what it does."""
        super().__post_init__()
        if self.mechanism == "press" and self.balls is None:
            object.__setattr__(self, "balls", "dry")
        unused = _unused(
            self.mechanism, self.bodies, self.crank_pin, self.balls, _at_contact(self.film)
        )
        self._refuse(unused, "balls", self.balls)
        for name, table in TABLES.items():
            given = getattr(self, name)
            if given is not None:
                self._refuse(unused, name, given)
                object.__setattr__(self, name, table_from(table, name, given))
            elif name not in unused and name != "blanking":
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
        at_contact = _at_contact(data.get("film"))
        unused = _unused(
            data["mechanism"], data["bodies"], data["crank_pin"], data.get("balls"), at_contact
        )
        for name in unused.keys() - changes.keys():
            table, _, inner = name.rpartition(".")
            if not any(changed.startswith(f"{name}.") for changed in changes):
                (data.get(table, {}) if table else data).pop(inner, None)
        return Scene.from_dict(data)

    def build(self) -> "Model":
        """Return the assembled Exudyn model; model.mbs and model.SC are the real objects."""
        from exu_press.model import build

        return build(self)

    @property
    def angular_speed(self) -> float:
        """Crank speed, rad/s."""
        return self.speed_rpm * RPM

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
            self._refuse(unused, name, value)
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


def _at_contact(film: Any) -> str:
    """Return what a film table asks for at contact, before the table itself is checked."""
    if isinstance(film, Mapping):
        return str(film.get("at_contact"))
    return str(getattr(film, "at_contact", "stop"))


def _unused(
    mechanism: str, bodies: str, crank_pin: str, balls: str | None, at_contact: str
) -> dict[str, str]:
    """Return the names a scene does not use, each with its reason."""
    touching = "dry" in (crank_pin, balls) or (crank_pin == "lubricated" and at_contact == "mixed")
    pin, ball = f"crank_pin is {crank_pin!r}", f"balls is {balls!r}"
    wanted = {
        "balls": (mechanism == "press", f"mechanism is {mechanism!r}"),
        "press": (mechanism == "press", f"mechanism is {mechanism!r}"),
        "slider_crank": (mechanism == "slider_crank", f"mechanism is {mechanism!r}"),
        "clearance": (crank_pin != "ideal" or balls == "dry", "every joint is 'ideal'"),
        "clearance.crank_pin": (crank_pin != "ideal", pin),
        "clearance.balls": (balls == "dry", ball),
        "contact": (crank_pin != "ideal" or balls == "dry", "every joint is 'ideal'"),
        "friction": (touching, "no joint is 'dry' or has a mixed film"),
        "film": (crank_pin == "lubricated", pin),
        "flexible": (bodies == "flexible", f"bodies is {bodies!r}"),
    }
    return {name: reason for name, (used, reason) in wanted.items() if not used}
