"""Many joints in one picture: of two like sides one, and the busiest few."""

from collections.abc import Collection, Iterable

import numpy as np

from exu_press.plots.typesetting import shorten
from exu_press.plots.words import joint_in_words
from exu_press.result import Result

__all__ = ["busiest", "joint_titles", "mirror", "sides_alike"]

TITLE = 30
"""Letters of a joint's title that fit beside the legend or the note of its panel."""

SIDES = ("left", "right")
ALIKE = 1e-3
"""Largest difference of the two sides, relative to the peak, that a picture does not show."""


def busiest(
    results: Collection[Result], names: Iterable[str], quantity: str, most: int
) -> tuple[dict[str, str], dict[str, str]]:
    """Return the joints to draw and the rest, each joint with its title; one of two equal sides.

    Args:
        results: of the runs in the picture.
        names: of the joints, in the picture's order.
        quantity: whose channels tell whether two sides do the same.
        most: joints to draw; those with the largest forces.
    """
    titles = joint_titles(results, names, quantity)
    force = {name: max(_peak(result, name) for result in results) for name in titles}
    drawn = sorted(titles, key=lambda name: -force[name])[:most]
    return (
        {name: title for name, title in titles.items() if name in drawn},
        {name: title for name, title in titles.items() if name not in drawn},
    )


def _peak(result: Result, name: str) -> float:
    """Return the largest force in a joint, N; that of a guide as well."""
    if f"{name}_force" not in result:
        return 0.0
    force = result[f"{name}_force"]
    return float(np.linalg.norm(force.reshape(len(force), -1), axis=1).max())


def mirror(channel: str) -> str:
    """Return the name of the other side's channel, or the name itself where there is none.

    >>> mirror("ball_left_force"), mirror("crank_pin_force")
    ('ball_right_force', 'crank_pin_force')
    """
    first, second = (f"_{side}_" for side in SIDES)
    return channel.replace(first, second) if first in channel else channel.replace(second, first)


def sides_alike(results: Iterable[Result], channel: str) -> bool:
    """Return whether a channel, (n,) or vectors (n, k), is the same on both sides.

    They are mirror images: the sideways component has the opposite sign.
    """
    mirrored = mirror(channel)
    for result in results:
        if channel in result and mirrored in result:
            values, mirrored_values = result[channel], result[mirrored]
            if values.ndim == 2:
                mirrored_values = mirrored_values * np.where(
                    np.arange(mirrored_values.shape[1]) == 0, -1.0, 1.0
                )
            if np.abs(values - mirrored_values).max() > ALIKE * np.abs(values).max():
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
    titles: dict[str, str] = {}
    for name in names:
        channel, title = f"{name}_{quantity}", shorten(joint_in_words(name), TITLE)
        if mirror(channel) != channel and sides_alike(results, channel):
            if mirror(channel).removesuffix(f"_{quantity}") in titles:
                continue
            title = f"{title.partition(',')[0]}, each side"
        titles[name] = title
    return titles
