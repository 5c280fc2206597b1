"""The film laws by name, with their stated range and their cavitation condition."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType

from exu_press.laws.film.contract import FilmLaw
from exu_press.laws.film.finite_bearing import finite
from exu_press.laws.film.long_bearing import pi_film, pinkus
from exu_press.laws.film.short_bearing import short

__all__ = ["FILM_LAWS", "FilmEntry"]


@dataclass(frozen=True, slots=True)
class FilmEntry:
    """A film law: its factory, the L/D it is meant for, how it cavitates, where it comes from."""

    factory: Callable[[float], FilmLaw]
    """Takes L/D; a long bearing ignores it. What is outside its range it refuses (`finite`)."""
    length_to_diameter: tuple[float, float]
    cavitation: str
    source: str

    def suits(self, length_to_diameter: float) -> bool:
        """Whether L/D lies in the range that the law's source states."""
        low, high = self.length_to_diameter
        return low <= length_to_diameter <= high


FILM_LAWS = MappingProxyType(
    {
        "pinkus": FilmEntry(
            lambda _: pinkus(),
            (2.0, math.inf),
            "half film (Gumbel), approximate in its extent",
            "Pinkus and Sternlicht 1961, corrected",
        ),
        "pi_film": FilmEntry(
            lambda _: pi_film(), (2.0, math.inf), "half film (Gumbel)", "Sommerfeld 1904, Gumbel"
        ),
        "short": FilmEntry(short, (0.0, 0.5), "half film (Gumbel)", "Ocvirk 1952"),
        "finite": FilmEntry(
            finite,
            (0.1, 4.0),
            "Swift and Stieber, oil supplied along the widest gap",
            "Reynolds' equation tabulated; Butenschoen 1976",
        ),
    }
)
