"""Film laws: the hydrodynamic force of a lubricated revolute joint, with its derivatives."""

from exu_press.laws.film.asperities import with_asperities
from exu_press.laws.film.catalogue import FILM_LAWS, FilmEntry
from exu_press.laws.film.contract import FilmForce, FilmLaw, dissipated, film_scale
from exu_press.laws.film.finite_bearing import finite
from exu_press.laws.film.long_bearing import pi_film, pinkus
from exu_press.laws.film.short_bearing import short

__all__ = [
    "FILM_LAWS",
    "FilmEntry",
    "FilmForce",
    "FilmLaw",
    "dissipated",
    "film_scale",
    "finite",
    "pi_film",
    "pinkus",
    "short",
    "with_asperities",
]
