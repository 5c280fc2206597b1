"""film.law = "grooved": a bearing with supply grooves, [[film.grooves]], or an inclined journal."""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from exu_press.errors import InputError
from exu_press.laws.film.contract import FilmLaw as JournalLaw
from exu_press.scene.film import FilmLaw
from exu_press.schema.checks import key, list_of_tables
from exu_press.schema.table import Table

if TYPE_CHECKING:
    from exu_press.laws.film.grooves import GroovedBearing

__all__ = ["GroovedLaw", "SupplyGroove"]

RANGE = 0.1, 4.0
"""L/D, as of `finite`."""

PRESSURIZED_ERRORS = 0.02, 0.05
"""Of force and side flow where oil is under pressure."""


@dataclass(frozen=True)
class SupplyGroove(Table):
    """A groove, in the middle of the bearing's length."""

    table: ClassVar[str] = "film.grooves"
    needed: ClassVar[tuple[str, ...]] = ("width_deg",)

    angle_deg: float = key(
        0.0,
        "of its middle, in the bearing, from its body's x axis",
        "deg",
        at_least=-360,
        at_most=360,
    )
    width_deg: float = key(
        None, "around the bearing; 360 all around", "deg", at_least=0.1, at_most=360
    )
    length: float | None = key(
        None, "along the axis; all of the bearing's unless given", "m", above=0
    )
    pressure: float | None = key(
        None, "of its oil, above ambient; ambient unless given", "Pa", at_least=0, at_most=1e8
    )


@dataclass(frozen=True)
class GroovedLaw(FilmLaw):
    """A bearing of any usual length with supply grooves or an inclined journal."""

    registered_name: ClassVar[str] = "grooved"
    length_to_diameter = RANGE
    error: ClassVar[float] = 5e-3
    flow_error: ClassVar[float] = 8e-3
    is_oriented: ClassVar[bool] = True
    flows_out: ClassVar[bool] = True

    grooves: tuple[SupplyGroove, ...] | None = list_of_tables(
        "scene.grooved:SupplyGroove", "supply grooves of the bearing, each a table [[film.grooves]]"
    )
    tilt: float = key(
        0.0, "angle between the axes of journal and bearing, constant", "rad", at_least=0
    )
    tilt_direction_deg: float = key(
        0.0,
        "where the journal's axis leans at z = +length/2, in the bearing, from its body's x axis",
        "deg",
        at_least=-360,
        at_most=360,
    )

    @property
    def inclination(self) -> float:  # type: ignore[override]
        """Angle between the axes of journal and bearing, rad."""
        return self.tilt

    @property
    def supply_pressure(self) -> float:  # type: ignore[override]
        """Largest pressure of the grooves, Pa above ambient."""
        return max((groove.pressure or 0.0 for groove in self.grooves or ()), default=0.0)

    @property
    def ring_pressure(self) -> float:  # type: ignore[override]
        """Pressure of oil in a groove all around, Pa above ambient."""
        around = any(groove.width_deg >= 360.0 for groove in self.grooves or ())
        return self.supply_pressure if around else 0.0

    @property
    def errors(self) -> tuple[float, float]:
        """Relative errors of its forces and of its side flow."""
        return PRESSURIZED_ERRORS if self.supply_pressure else (self.error, self.flow_error)

    def film(self, length_to_diameter: float) -> JournalLaw:
        """Return the law of a bearing whose diameter is 1 m, of this L/D."""
        return replace(self, tilt=0.0).law_of_size(length_to_diameter, 0.5, 1.0, None)

    def law_of_size(
        self, length: float, radius: float, clearance: float, gap_ratio: float | None
    ) -> JournalLaw:
        """Return the law of a bearing of these sizes, m; arguments as of `FilmLaw.law_of_size`.

        Raises:
            InputError: there are neither grooves nor a tilt, the grooves overlap, or are longer
                than the bearing; one with pressure reaches the bearing's ends, or the journal is
                inclined; the journal touches both ends; the bearing is outside the range of widths.
        """
        from exu_press.laws.film.grooved_table import GroovedFilm
        from exu_press.laws.film.grooves import Groove, GroovedBearing

        ratio = length / (2.0 * radius)
        if not RANGE[0] <= ratio <= RANGE[1]:
            raise InputError(
                f"length = {length:g} with a diameter of {2.0 * radius:g}: allowed for grooved "
                f"bearings is {RANGE[0]:g} to {RANGE[1]:g} diameters"
            )
        grooves = self.grooves or ()
        if not grooves and not self.tilt:
            raise InputError(
                "grooves: missing; allowed is one [[film.grooves]] at least, as in angle_deg = 90, "
                "width_deg = 10, or film.tilt > 0; without both: film.law = 'finite'"
            )
        if self.tilt_direction_deg and "tilt" not in self.given_values:
            raise InputError(
                f"tilt_direction_deg = {self.tilt_direction_deg!r}: not used without film.tilt, "
                "the angle by which the journal leans there; remove it, or give both"
            )
        for k, groove in enumerate(grooves):
            if groove.length is not None and groove.length > length:
                raise InputError(
                    f"grooves.{k}.length = {groove.length!r}: allowed is a number <= film.length "
                    f"= {length!r} (m)"
                )
            if groove.pressure and (groove.length is None or groove.length >= length):
                raise InputError(
                    f"grooves.{k}.pressure = {groove.pressure!r}: allowed is a groove with a "
                    f"length < film.length = {length!r} (m), as one that is open at the bearing's "
                    "ends keeps no pressure"
                )
        highest = self.supply_pressure
        shares = [1.0 if g.length is None else g.length / length for g in grooves]
        bearing = GroovedBearing(
            ratio,
            tuple(
                Groove(
                    math.radians(groove.angle_deg),
                    math.radians(groove.width_deg),
                    share,
                    groove.pressure / highest if groove.pressure else 0.0,
                )
                for groove, share in zip(grooves, shares, strict=True)
            ),
        )
        if self.tilt:
            return self._inclined_law(bearing, length, clearance, gap_ratio)
        if not bearing.is_pressurized:
            return GroovedFilm(bearing, gap_ratio)
        from exu_press.laws.film.pressurized import PressurizedFilm

        return PressurizedFilm(bearing, gap_ratio)

    def _inclined_law(
        self, bearing: "GroovedBearing", length: float, clearance: float, gap_ratio: float | None
    ) -> JournalLaw:
        """Return the law of an inclined journal in a bearing."""
        from exu_press.laws.film.tilted import TiltedFilm

        if gap_ratio is not None:
            raise InputError(
                "at_contact = 'mixed' with film.tilt: allowed is 'stop', as the journal touches "
                "with an edge, for which there is no contact law; or film.tilt = 0"
            )
        ratio = 0.5 * self.tilt * length / clearance
        if ratio >= 1.0:
            raise InputError(
                f"tilt = {self.tilt:g}: allowed is a number < 2 * clearance / film.length = "
                f"{2.0 * clearance / length:g} (rad), where the journal touches both ends"
            )
        return TiltedFilm(bearing, ratio, math.radians(self.tilt_direction_deg))
