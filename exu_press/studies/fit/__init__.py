"""Keys of a scene from a measurement: best values, and how well they are determined."""

from exu_press.studies.fit.report import FitReport
from exu_press.studies.fit.run import fit
from exu_press.studies.fit.study import Fit

__all__ = ["Fit", "FitReport", "fit"]
