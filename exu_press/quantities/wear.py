"""Quantities of joints and guides that wear."""

import dataclasses
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from exu_press.laws.profile import Profile
from exu_press.laws.wear import Contacts, archard, worn_by_angle
from exu_press.mechanism import GROUND
from exu_press.mechanism.guide_motion import pose_in_guide
from exu_press.numerics.arrays import Array
from exu_press.quantities.kind import COUNT, FLOW, LOAD
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.result.channel import guide_channel
from exu_press.result.windows import interpolated_window
from exu_press.scene import DryJoint, LubricatedJoint, Scene, mechanism_of
from exu_press.scene.joint import unworn

__all__ = [
    "SECTORS",
    "WEAR",
    "Sliding",
    "contacts_of",
    "guideway_depths",
    "pin_depths",
    "sliding_of",
    "wear_depths",
    "wear_of_a_revolution",
]

SECTORS = 72
"""Sectors of 5 degrees over which depths are averaged; as many parts of a guideway."""

AT_ONCE = 4096
"""Steps of a block."""


@dataclass(frozen=True)
class Sliding:
    """Rubbing in a joint, or at one end of a guided body, between the instants of a run.

    Attributes:
        work: normal force times the way on which it slides, in each step, (n,), N m.
        power: normal force times sliding speed at the instants, (n + 1,), W.
    """

    work: Array
    power: Array


def sliding_of(result: Result, joint: str) -> Sliding:
    """Return the rubbing in a joint."""
    return _rub(result, result[f"{joint}_normal_force"], result[f"{joint}_sliding"])


def _rub(result: Result, force: Array, speed: Array) -> Sliding:
    power = np.maximum(force, 0.0) * np.abs(speed)
    return Sliding(0.5 * (power[1:] + power[:-1]) * np.diff(result.time), power)


def wear_depths(result: Result, joint: str) -> tuple[Array, Array]:
    """Return the depths worn off journal and bearing over the angle on each, 2 (72,), m.

    Those of the whole run, in sectors of 5 degrees that begin at the bodies' x axes. Each step's
    volume is spread over where the round surfaces overlap, as deep as they do there.
    """
    area = _sector(result.scene, joint)
    depths = [np.zeros(SECTORS), np.zeros(SECTORS)]
    for steps in _rubbing_steps(result, joint):
        for end in (0, 1):
            depths[end] += worn_by_angle(steps.volume, steps.overlap(end))
    return depths[0] / area, depths[1] / area


def _sector(scene: Scene, joint: str) -> float:
    """Return the area of a sector of a joint's surfaces, m^2."""
    described = scene.joints[joint]
    assert isinstance(described, DryJoint | LubricatedJoint)
    length = scene.wearing["joints"][joint].length
    return 2.0 * np.pi * described.radius / SECTORS * length


def contacts_of(result: Result, joint: str, turns: float) -> Contacts:
    """Return where a joint rubs in the mean of so many revolutions, in sectors of both bodies."""
    sums = np.zeros((SECTORS * SECTORS, 6))
    for steps in _rubbing_steps(result, joint):
        direction = np.arctan2(steps.eccentricity[:, 1], steps.eccentricity[:, 0])
        direction -= steps.turned[1]
        turned = steps.turned[0] - steps.turned[1]
        angles = (direction, turned)
        row, column = ((a / (2.0 * np.pi) * SECTORS).astype(int) % SECTORS for a in angles)
        values = np.column_stack(
            [np.ones_like(turned), np.maximum(steps.overlap(1), 0.0).sum(axis=1)]
            + [f(a) for a in angles for f in (np.cos, np.sin)]
        )
        np.add.at(sums, row * SECTORS + column, steps.volume[:, None] * values)
    sums = sums[sums[:, 0] > 0.0]
    return Contacts(
        direction=np.arctan2(sums[:, 3], sums[:, 2]),
        turned=np.arctan2(sums[:, 5], sums[:, 4]),
        overlap=sums[:, 1] / sums[:, 0],
        volume=sums[:, 0] / turns,
        area=_sector(result.scene, joint),
    )


