"""The two sides of the press: shown as one where they do the same."""

from collections.abc import Collection, Iterable

import numpy as np

from exu_press.plots.words import joint_in_words
from exu_press.result import Result

__all__ = ["SIDES", "joint_titles", "mirror", "sides_alike"]

SIDES = ("left", "right")
ALIKE = 1e-3
"""Largest difference of the two sides, relative to the peak, that a picture does not show."""


def mirror(channel: str) -> str:
    """Return the name of the other side's channel, or the name itself where there is none.

    >>> mirror("ball_left_force"), mirror("crank_pin_force")
    ('ball_right_force', 'crank_pin_force')
    """
    left, right = (f"_{side}_" for side in SIDES)
    return channel.replace(left, right) if left in channel else channel.replace(right, left)


def sides_alike(results: Iterable[Result], channel: str) -> bool:
    """Return whether a channel, (n,) or vectors (n, k), is the same on both sides.

    They are mirror images: the sideways component has the opposite sign.
    """
    other = mirror(channel)
    for result in results:
        if channel in result and other in result:
            one, two = result[channel], result[other]
            if one.ndim == 2:
                two = two * np.where(np.arange(two.shape[1]) == 0, -1.0, 1.0)
            if np.abs(one - two).max() > ALIKE * np.abs(one).max():
                return False
    return True


def joint_titles(
    results: Collection[Result], names: Iterable[str], quantity: str = "force"
) -> dict[str, str]:
    """Return joints with their titles; one of two sides that do the same.

    Args:
        results: in which the sides are looked at.
        names: of the joints, the one to show of two sides first.
        quantity: end of the name of the joint's channel.
    """
    shown: dict[str, str] = {}
    for name in names:
        channel, title = f"{name}_{quantity}", joint_in_words(name)
        if mirror(channel) != channel and sides_alike(results, channel):
            if mirror(channel).removesuffix(f"_{quantity}") in shown:
                continue
            title = f"{title.partition(',')[0]}, each side"
        shown[name] = title
    return shown
