"""Many runs of one scene: any of its keys on a grid, a list or a Latin hypercube; one table."""

from exu_press.studies.sweep.report import SweepReport
from exu_press.studies.sweep.run import sweep
from exu_press.studies.sweep.study import Sweep

__all__ = ["Sweep", "SweepReport", "sweep"]