@dataclass(frozen=True)
class _Steps:
    """Some steps in which a joint rubs.

    Attributes:
        volume: worn off each surface, (n,), m^3.
        eccentricity: (n, 2), m.
        turned: angles of journal's and of bearing's body, (n,) each, rad.
        reach: distance at which round surfaces touch, m.
        shapes: of journal and bearing, of worn ones, as tables over the angle.
    """

    volume: Array
    eccentricity: Array
    turned: tuple[Array, Array]
    reach: float
    shapes: list[tuple[Array, Array]]

    def overlap(self, end: int) -> Array:
        """Return the surfaces' overlap in the sectors of journal, 0, or bearing, 1, (n, 72), m."""
        sectors = 2.0 * np.pi * (np.arange(SECTORS) + 0.5) / SECTORS
        angle = sectors + self.turned[end][:, None]  # of the sectors, as they lie
        x, y = self.eccentricity[:, :1], self.eccentricity[:, 1:]
        overlap = x * np.cos(angle) + y * np.sin(angle) - self.reach
        for shape, turned in zip(self.shapes, self.turned, strict=False):
            overlap -= np.interp(angle - turned[:, None], *shape, period=2.0 * np.pi)
        return np.asarray(overlap)


def _rubbing_steps(result: Result, joint: str) -> Iterator[_Steps]:
    """Yield the steps in which a joint rubs, AT_ONCE at a time."""
    wear, described = result.scene.wearing["joints"][joint], result.scene.joints[joint]
    assert isinstance(described, DryJoint | LubricatedJoint)
    drawn = next(j for j in mechanism_of(result.scene).joints if j.name == joint)
    angles = [
        np.zeros_like(result.time)
        if body == GROUND
        else result["body_position"][:, result.bodies.index(body), 2]
        for body in (drawn.journal, drawn.bearing)
    ]
    volume = archard(wear.coefficient, wear.hardness, 1.0, 1.0) * sliding_of(result, joint).work
    eccentricity = result.joints[joint].eccentricity[:, :2]
    at, turned_j, turned_b = (0.5 * (v[1:] + v[:-1]) for v in (eccentricity, *angles))
    mean = unworn(described)
    reach = mean.clearance - (mean.onset or 0.0)
    profiles = None if described.worn is None else described.worn.profiles()
    shapes = [_sample_profile(shape) for shape in profiles or ()]
    rubbing = np.flatnonzero(volume)
    for first in range(0, len(rubbing), AT_ONCE):
        steps = rubbing[first : first + AT_ONCE]
        yield _Steps(volume[steps], at[steps], (turned_j[steps], turned_b[steps]), reach, shapes)


def _sample_profile(shape: Profile) -> tuple[Array, Array]:
    """Return a profile in steps of half a degree."""
    angles = [2.0 * np.pi * i / 720 for i in range(720)]
    return np.array(angles), np.array([shape.derivatives(angle)[0] for angle in angles])


def guideway_depths(result: Result, name: str) -> Array:
    """Return the depths worn off the guideway of a guide, (2, 2, 72), or of a slot, (1, 2, 72), m.

    By its back and front end or the pin, on the left and on the right, in 72 parts of each one's
    path. The ends' own edges lose as much, and have no depth; for a pin see `pin_depths`.
    """
    wear = result.scene.wearing["guides"][name]
    mechanism, poses = mechanism_of(result.scene), result["body_position"]
    guide = mechanism.guide(name)
    position = pose_in_guide(mechanism, guide, result.bodies, poses)[:, :2] @ np.array(
        guide.direction
    )
    middle = 0.5 * (position[1:] + position[:-1])
    low, high = float(position.min()), float(position.max())
    width = max(high - low, 1e-30) / SECTORS
    cell = np.clip(((middle - low) / width).astype(int), 0, SECTORS - 1)
    rate = archard(wear.coefficient, wear.hardness, 1.0, 1.0) / (width * wear.length)
    return np.array(
        [
            [
                rate * np.bincount(cell, _rub(result, sign * force, speed).work, SECTORS)
                for sign in (-1.0, 1.0)
            ]
            for force, speed in _walls(result, name)
        ]
    )


def _walls(result: Result, name: str) -> list[tuple[Array, Array]]:
    """Return normal force, on the right +, and sliding velocity of a guide's ends, or of a pin."""
    mechanism = mechanism_of(result.scene)
    channel = guide_channel(mechanism, name)
    if mechanism.guide(name).is_slot:
        return [(result[f"{channel}_wall_force"], result[f"{channel}_pin_sliding"])]
    return list(
        zip(result[f"{channel}_normal_force"].T, result[f"{channel}_sliding"].T, strict=True)
    )


