"""Results: channels over time, saved and loaded as one file."""

from typing import TYPE_CHECKING

from fe_models.lazy import lazy_names

if TYPE_CHECKING:
    from exu_press.result.channel import Channel
    from exu_press.result.joint import JointRecord
    from exu_press.result.record_run import record
    from exu_press.result.result import Result

__all__ = ["Channel", "JointRecord", "Result", "record"]

__getattr__ = lazy_names(__name__)
