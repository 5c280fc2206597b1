"""Stiff and extreme cases: every run is right, or says why not."""

from exu_press.studies.stability.case import Case
from exu_press.studies.stability.extremes import extremes
from exu_press.studies.stability.report import Report
from exu_press.studies.stability.study import stability

__all__ = ["Case", "Report", "extremes", "stability"]
