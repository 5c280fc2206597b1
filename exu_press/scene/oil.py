"""Oil that warms: the [film.oil] table of a scene."""

from dataclasses import dataclass
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.schema.checks import key
from exu_press.schema.table import Table

__all__ = ["Oil"]

THINNEST = 2.0
"""mm^2/s, of the range in which ASTM D341 has the law in this form."""

MM2 = 1e-6
"""m^2, and Pa s over mm^2/s times kg/m^3."""


@dataclass(frozen=True)
class Oil(Table):
    """An oil that warms, instead of film.viscosity; each film finds its temperature.

    Two points of the data sheet give the viscosity over the temperature (Walther, ASTM D341).
    """

    table: ClassVar[str] = "film.oil"
    needed: ClassVar[tuple[str, ...]] = ("viscosity_cst", "density", "supply_celsius")

    viscosity_cst: tuple[float, float] = key(
        None, "kinematic viscosities at two temperatures", "mm^2/s", numbers=2, example=(68.0, 8.7)
    )
    at_celsius: tuple[float, float] = key(
        (40.0, 100.0), "temperatures of these", "deg C", numbers=2
    )
    density: float = key(None, "of the oil", "kg/m^3", above=0, example=870.0)
    supply_celsius: float = key(
        None, "of the oil that enters the bearing", "deg C", at_least=-50, at_most=200, example=40.0
    )
    conductance: float = key(
        0.0,
        "heat that a joint passes to the frame, over the film's temperature above it",
        "W/K",
        at_least=0,
        source="none, as Raimondi and Boyd 1958",
    )
    frame_celsius: float | None = key(
        None,
        "conductance: of the frame; supply_celsius unless given",
        "deg C",
        at_least=-50,
        at_most=200,
    )
    heat_capacity: float = key(
        1.8e6, "of a volume of oil", "J/(m^3 K)", above=0, source="mineral oils, DIN 31652-1"
    )
    pressure_viscosity: float | None = key(
        None,
        "Barus' coefficient without pressure, of mineral oils 1e-8 to 3e-8 (Roelands); without it "
        "pressure does not count",
        "1/Pa",
        above=0,
        at_most=1e-6,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.conductance:
            self.refuse_unused(("frame_celsius",), "film.oil.conductance is 0")
        cold, warm = self.at_celsius
        if not -50.0 <= cold < warm <= 300.0:
            raise InputError(
                f"film.oil.at_celsius = {[cold, warm]!r}: allowed are two temperatures from -50 to "
                "300 deg C, the lower one first, as in [40.0, 100.0]"
            )
        if self.viscosity_cst is None:
            return
        thick, thin = self.viscosity_cst
        if not thick > thin >= THINNEST:
            raise InputError(
                f"film.oil.viscosity_cst = {[thick, thin]!r} at {cold:g} and {warm:g} deg C: "
                f"allowed is the larger one first, as oil thins when it warms, and >= {THINNEST:g} "
                "mm^2/s, the range of ASTM D341"
            )

    @property
    def frame(self) -> float:
        """Temperature of the frame, deg C."""
        return self.supply_celsius if self.frame_celsius is None else self.frame_celsius

    def viscosity(self, temperature: float, pressure: float = 0.0) -> float:
        """Return the dynamic viscosity, Pa s, at a temperature, deg C, and a pressure, Pa."""
        cold, warm = zip(self.at_celsius, self.viscosity_cst, strict=True)
        from exu_press.laws.film.oil import roelands, walther

        thin = walther(temperature, cold, warm)[0] * MM2 * self.density
        if self.pressure_viscosity is None:
            return thin
        return roelands(thin, self.pressure_viscosity, pressure)[0]
