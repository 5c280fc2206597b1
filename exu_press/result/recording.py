"""Input and output of a recorder."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from exu_press.mechanism import Motion
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel

if TYPE_CHECKING:
    from exu_press.joints.history import JointHistory
    from exu_press.model import Model

__all__ = ["Record", "Recording"]


@dataclass(frozen=True)
class Record:
    """Channels and energies of one recorder, or the sums of several.

    Attributes:
        channels: by their names.
        stored: energy, (n,), J.
        dissipated: energy since the start, (n,), J, by `exu_press.result.energy.work` where it is
            that of a load: the power at the ends of a step does not give it.
        supplied: work since the start, (n,), J.
        info: entries of the run's `Info`.
    """

    channels: dict[str, Channel]
    stored: Array | float = 0.0
    dissipated: Array | float = 0.0
    supplied: Array | float = 0.0
    info: Mapping[str, Any] = field(default_factory=dict)

    def __add__(self, record: "Record") -> "Record":
        """Return the channels of both and the sums of their energies."""
        return Record(
            self.channels | record.channels,
            self.stored + record.stored,
            self.dissipated + record.dissipated,
            self.supplied + record.supplied,
            {**self.info, **record.info},
        )


@dataclass(frozen=True)
class Recording:
    """An integrated model, and results of it that several recorders need.

    Attributes:
        model: integrated.
        time: (n,), s.
        motions: of every body's frame.
        turned: motion of the body that the drive turns.
        histories: of every joint with clearance.
        so_far: record of the preceding recorders.
    """

    model: "Model"
    time: Array
    motions: Mapping[str, Motion]
    turned: Motion
    histories: "Mapping[str, JointHistory]"
    so_far: Record

    def __contains__(self, channel: str) -> bool:
        """Return whether the preceding recorders have a channel."""
        return channel in self.so_far.channels

    def __getitem__(self, channel: str) -> Array:
        """Return the values of a channel of the preceding recorders."""
        return self.so_far.channels[channel].values
