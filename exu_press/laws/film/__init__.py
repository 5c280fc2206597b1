"""Film laws: hydrodynamic forces of journal bearings and plane pads, with their derivatives."""

from exu_press.laws.film.asperities import pad_with_asperities, with_asperities
from exu_press.laws.film.ball import BallFilm, ball, socket_drag
from exu_press.laws.film.catalogue import FILM_LAWS, FilmEntry
from exu_press.laws.film.contract import FilmForce, FilmLaw, dissipated_power, film_scale
from exu_press.laws.film.finite_bearing import finite
from exu_press.laws.film.long_bearing import pi_film, pinkus
from exu_press.laws.film.plane_pad import PadFilm, PadLaw, plane_pad
from exu_press.laws.film.short_bearing import short

__all__ = [
    "FILM_LAWS",
    "BallFilm",
    "FilmEntry",
    "FilmForce",
    "FilmLaw",
    "PadFilm",
    "PadLaw",
    "ball",
    "dissipated_power",
    "film_scale",
    "finite",
    "pad_with_asperities",
    "pi_film",
    "pinkus",
    "plane_pad",
    "short",
    "socket_drag",
    "with_asperities",
]
