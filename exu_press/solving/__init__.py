"""Solve a scene's model: what the scene asks for, in the integrator's terms, and its words."""

from exu_press.solving.assembled import Assembled
from exu_press.solving.solve import DEFAULTS, scales, settings_for, solve

__all__ = ["DEFAULTS", "Assembled", "scales", "settings_for", "solve"]
