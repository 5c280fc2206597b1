"""Stiff and extreme cases: every run is right, or says why not."""

from exu_press.studies.stability.cases import Case, extremes
from exu_press.studies.stability.report import Row, StabilityReport
from exu_press.studies.stability.run import StabilityStudy, stability

__all__ = ["Case", "Row", "StabilityReport", "StabilityStudy", "extremes", "stability"]
