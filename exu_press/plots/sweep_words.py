"""Columns of a sweep in words, and their numbers in units that read well."""

import math
import re
from typing import Any

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.plots.typesetting import typeset
from exu_press.quantities.catalogue import find_quantity
from exu_press.quantities.units import meaning_of, unit_of

__all__ = ["axis_label", "in_unit", "label_with_unit", "setting", "words"]

PREFIXES = {-9: "n", -6: "u", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
PREFIXED = ("m", "s", "N", "N m", "J", "W", "Pa")


def in_unit(name: str, values: Array) -> tuple[Array, str]:
    """Return a column's numbers in a multiple of its SI unit that reads well, and that unit.

    >>> numbers, unit = in_unit("joints.crank_pin.peak_force", np.array([2e3, 4e3]))
    >>> numbers.tolist(), unit
    ([2.0, 4.0], 'kN')
    """
    unit = unit_of(name)
    largest = float(np.max(np.abs(values[np.isfinite(values)]), initial=0.0))
    if unit not in PREFIXED or largest == 0.0:
        return values, typeset(unit)
    power = 3 * math.floor(math.log10(largest) / 3.0 + 1e-9)
    power = min(max(power, min(PREFIXES)), max(PREFIXES))
    return values / 10.0**power, typeset(f"{PREFIXES[power]}{unit}")


def words(name: str) -> str:
    """Return a column in words.

    >>> words("joints.balls.clearance"), words("joints.crank_pin.peak_force")
    ('balls, radial clearance', 'crank pin: joint force, max')
    >>> words("speed_rpm"), words("load.blanking.force")
    ('crank speed', 'blanking, peak force')
    >>> words("mechanism.bodies.upper_link.mass")
    'upper link, mass'
    >>> words("guide.clearance")
    'clearance on each side of a guided body, whose two ends make contact with the guideways'
    """
    if (placed := find_quantity(name)) is not None:
        quantity, at = placed.quantity, placed.owner.replace("_", " ")
        title = quantity.title if quantity.title and not quantity.is_detail else quantity.meaning
        return f"{at}: {title}" if at else title
    parts = re.sub(r"^(joints|load|mechanism\.\w+)\.", "", name).split(".")
    meaning = re.sub(r" \(A-\d+\)|;.*", "", meaning_of(name))  # the assumption, what else is said
    if meaning.startswith(("of ", "on ")):
        meaning = f"{parts[-1].replace('_', ' ')} {meaning}"
    if name.startswith(("joints.", "load.")) and meaning:
        return f"{parts[0].replace('_', ' ')}, {meaning}"
    return meaning or ", ".join(key_word.replace("_", " ") for key_word in parts)


def axis_label(name: str) -> str:
    """Return a quantity in words, with the unit that is shown.

    >>> axis_label("peak_acceleration.resolved")
    'peak acceleration, m/s^2'
    """
    placed = find_quantity(name)
    return label_with_unit(name, "" if placed is None else placed.quantity.display_unit)


def label_with_unit(name: str, unit: str) -> str:
    """Return a column in words, with the unit of its numbers if they have any."""
    return f"{words(name)}, {unit}" if unit else words(name)


def setting(name: str, value: Any) -> str:
    """Return a key's value as a legend has it.

    >>> setting("speed_rpm", 300.0), setting("joints.balls.clearance", 1e-4)
    ('300 rpm', '100 µm')
    >>> setting("joints.crank_pin", "dry")
    'dry'
    """
    if isinstance(value, (str, bool)):
        return str(value) if isinstance(value, str) else f"{words(name)}: {value}"
    number, unit = in_unit(name, np.array(float(value)))
    return f"{number:g} {unit}" if unit else f"{words(name)} {number:g}"
