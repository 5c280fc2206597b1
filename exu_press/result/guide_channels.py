"""Channels of the action of guides on their bodies, whatever kind of guide it is."""

from collections.abc import Mapping

from exu_press.mechanism import Mechanism
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, guide_channel, positive
from exu_press.result.declared import Declared

__all__ = ["CHANNELS", "guide_channels"]

CHANNELS = tuple(
    Declared(f"{{guide}}_{quantity}", unit, f"{{guide}}: {meaning}", axis, always=False)
    for quantity, unit, meaning, axis in (
        ("force", "N", "force on the body, {way}", ""),
        ("moment", "N m", "moment on the body, counter-clockwise", ""),
        ("friction", "N", "friction on the body, {way}", ""),
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

BY_QUANTITY = {declared.name.removeprefix("{guide}_"): declared for declared in CHANNELS}


def guide_channels(
    mechanism: Mechanism, body: str, values: Mapping[str, Array]
) -> dict[str, Channel]:
    """Return the channels of a guide's action on its body.

    Args:
        mechanism: with the guide.
        body: that it guides.
        values: by quantity, as "force" (N, across), "moment" (N m), "friction" (N, along) and
            "loss" (J).
    """
    guide = next(guide for guide in mechanism.guides if guide.body == body)
    place, words = guide_channel(mechanism, body), f"{body.replace('_', ' ')} guide"
    channels: dict[str, Channel] = {}
    for quantity, history in values.items():
        way = positive(guide.direction if quantity == "friction" else guide.normal)
        channels |= BY_QUANTITY[quantity].record(history, place, words=words, way=way)
    return channels
