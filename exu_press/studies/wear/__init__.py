"""Wear over many strokes: cycle jumps, the gaps' shapes renewed, the runs repeated."""

from exu_press.studies.wear.run import Report, wear
from exu_press.studies.wear.study import Strokes, WearStudy

__all__ = ["Report", "Strokes", "WearStudy", "wear"]
