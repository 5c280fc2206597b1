"""The keys of the best press: by one objective, or by several against each other."""

from exu_press.studies.optimise.report import OptimiseReport
from exu_press.studies.optimise.run import optimise
from exu_press.studies.optimise.study import Optimise

__all__ = ["Optimise", "OptimiseReport", "optimise"]
