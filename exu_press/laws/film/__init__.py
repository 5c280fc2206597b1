"""Film laws: hydrodynamic forces of journal bearings and plane pads, with their derivatives.

Names are loaded on first access.
"""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from exu_press.laws.film.asperities import pad_with_asperities, with_asperities
    from exu_press.laws.film.ball import BallFilm, socket_drag
    from exu_press.laws.film.contract import FilmForce, FilmLaw, dissipated_power, film_scale
    from exu_press.laws.film.finite_bearing import finite
    from exu_press.laws.film.long_bearing import pi_film, pinkus
    from exu_press.laws.film.plane_pad import PadFilm, PadLaw
    from exu_press.laws.film.short_bearing import short

__all__ = [
    "BallFilm",
    "FilmForce",
    "FilmLaw",
    "PadFilm",
    "PadLaw",
    "dissipated_power",
    "film_scale",
    "finite",
    "pad_with_asperities",
    "pi_film",
    "pinkus",
    "short",
    "socket_drag",
    "with_asperities",
]

__getattr__ = lazy_names(__name__)
