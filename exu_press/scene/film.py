"""[film]: the oil film of lubricated joints, Eqs. 34-35 corrected."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

from exu_press.errors import InputError
from exu_press.laws.film.asperities import with_asperities
from exu_press.laws.film.ball import BallFilm as BallLaw
from exu_press.laws.film.ball import ball
from exu_press.laws.film.contract import FilmLaw as JournalLaw
from exu_press.laws.film.contract import film_scale
from exu_press.laws.film.side_flow import SideFlow, no_flow
from exu_press.lazy import load_object
from exu_press.scene.oil import Oil
from exu_press.schema.checks import key
from exu_press.schema.kinds import CustomKind
from exu_press.schema.registry import Registry, choice
from exu_press.schema.table import Table, nested_table

__all__ = ["FILMS", "BallFilm", "Film", "FilmLaw", "JournalFilm"]

FILMS = Registry(
    {
        "pinkus": "scene.film:Pinkus",
        "pi_film": "scene.film:PiFilm",
        "short": "scene.film:Short",
        "finite": "scene.film:Finite",
        "grooved": "scene.grooved:GroovedLaw",
    },
    base="scene.film:FilmLaw",
)

AT_CONTACT_MEANING = "at eccentricity ratio 1: stop, or film and contact (A-13)"

AT_CONTACT = Registry({"stop": "scene.film:StopAtContact", "mixed": "scene.film:MixedFilm"})


class AlignedAmbientFilm:
    """A law of a film whose oil has ambient pressure, of a journal that is not inclined."""

    error: ClassVar[float] = 0.0
    """Relative, of its forces, where they are a table's: 95 % of states are within."""
    flow_error: ClassVar[float] = 0.0
    """The same of the side flow."""
    is_oriented: ClassVar[bool] = False
    """Whether it depends on the angle of the eccentricity in the bearing."""

    inclination = 0.0
    """Angle between the axes of journal and bearing, rad."""
    supply_pressure = 0.0
    """Largest pressure at which oil is supplied, Pa above ambient."""
    ring_pressure = 0.0
    """Pressure of oil in a groove all around, Pa above ambient."""

    @property
    def errors(self) -> tuple[float, float]:
        """Relative errors of its forces and of its side flow."""
        return self.error, self.flow_error


@dataclass(frozen=True)
class FilmLaw(CustomKind, AlignedAmbientFilm, Table, ABC):
    """Base of the film laws of journals, also of your own.

    The derived dataclass declares its keys, which stand in [film], by
    `exu_press.schema.checks.key`.
    """

    table: ClassVar[str] = "film"
    length_to_diameter: ClassVar[tuple[float, float]] = (0.0, math.inf)
    """L/D that it is meant for."""
    flows_out: ClassVar[bool] = False
    """Whether oil flows out at the ends."""

    @abstractmethod
    def film(self, length_to_diameter: float) -> JournalLaw:
        """Return the law of a bearing of this L/D."""

    def side_flow(self, length_to_diameter: float) -> SideFlow:
        """Return the flow of oil out of the ends of a bearing of this L/D."""
        return no_flow(length_to_diameter)

    def law_of_size(
        self, length: float, radius: float, clearance: float, gap_ratio: float | None
    ) -> JournalLaw:
        """Return the law of a bearing of these sizes, m.

        Args:
            length, radius, clearance: of the bearing.
            gap_ratio: gap at which asperities touch, over the clearance; None where none do.
        """
        law = self.film(length / (2.0 * radius))
        return law if gap_ratio is None else with_asperities(law, gap_ratio)

    def suits(self, length_to_diameter: float) -> bool:
        """Return whether L/D lies in the range that the law is meant for."""
        low, high = self.length_to_diameter
        return low <= length_to_diameter <= high


class LawOfBalls(AlignedAmbientFilm):
    """What is to be known of the law of `exu_press.laws.film.ball`."""

    error = 5e-3


class _LibraryFilm(FilmLaw):
    """A law of `exu_press.laws.film`, whose module is loaded when the law is made."""

    law: ClassVar[str]
    flow: ClassVar[str] = "no_flow"

    def film(self, length_to_diameter: float) -> JournalLaw:
        """Return the law of a bearing of this L/D, of which one of a long bearing has no need."""
        make = load_object(f"laws.film.{self.law}")
        is_long = self.length_to_diameter[1] == math.inf
        law: JournalLaw = make() if is_long else make(length_to_diameter)
        return law

    def side_flow(self, length_to_diameter: float) -> SideFlow:
        """Return the flow of oil out of the ends of a bearing of this L/D."""
        flow: SideFlow = load_object(f"laws.film.side_flow:{self.flow}")(length_to_diameter)
        return flow


class Pinkus(_LibraryFilm):
    """A long bearing with Gümbel's condition, as printed by Pinkus and Sternlicht."""

    registered_name: ClassVar[str] = "pinkus"
    law = "long_bearing:pinkus"
    length_to_diameter = (2.0, math.inf)


class PiFilm(_LibraryFilm):
    """A long bearing, of whose film half bears."""

    registered_name: ClassVar[str] = "pi_film"
    law = "long_bearing:pi_film"
    length_to_diameter = (2.0, math.inf)


class Short(_LibraryFilm):
    """A short bearing."""

    registered_name: ClassVar[str] = "short"
    law, flow = "short_bearing:short", "short_flow"
    length_to_diameter, flows_out = (0.0, 0.5), True


