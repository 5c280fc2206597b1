"""Shares of tolerances: Sobol indices, a tornado, and the spread that tolerances make."""

from exu_press.studies.sensitivity.run import Report, sensitivity
from exu_press.studies.sensitivity.study import Sensitivity

__all__ = ["Report", "Sensitivity", "sensitivity"]
