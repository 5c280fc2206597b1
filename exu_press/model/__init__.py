"""From a scene to an assembled Exudyn system: only what the scene uses is built."""

from exu_press.model.assemble import build
from exu_press.model.model import Model

__all__ = ["Model", "build"]
