"""The assembled Exudyn system of a scene: only what the scene uses is built."""

from exu_press.model.assemble import build
from exu_press.model.model import Model

__all__ = ["Model", "build"]
