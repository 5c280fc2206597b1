"""The film laws by name, with the range of widths that they are meant for."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType

from exu_press.laws.film.contract import FilmLaw
from exu_press.laws.film.finite_bearing import finite
from exu_press.laws.film.long_bearing import pi_film, pinkus
from exu_press.laws.film.short_bearing import short
from exu_press.laws.film.side_flow import SideFlow, finite_flow, no_flow, short_flow

__all__ = ["FILM_LAWS", "FilmEntry"]


@dataclass(frozen=True, slots=True)
class FilmEntry:
    """A film law: its factory, the L/D that it is meant for, and its side flow."""

    factory: Callable[[float], FilmLaw]
    """Takes L/D; a long bearing ignores it. What is outside its range it refuses (`finite`)."""
    length_to_diameter: tuple[float, float]
    side_flow: Callable[[float], SideFlow] = no_flow
    """Takes L/D too."""

    @property
    def flows_out(self) -> bool:
        """Return whether oil flows out at its ends."""
        return self.side_flow is not no_flow

    def suits(self, length_to_diameter: float) -> bool:
        """Return whether L/D lies in the range that the law's source states."""
        low, high = self.length_to_diameter
        return low <= length_to_diameter <= high


FILM_LAWS = MappingProxyType(
    {
        "pinkus": FilmEntry(lambda _: pinkus(), (2.0, math.inf)),
        "pi_film": FilmEntry(lambda _: pi_film(), (2.0, math.inf)),
        "short": FilmEntry(short, (0.0, 0.5), short_flow),
        "finite": FilmEntry(finite, (0.1, 4.0), finite_flow),
    }
)