def pin_depths(result: Result, name: str) -> Array:
    """Return the depths worn off the pin of a slot over the angle from its body's x axis, (72,), m.

    In sectors of 5 degrees: the pin touches a straight wall along one line.
    """
    wear, mechanism = result.scene.wearing["guides"][name], mechanism_of(result.scene)
    guide = mechanism.guide(name)
    assert guide.at is not None and guide.guideway is not None
    pose = pose_in_guide(mechanism, guide, result.bodies, result["body_position"])
    ((force, speed),) = _walls(result, name)
    to_right = np.arctan2(guide.normal[1], guide.normal[0]) - pose[:, 2]
    if guide.centre is not None:
        along = (pose[:, :2] - np.array(guide.at)) @ np.array(guide.direction)
        to_right += along / np.hypot(*np.subtract(guide.at, guide.centre))
    middle = 0.5 * (to_right[1:] + to_right[:-1])
    area = 2.0 * np.pi * guide.guideway.half_width / SECTORS * wear.length
    rate = archard(wear.coefficient, wear.hardness, 1.0, 1.0) / area
    depths = np.zeros(SECTORS)
    for sign, turned in ((1.0, middle), (-1.0, middle + np.pi)):
        sector = np.floor(turned / (2.0 * np.pi) * SECTORS).astype(int) % SECTORS
        depths += rate * np.bincount(sector, _rub(result, sign * force, speed).work, SECTORS)
    return depths


def wear_of_a_revolution(result: Result) -> dict[str, Any]:
    """Return where joints rub in the mean settled revolution, and what it wears off guideways.

    "contacts": joint -> see Contacts; "guideways": guided body -> largest depth, m; for JSON.
    """
    run = Reading(result)
    depths: dict[str, dict[str, Any]] = {"contacts": {}, "guideways": {}}
    if run.whole is None:
        return depths
    last, turns = _whole(run, run.whole), run.revolutions
    for joint in result.scene.wearing["joints"]:
        contacts = dataclasses.asdict(contacts_of(last, joint, turns))
        depths["contacts"][joint] = {
            name: values.tolist() if name != "area" else values for name, values in contacts.items()
        }
    for body in result.scene.wearing["guides"]:
        depths["guideways"][body] = _guideway_depth(last, body) / turns
    return depths


def _whole(run: Reading, begin: float) -> Result:
    """Return the whole revolutions of a run."""
    return interpolated_window(run.result, begin, float(run.time[-1]))


def _wears(scene: Scene, joint: str) -> bool:
    return joint in scene.wearing["joints"]


def _guide_wears(scene: Scene, body: str) -> bool:
    return body in scene.wearing["guides"]


def _pin_wears(scene: Scene, name: str) -> bool:
    return _guide_wears(scene, name) and mechanism_of(scene).guide(name).is_slot


def _per_revolution(worn: Callable[[Result, str], float], run: Reading, owner: str) -> float | None:
    """Return the mean wear of whole revolutions; None where there is none."""
    if run.whole is None:
        return None
    return worn(_whole(run, run.whole), owner) / run.revolutions


def _volume(result: Result, joint: str) -> float:
    wear = result.scene.wearing["joints"][joint]
    work = float(sliding_of(result, joint).work.sum())
    return archard(wear.coefficient, wear.hardness, work, 1.0)


def _ends(result: Result, body: str) -> list[Sliding]:
    """Return the rubbing at the ends of a guided body."""
    return [_rub(result, np.abs(force), speed) for force, speed in _walls(result, body)]


def _guide_volume(result: Result, body: str) -> float:
    wear = result.scene.wearing["guides"][body]
    work = sum(float(end.work.sum()) for end in _ends(result, body))
    return archard(wear.coefficient, wear.hardness, work, 1.0)


def _depth(end: int, result: Result, joint: str) -> float:
    return float(wear_depths(result, joint)[end].max())


def _pin_depth(result: Result, name: str) -> float:
    return float(pin_depths(result, name).max())


def _guideway_depth(result: Result, body: str) -> float:
    return float(guideway_depths(result, body).max())


