"""Observation: from curves to the numbers people compare."""

from exu_press.observe.acceleration import differentiated_peak, mean_peak, peak
from exu_press.observe.clearance import joint_summary
from exu_press.observe.summary import summary

__all__ = ["differentiated_peak", "joint_summary", "mean_peak", "peak", "summary"]
