"""The mechanism in motion, from a result file alone: in a window, or as a film or pictures."""

from exu_press.view.film import Film, Look
from exu_press.view.instants import Instants, instants, moment
from exu_press.view.save import save_film, save_picture

__all__ = ["Film", "Instants", "Look", "instants", "moment", "save_film", "save_picture"]
