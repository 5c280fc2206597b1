"""Channels of gears."""

from exu_press.result.channel import Channel, Declaration, Declarations
from exu_press.result.motion import sensor
from exu_press.result.recording import Record, Recording

__all__ = ["CHANNELS", "record"]

CHANNELS = Declarations(
    Declaration(
        "gear_{gear}_torque",
        "N m",
        "gear {gear}: torque on its body, counter-clockwise",
        always=False,
    )
)


def record(run: Recording) -> Record:
    """Return the torque of every gear that is not redundant; it does no work."""
    channels: dict[str, Channel] = {}
    for name in run.model.constraints.gears:
        channels |= CHANNELS.record(name, torque=sensor(run.model, f"gear_{name}", "torque")[:, 0])
    return Record(channels)
