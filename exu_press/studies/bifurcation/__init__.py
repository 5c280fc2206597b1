"""Bifurcation study, the long run over a key of the scene: sections, periods, exponents."""

from exu_press.studies.bifurcation.report import BifurcationReport, Branch
from exu_press.studies.bifurcation.run import bifurcation
from exu_press.studies.bifurcation.study import Bifurcation

__all__ = ["Bifurcation", "BifurcationReport", "Branch", "bifurcation"]
