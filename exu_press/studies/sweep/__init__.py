"""Many runs of one scene: any of its keys on a grid, a list or a Latin hypercube; one table."""

from exu_press.studies.sweep.lines import report_lines
from exu_press.studies.sweep.run import sweep
from exu_press.studies.sweep.study import Sweep
from exu_press.studies.sweep.table import Table

__all__ = ["Sweep", "Table", "report_lines", "sweep"]
