"""Bifurcation study, the long run over a key of the scene: sections, periods, exponents."""

from exu_press.studies.bifurcation.study import Bifurcation, Report, bifurcation

__all__ = ["Bifurcation", "Report", "bifurcation"]
