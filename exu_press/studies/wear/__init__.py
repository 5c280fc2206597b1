"""Wear over many strokes: cycle jumps, the gaps' shapes renewed, the runs repeated."""

from exu_press.studies.wear.report import WearReport
from exu_press.studies.wear.run import wear
from exu_press.studies.wear.study import Strokes, WearStudy

__all__ = ["Strokes", "WearReport", "WearStudy", "wear"]
