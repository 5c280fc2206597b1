"""Results: channels over time, saved and loaded as one file."""

from exu_press.result.channel import Channel
from exu_press.result.joint import JointRecord
from exu_press.result.record import record
from exu_press.result.result import Result

__all__ = ["Channel", "JointRecord", "Result", "record"]
