"""Integration of a scene's model, with advice in terms of the scene's keys."""

from exu_press.solving.solvable_model import SolvableModel
from exu_press.solving.solve import DEFAULTS, scales, settings_for, solve

__all__ = ["DEFAULTS", "SolvableModel", "scales", "settings_for", "solve"]
