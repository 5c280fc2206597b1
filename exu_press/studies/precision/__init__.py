"""Work-precision study: error against run time of settings, by independent references."""

from exu_press.studies.precision.cases import Case, case_of
from exu_press.studies.precision.report import PrecisionReport
from exu_press.studies.precision.rows import Row
from exu_press.studies.precision.run import precision

__all__ = ["Case", "PrecisionReport", "Row", "case_of", "precision"]
