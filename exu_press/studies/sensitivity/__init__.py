"""Shares of tolerances: Sobol indices, a tornado, and the spread that tolerances make."""

from exu_press.studies.sensitivity.report import SensitivityReport
from exu_press.studies.sensitivity.run import sensitivity
from exu_press.studies.sensitivity.study import Sensitivity

__all__ = ["Sensitivity", "SensitivityReport", "sensitivity"]
