"""What becomes of the long run as a key of the scene varies: sections, periods, exponents."""

from exu_press.studies.bifurcation.study import Bifurcation, Report, bifurcation

__all__ = ["Bifurcation", "Report", "bifurcation"]
