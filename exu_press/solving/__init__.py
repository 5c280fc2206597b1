"""Solve a scene's model: its keys in the integrator's terms, and advice in its words."""

from exu_press.solving.assembled import Assembled
from exu_press.solving.solve import DEFAULTS, scales, settings_for, solve

__all__ = ["DEFAULTS", "Assembled", "scales", "settings_for", "solve"]
