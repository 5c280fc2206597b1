"""Observation: from curves to the numbers people compare."""

from exu_press.observe.acceleration import differentiated_peak, mean_peak, mean_peak_of, peak
from exu_press.observe.clearance import joint_summary
from exu_press.observe.dead_centre import (
    DeadCentre,
    bottom_dead_centres,
    ideal_bottom_angle,
    lowest_of_strokes,
)
from exu_press.observe.press import press_summary
from exu_press.observe.summary import summary

__all__ = [
    "DeadCentre",
    "bottom_dead_centres",
    "differentiated_peak",
    "ideal_bottom_angle",
    "joint_summary",
    "lowest_of_strokes",
    "mean_peak",
    "mean_peak_of",
    "peak",
    "press_summary",
    "summary",
]