class Finite(_LibraryFilm):
    """A bearing of any usual length."""

    registered_name: ClassVar[str] = "finite"
    law, flow = "finite_bearing:finite", "finite_flow"
    length_to_diameter, flows_out = (0.1, 4.0), True
    error, flow_error = 5e-3, 7e-3


@dataclass(frozen=True)
class StopAtContact(CustomKind, Table):
    """The film alone bears; the run ends where surfaces would touch."""

    registered_name: ClassVar[str] = "stop"
    table: ClassVar[str] = "film"
    contact_gap: ClassVar[None] = None


@dataclass(frozen=True)
class MixedFilm(CustomKind, Table):
    """Asperities share the load where the film is thin."""

    registered_name: ClassVar[str] = "mixed"
    table: ClassVar[str] = "film"
    roughness: float = key(2e-7, "combined rms roughness", "m", above=0)
    asperity_onset: float = key(
        3.0, "gap at which asperities touch, in roughnesses", above=0, at_most=10
    )

    @property
    def contact_gap(self) -> float:
        """Gap at which the surfaces' asperities touch, m."""
        return self.roughness * self.asperity_onset


class Film(Table):
    """Film of a lubricated joint."""

    table: ClassVar[str] = "film"
    exclusive: ClassVar[tuple[tuple[str, str], ...]] = (("viscosity", "oil"),)
    law: Any
    length: Any
    viscosity: float
    at_contact: StopAtContact | MixedFilm
    oil: Oil | None

    @property
    def cold_viscosity(self) -> float:
        """Viscosity with which a run begins, Pa s: of oil as it is supplied."""
        if self.oil is not None:
            return self.oil.viscosity(self.oil.supply_celsius)
        return self.viscosity

    @property
    def contact_gap(self) -> float | None:
        """Gap at which the surfaces' asperities touch, m; None without mixed film."""
        return self.at_contact.contact_gap

    def contact_gap_ratio(self, clearance: float) -> float | None:
        """Return that gap over the clearance, m.

        Raises:
            InputError: the gap is as wide as the clearance.
        """
        gap = self.contact_gap
        if gap is not None and gap >= clearance:
            raise InputError(
                f"roughness * film.asperity_onset = {gap:g}: allowed is a number < "
                f"clearance = {clearance:g}"
            )
        return None if gap is None else gap / clearance

    def scale(self, radius: float, clearance: float) -> float:
        """Return the scale P of its force, N s, from sizes, m; a ball is as long as its radius."""
        length = radius if self.length is None else self.length
        return film_scale(self.cold_viscosity, length, radius, clearance)


def _viscosity() -> Any:
    return key(None, "dynamic viscosity (A-11)", "Pa s", above=0, example=0.09)


@dataclass(frozen=True)
class JournalFilm(Film):
    """Film of a journal in its bearing."""

    needed: ClassVar[tuple[str, ...]] = ("length",)
    law: FilmLaw = choice("finite", "film law of a journal", FILMS)
    viscosity: float = _viscosity()
    length: float = key(None, "bearing length (A-12); a ball has none", "m", above=0, example=0.05)
    at_contact: StopAtContact | MixedFilm = choice("stop", AT_CONTACT_MEANING, AT_CONTACT)
    oil: Oil | None = nested_table("scene.oil:Oil")

    def film_law(self, radius: float, clearance: float) -> JournalLaw:
        """Return the law of a journal of a radius and a clearance, m, also beyond contact."""
        gap_ratio = self.contact_gap_ratio(clearance)
        return self.law.law_of_size(self.length, radius, clearance, gap_ratio)

    def side_flow(self, radius: float) -> SideFlow:
        """Return the flow of oil out of its ends, of a journal of a radius, m."""
        return self.law.side_flow(self.length / (2.0 * radius))

    def check_cooling(self) -> None:
        """Raise InputError for an oil that warms, and of which nothing carries the heat off."""
        if self.oil is not None and not self.oil.conductance and not self.law.flows_out:
            raise InputError(
                f"film.oil.conductance = 0 with film.law = {self.law.kind!r}: allowed is a number "
                "> 0, as a long bearing has no side flow that carries heat off, or film.law = "
                "'finite'"
            )


@dataclass(frozen=True)
class BallFilm(Film):
    """Film of a ball in its socket."""

    length = None
    law = LawOfBalls()
    viscosity: float = _viscosity()
    socket_angle_deg: float = key(
        90.0,
        "ball: from the middle of each of its socket's two caps to the edge",
        "deg",
        at_least=45,
        at_most=90,
        source="two hemispheres",
    )
    at_contact: StopAtContact | MixedFilm = choice("stop", AT_CONTACT_MEANING, AT_CONTACT)
    oil: Oil | None = nested_table("scene.oil:Oil")

    def ball_film(self, clearance: float) -> BallLaw:
        """Return the film of a ball with a clearance, m."""
        gap_ratio = self.contact_gap_ratio(clearance)
        return ball(math.radians(self.socket_angle_deg), gap_ratio)

    def film_law(self, radius: float, clearance: float) -> JournalLaw:
        """Return its law in a plane through its centre; arguments as those of `JournalFilm`."""
        return self.ball_film(clearance).law

    def check_cooling(self) -> None:
        """Raise InputError for an oil that warms."""
        if self.oil is not None:
            raise InputError(
                "film.oil: the film of a ball does not warm; allowed is film.viscosity of its own"
            )
