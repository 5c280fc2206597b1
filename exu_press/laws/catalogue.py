"""The film laws by name, with the range of widths that they are meant for.

A law is loaded when a scene has it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from exu_press.lazy import load_object

if TYPE_CHECKING:
    from exu_press.laws.film.contract import FilmLaw
    from exu_press.laws.film.side_flow import SideFlow

__all__ = ["BALL_ERROR", "FILM_LAWS", "PAD_ERROR", "FilmEntry"]


@dataclass(frozen=True, slots=True)
class FilmEntry:
    """A film law: its module and function, the L/D that it is meant for, and its side flow."""

    module: str
    function: str
    length_to_diameter: tuple[float, float]
    flow: str = "no_flow"
    """Function of L/D in `side_flow`."""
    error: float = 0.0
    """Relative, of its forces, where they are a table's: 95 % of states are within."""
    flow_error: float = 0.0
    """The same of the side flow."""

    def factory(self, length_to_diameter: float) -> "FilmLaw":
        """Return the law; one of a long bearing ignores L/D, others refuse a wrong one."""
        load = _load(self.module, self.function)
        long = self.length_to_diameter[1] == math.inf
        law: FilmLaw = load() if long else load(length_to_diameter)
        return law

    def side_flow(self, length_to_diameter: float) -> "SideFlow":
        """Return the flow of oil out of its ends."""
        flow: SideFlow = _load("side_flow", self.flow)(length_to_diameter)
        return flow

    @property
    def flows_out(self) -> bool:
        """Return whether oil flows out at its ends."""
        return self.flow != "no_flow"

    def suits(self, length_to_diameter: float) -> bool:
        """Return whether L/D lies in the range that the law's source states."""
        low, high = self.length_to_diameter
        return low <= length_to_diameter <= high


def _load(module: str, function: str) -> Callable[..., Any]:
    loaded: Callable[..., Any] = load_object(f"laws.film.{module}:{function}")
    return loaded


BALL_ERROR, PAD_ERROR = 5e-3, 0.02
"""The same error of a ball's film, and of that between a body and its guideways."""

FILM_LAWS = MappingProxyType(
    {
        "pinkus": FilmEntry("long_bearing", "pinkus", (2.0, math.inf)),
        "pi_film": FilmEntry("long_bearing", "pi_film", (2.0, math.inf)),
        "short": FilmEntry("short_bearing", "short", (0.0, 0.5), "short_flow"),
        "finite": FilmEntry("finite_bearing", "finite", (0.1, 4.0), "finite_flow", 5e-3, 7e-3),
    }
)
