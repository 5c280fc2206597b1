"""film.law = "grooved": a bearing with supply grooves, [[film.grooves]]."""

import math
from dataclasses import dataclass
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.laws.film.contract import FilmLaw as JournalLaw
from exu_press.scene.film import FilmLaw
from exu_press.schema.checks import key, list_of_tables
from exu_press.schema.table import Table

__all__ = ["GroovedLaw", "SupplyGroove"]

RANGE = 0.1, 4.0
"""L/D, as of `finite`."""


@dataclass(frozen=True)
class SupplyGroove(Table):
    """A groove, in the middle of the bearing's length."""

    table: ClassVar[str] = "film.grooves"
    required: ClassVar[tuple[str, ...]] = ("width_deg",)

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


@dataclass(frozen=True)
class GroovedLaw(FilmLaw):
    """A bearing of any usual length with supply grooves, from a table of its own."""

    registered_name: ClassVar[str] = "grooved"
    length_to_diameter = RANGE
    error: ClassVar[float] = 5e-3
    flow_error: ClassVar[float] = 8e-3
    flows_out: ClassVar[bool] = True

    grooves: tuple[SupplyGroove, ...] | None = list_of_tables(
        "scene.grooved:SupplyGroove", "supply grooves of the bearing, each a table [[film.grooves]]"
    )

    def film(self, length_to_diameter: float) -> JournalLaw:
        """Return the law of a bearing whose diameter is 1 m, of this L/D."""
        return self.law_of_size(length_to_diameter, 0.5, None)

    def law_of_size(self, length: float, radius: float, gap_ratio: float | None) -> JournalLaw:
        """Return the law of a bearing of these sizes, m; arguments as of `FilmLaw.law_of_size`.

        Raises:
            InputError: there are no grooves, they overlap, or are longer than the bearing; the
                bearing is outside the range of widths.
        """
        from exu_press.laws.film.grooved_table import GroovedFilm
        from exu_press.laws.film.grooves import Groove, GroovedBearing

        ratio = length / (2.0 * radius)
        if not RANGE[0] <= ratio <= RANGE[1]:
            raise InputError(
                f"length = {length:g} with a diameter of {2.0 * radius:g}: allowed for grooved "
                f"bearings is {RANGE[0]:g} to {RANGE[1]:g} diameters"
            )
        if not self.grooves:
            raise InputError(
                "grooves: missing; allowed is one [[film.grooves]] at least, as in angle_deg = 90, "
                "width_deg = 10; without grooves: film.law = 'finite'"
            )
        for k, groove in enumerate(self.grooves):
            if groove.length is not None and groove.length > length:
                raise InputError(
                    f"grooves.{k}.length = {groove.length!r}: allowed is a number <= film.length "
                    f"= {length!r} (m)"
                )
        shares = [1.0 if g.length is None else g.length / length for g in self.grooves]
        bearing = GroovedBearing(
            ratio,
            tuple(
                Groove(math.radians(groove.angle_deg), math.radians(groove.width_deg), share)
                for groove, share in zip(self.grooves, shares, strict=True)
            ),
        )
        return GroovedFilm(bearing, gap_ratio)
