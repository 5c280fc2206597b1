"""Quantities of joints that wear."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from exu_press.arrays import Array
from exu_press.laws.wear import archard, worn_by_angle
from exu_press.mechanism import GROUND
from exu_press.quantities.kind import FLOW, LOAD
from exu_press.quantities.quantity import Extreme, Place, Quantity
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.result.windows import window
from exu_press.scene import DryJoint, Scene, mechanism_of

__all__ = ["WEAR", "Sliding", "sliding_of", "wear_depths"]

SECTORS = 72
"""Of 5 degrees, over each of which depths are means."""


@dataclass(frozen=True)
class Sliding:
    """Sliding of a dry revolute joint in each step.

    Attributes:
        force: normal, (n,), N; none out of contact.
        distance: that the surfaces slide on each other, (n,), m.
        on_journal: angle of the contact in the journal's frame, (n,), rad.
        on_bearing: the same in the bearing's.
    """

    force: Array
    distance: Array
    on_journal: Array
    on_bearing: Array


def sliding_of(result: Result, joint: str) -> Sliding:
    """Return what slides in a joint, in the n steps between the n + 1 instants of a run."""
    record, described = result.joints[joint], result.scene.joints[joint]
    assert isinstance(described, DryJoint)
    drawn = next(j for j in mechanism_of(result.scene).joints if j.name == joint)
    angles = [
        np.zeros_like(result.time)
        if body == GROUND
        else result["body_position"][:, result.bodies.index(body), 2]
        for body in (drawn.journal, drawn.bearing)
    ]
    eccentricity = record.eccentricity
    normal = eccentricity / np.maximum(record.distance, 1e-300)[:, None]
    pressing = np.where(record.gap < 0.0, -(record.force * normal).sum(axis=1), 0.0)
    force = np.maximum(0.5 * (pressing[1:] + pressing[:-1]), 0.0)
    middle = 0.5 * (normal[1:] + normal[:-1])
    moved = np.diff(eccentricity, axis=0)
    across = middle[:, 0] * moved[:, 1] - middle[:, 1] * moved[:, 0]
    turned = [np.diff(angle) for angle in angles]
    radius, bore = described.radius, described.radius + described.clearance
    place = np.arctan2(middle[:, 1], middle[:, 0])
    journal, bearing = (place - 0.5 * (angle[1:] + angle[:-1]) for angle in angles)
    distance = np.abs(across + radius * turned[0] - bore * turned[1])
    return Sliding(force, distance, journal, bearing)


def wear_depths(result: Result, joint: str) -> tuple[Array, Array]:
    """Return the depths worn off journal and bearing over the angle on each, 2 (72,), m.

    Those of the whole run, in sectors of 5 degrees that begin at the bodies' x axes.
    """
    wear, slid = result.scene.wear, sliding_of(result, joint)
    described = result.scene.joints[joint]
    assert wear is not None
    assert isinstance(described, DryJoint)
    volume = archard(wear.coefficient, wear.hardness, 1.0, 1.0) * slid.force * slid.distance
    width = 2.0 * np.pi * described.radius / SECTORS
    return (
        worn_by_angle(volume, slid.on_journal, SECTORS) / (width * wear.length),
        worn_by_angle(volume, slid.on_bearing, SECTORS) / (width * wear.length),
    )


def _wears(scene: Scene, joint: str) -> bool:
    """Return whether a joint wears: a dry one in the plane."""
    drawn = next(j for j in mechanism_of(scene).joints if j.name == joint)
    dry = isinstance(scene.joints[joint], DryJoint)
    return scene.wear is not None and dry and not drawn.spherical


def _per_revolution(worn: Callable[[Result, str], float], run: Reading, joint: str) -> float | None:
    """Return what whole revolutions wear, over their number; None where there is none."""
    if run.whole is None:
        return None
    last = window(run.result, run.whole, float(run.time[-1]))
    turns = (last["crank_angle"][-1] - last["crank_angle"][0]) / (2.0 * np.pi)
    return worn(last, joint) / float(turns)


def _volume(result: Result, joint: str) -> float:
    wear, slid = result.scene.wear, sliding_of(result, joint)
    assert wear is not None
    work = float((slid.force * slid.distance).sum())
    return archard(wear.coefficient, wear.hardness, work, 1.0)


def _depth(end: int, result: Result, joint: str) -> float:
    return float(wear_depths(result, joint)[end].max())


def _heat(run: Reading, joint: str) -> Array:
    """Return mean pressure times sliding speed in each step, (n,), W/m^2."""
    wear, described = run.result.scene.wear, run.result.scene.joints[joint]
    assert wear is not None
    assert isinstance(described, DryJoint)
    slid = sliding_of(run.result, joint)
    speed = slid.distance / np.diff(run.time)
    return np.asarray(slid.force * speed / (2.0 * described.radius * wear.length))


def _mean_heat(run: Reading, joint: str) -> float | None:
    if run.whole is None:
        return None
    steps = np.diff(run.time)
    inside = run.time[1:] > run.whole
    return float((_heat(run, joint) * steps)[inside].sum() / steps[inside].sum())


WEAR = (
    Quantity(
        "wear.volume",
        "m^3",
        "volume that a revolution wears off each of the two surfaces",
        FLOW,
        partial(_per_revolution, _volume),
        Place.JOINT,
        _wears,
    ),
    Quantity(
        "wear.bearing_depth",
        "m",
        "largest depth that a revolution wears off the bearing, mean over 5 degrees",
        FLOW,
        partial(_per_revolution, partial(_depth, 1)),
        Place.JOINT,
        _wears,
        title="worn off the bearing per revolution, max",
        shown="um",
    ),
    Quantity(
        "wear.journal_depth",
        "m",
        "largest depth that a revolution wears off the journal, mean over 5 degrees",
        FLOW,
        partial(_per_revolution, partial(_depth, 0)),
        Place.JOINT,
        _wears,
    ),
    Quantity(
        "wear.pressure_velocity",
        "W/m^2",
        "mean of pressure on the projected area times sliding speed, over whole revolutions",
        LOAD,
        _mean_heat,
        Place.JOINT,
        _wears,
    ),
    Quantity(
        "wear.peak_pressure_velocity",
        "W/m^2",
        "largest pressure on the projected area times sliding speed",
        LOAD,
        lambda run, joint: float(_heat(run, joint).max(initial=0.0)),
        Place.JOINT,
        _wears,
        extreme=Extreme.LARGEST,
    ),
)
