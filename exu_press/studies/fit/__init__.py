"""Keys of a scene from a measurement: best values, and how well they are determined."""

from exu_press.studies.fit.run import Report, fit
from exu_press.studies.fit.study import Fit

__all__ = ["Fit", "Report", "fit"]
