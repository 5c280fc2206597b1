"""Stiff and extreme cases: every run is right, or says why not."""

from exu_press.studies.stability.cases import Case, cases, quick_cases
from exu_press.studies.stability.report import Report
from exu_press.studies.stability.study import stability

__all__ = ["Case", "Report", "cases", "quick_cases", "stability"]