def _deepest(run: Reading) -> dict[str, float]:
    """Return the largest depth of every joint and guide that wears, by owner."""
    result, scene = run.result, run.result.scene
    joints = {f"joints.{j}": max(_depth(0, result, j), _depth(1, result, j))
              for j in scene.wearing["joints"]}  # fmt: skip
    return joints | {
        f"guides.{b}": max(
            _guideway_depth(result, b), _pin_depth(result, b) if _pin_wears(scene, b) else 0.0
        )
        for b in scene.wearing["guides"]
    }


def _rank(kind: str, run: Reading, owner: str) -> int | None:
    depths = run.once(_deepest)
    return 1 + sum(depth > depths[f"{kind}.{owner}"] for depth in depths.values())


def _pressure_velocity(run: Reading, joint: str) -> Array:
    """Return mean pressure times sliding speed, (n,), W/m^2."""
    result, described = run.result, run.result.scene.joints[joint]
    assert isinstance(described, DryJoint | LubricatedJoint)
    area = 2.0 * described.radius * result.scene.wearing["joints"][joint].length
    return sliding_of(result, joint).power / area


def _guide_pressure_velocity(run: Reading, body: str) -> Array:
    result = run.result
    guide = mechanism_of(result.scene).guide(body)
    assert guide.guideway is not None
    across = 2.0 * guide.guideway.half_width if guide.is_slot else guide.guideway.length
    area = across * result.scene.wearing["guides"][body].length
    return np.asarray(sum(end.power for end in _ends(result, body)) / area)


def _mean(
    pressure_velocity: Callable[[Reading, str], Array], run: Reading, owner: str
) -> float | None:
    return None if run.whole is None else run.mean(pressure_velocity(run, owner))


def _largest(pressure_velocity: Callable[[Reading, str], Array], run: Reading, owner: str) -> float:
    return float(pressure_velocity(run, owner).max(initial=0.0))


def _shared_rows(owner: Owner) -> tuple[Quantity, ...]:
    """Return the quantities that both joints and guides have."""
    joint = owner is Owner.JOINT
    available, kind = (_wears, "joints") if joint else (_guide_wears, "guides")
    pressure_velocity = _pressure_velocity if joint else _guide_pressure_velocity
    area = "the projected area" if joint else "the guided face or a pin's projected area"
    return (
        Quantity("wear.volume", "m^3",
                 "volume that a revolution wears off each of the two surfaces",
                 FLOW, partial(_per_revolution, _volume if joint else _guide_volume), owner,
                 available),
        Quantity("wear.rank", "", "1 for the joint or guide that is worn deepest, and so on",
                 COUNT, partial(_rank, kind), owner, available),
        Quantity("wear.pressure_velocity", "W/m^2",
                 f"mean of pressure on {area} times sliding speed, over whole revolutions",
                 LOAD, partial(_mean, pressure_velocity), owner, available),
        Quantity("wear.peak_pressure_velocity", "W/m^2",
                 f"largest pressure on {area} times sliding speed",
                 LOAD, partial(_largest, pressure_velocity), owner, available,
                 extreme=Extreme.LARGEST),
    )  # fmt: skip


WEAR = (
    Quantity("wear.bearing_depth", "m",
             "largest depth that a revolution wears off the bearing, mean over 5 degrees",
             FLOW, partial(_per_revolution, partial(_depth, 1)), Owner.JOINT, _wears,
             title="worn per revolution, max", display_unit="um"),
    Quantity("wear.journal_depth", "m",
             "largest depth that a revolution wears off the journal, mean over 5 degrees",
             FLOW, partial(_per_revolution, partial(_depth, 0)), Owner.JOINT, _wears),
    Quantity("wear.guideway_depth", "m",
             "largest depth that a revolution wears off guideway or slot, mean over 1/72 of it",
             FLOW, partial(_per_revolution, _guideway_depth), Owner.GUIDE, _guide_wears),
    Quantity("wear.pin_depth", "m",
             "largest depth that a revolution wears off the slot's pin, mean over 5 degrees",
             FLOW, partial(_per_revolution, _pin_depth), Owner.GUIDE, _pin_wears),
    *_shared_rows(Owner.JOINT),
    *_shared_rows(Owner.GUIDE),
)  # fmt: skip
