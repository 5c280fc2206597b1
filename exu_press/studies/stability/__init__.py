"""Stiff and extreme cases: every run is right, or says why not."""

from exu_press.studies.stability.cases import Case, extremes
from exu_press.studies.stability.report import Report, Row
from exu_press.studies.stability.study import stability

__all__ = ["Case", "Report", "Row", "extremes", "stability"]
