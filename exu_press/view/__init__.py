"""The mechanism in motion, from a result file alone: as animation or pictures."""

from exu_press.view.animation import Animation, Look
from exu_press.view.instants import Instants, instants, moment
from exu_press.view.save import save_animation, save_picture

__all__ = ["Animation", "Instants", "Look", "instants", "moment", "save_animation", "save_picture"]
