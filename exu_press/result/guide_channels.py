"""Channels of the action of guides on their bodies, whatever kind of guide it is."""

from exu_press.mechanism import Mechanism
from exu_press.numerics.arrays import Array
from exu_press.result.channel import (
    Channel,
    Declaration,
    Declarations,
    direction_text,
    guide_channel,
)

__all__ = ["CHANNELS", "guide_channels"]

CHANNELS = Declarations(
    *(
        Declaration(f"{{guide}}_{quantity}", unit, f"{{guide}}: {meaning}", axis, always=False)
        for quantity, unit, meaning, axis in (
            ("force", "N", "force on the body, {positive}", ""),
            ("moment", "N m", "moment on the body, counter-clockwise", ""),
            ("friction", "N", "friction on the body, {positive}", ""),
            (
                "normal_force",
                "N",
                "normal forces on the body's back and front end, on the right side +",
                "guided",
            ),
            ("sliding", "m/s", "sliding velocity of both ends", "guided"),
            ("loss", "J", "energy dissipated since the start", ""),
            ("gap", "m", "least thickness of its film, or minus the penetration", ""),
        )
    )
)


def guide_channels(mechanism: Mechanism, body: str, **values: Array) -> dict[str, Channel]:
    """Return the channels of a guide's action on its body.

    Args:
        mechanism: with the guide.
        body: that it guides.
        values: by quantity, as force (N, across), moment (N m), friction (N, along), loss (J).
    """
    guide = next(guide for guide in mechanism.guides if guide.body == body)
    owner, label = guide_channel(mechanism, body), f"{body.replace('_', ' ')} guide"
    channels: dict[str, Channel] = {}
    for quantity, history in values.items():
        positive = direction_text(guide.direction if quantity == "friction" else guide.normal)
        channels |= CHANNELS.record(owner, label=label, positive=positive, **{quantity: history})
    return channels
