"""Error against run time: what a setting costs and what it gives, against independent truths."""

from exu_press.studies.precision.cases import Case, case_of
from exu_press.studies.precision.report import Goal, Report
from exu_press.studies.precision.rows import Row
from exu_press.studies.precision.study import precision

__all__ = ["Case", "Goal", "Report", "Row", "case_of", "precision"]
