"""The assembled Exudyn system of a scene: only what the scene uses is built."""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from exu_press.model.assemble import build
    from exu_press.model.model import Model

__all__ = ["Model", "build"]

__getattr__ = lazy_names(__name__)
