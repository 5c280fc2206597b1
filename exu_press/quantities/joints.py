"""Quantities of joints: eccentricity, force, film and contact."""

import numpy as np
from numpy.typing import NDArray

from exu_press.numerics.arrays import Array, lengths
from exu_press.quantities.kind import COUNT, ENERGY, LOAD, MEASURE, MOTION, SHARE
from exu_press.quantities.law_errors import eccentricity_error, film_error
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.result import JointRecord
from exu_press.scene import IdealJoint, Scene
from exu_press.scene.joint import is_fed

__all__ = ["IMPACTS", "JOINTS", "START", "contact_onsets", "share_of_contact"]


def contact_onsets(depth: Array) -> NDArray[np.intp]:
    """Return the instants, by number, at which surfaces begin to touch that did not before.

    Args:
        depth: (n,), m, of the penetration beyond the contact onset.
    """
    touching = depth > 0.0
    return np.flatnonzero(touching[1:] & ~touching[:-1]) + 1


def share_of_contact(time: Array, depth: Array) -> float:
    """Return the share of time in which surfaces touch.

    Args:
        time: (n,), s.
        depth: (n,), m, of the penetration beyond the contact onset, linear between instants.
    """
    span = np.diff(time)
    if not len(span):
        return 0.0
    depth_before, depth_after = np.maximum(depth[:-1], 0.0), np.maximum(depth[1:], 0.0)
    apart = np.maximum(-depth[:-1], 0.0) + np.maximum(-depth[1:], 0.0)
    above = depth_before + depth_after
    share = np.divide(above, above + apart, out=np.zeros_like(span), where=above > 0.0)
    return float(span @ share / span.sum())


def _has_clearance(scene: Scene, joint: str) -> bool:
    return not isinstance(scene.joints[joint], IdealJoint)


def _has_film(scene: Scene, joint: str) -> bool:
    return scene.joints[joint].kind == "lubricated"


def _is_fed(scene: Scene, joint: str) -> bool:
    return is_fed(scene.joints[joint])


def _can_touch(scene: Scene, joint: str) -> bool:
    return scene.joints[joint].onset is not None


def _record(run: Reading, joint: str) -> JointRecord:
    return run.result.joints[joint]


def _depth(run: Reading, joint: str) -> Array:
    onset = run.result.scene.joints[joint].onset
    assert onset is not None
    return onset - _record(run, joint).gap


def _start(run: Reading, _: str) -> float | None:
    """Return the largest joint force before the settled part, over the largest one in it."""
    unsettled = run.run.time < run.time[0]
    if not unsettled.any():
        return None
    names = list(run.result.joints)
    largest = [
        max(float(lengths(force).max()) for force in forces)
        for forces in (
            [run.run.joints[name].force[unsettled] for name in names],
            [run.result.joints[name].force for name in names],
        )
    ]
    return largest[0] / largest[1] if largest[1] else None


START = Quantity(
    "start_ratio", "",
    "largest joint force before quantities are read, over the largest one after it",
    MEASURE, _start,
    available=lambda scene, _: scene.settle_revolutions > 0.0,
    title="joint forces: start / settled", digits=3,
)  # fmt: skip

IMPACTS = Quantity(
    "impacts", "", "number of times that surfaces apart begin to touch",
    COUNT, lambda run, joint: len(contact_onsets(_depth(run, joint))), Owner.JOINT, _can_touch,
    title="impacts", cumulative=True,
)  # fmt: skip

JOINTS = (
    Quantity("max_eccentricity_ratio", "", "largest eccentricity over the radial clearance",
             MOTION,
             lambda run, joint:
                 float(_record(run, joint).distance.max() / _record(run, joint).clearance),
             Owner.JOINT, _has_clearance,
             title="eccentricity ratio, max", extreme=Extreme.LARGEST, headline=True,
             law_error=eccentricity_error, curve="ratio"),
    Quantity("peak_force", "N", "largest force between journal and bearing",
             LOAD, lambda run, joint: run.peak(f"{joint}_force"), Owner.JOINT,
             title="joint force, max", display_unit="kN", extreme=Extreme.LARGEST, headline=True,
             curve="force"),
    START,
    Quantity("peak_penetration", "m", "largest penetration of the surfaces",
             MOTION, lambda run, joint: float(max(0.0, -_record(run, joint).gap.min())),
             Owner.JOINT, _can_touch,
             title="penetration, max", display_unit="um", extreme=Extreme.LARGEST),
    Quantity("min_film", "m", "least film thickness, 0 where surfaces touch",
             MOTION, lambda run, joint: float(max(0.0, _record(run, joint).gap.min())),
             Owner.JOINT, _has_film,
             title="film thickness, min", display_unit="um", extreme=Extreme.LEAST,
             law_error=film_error, curve="gap"),
    IMPACTS,
    Quantity("share_free_flight", "", "share of time in which the surfaces do not touch",
             SHARE, lambda run, joint: 1.0 - share_of_contact(run.time, _depth(run, joint)),
             Owner.JOINT, _can_touch),
    Quantity("share_contact", "", "share of time in which the surfaces touch",
             SHARE, lambda run, joint: share_of_contact(run.time, _depth(run, joint)),
             Owner.JOINT, _can_touch,
             title="share in contact"),
    Quantity("dissipated", "J", "energy that contact, friction and film have dissipated",
             ENERGY, lambda run, joint: float(run[f"{joint}_loss"][-1]), Owner.JOINT,
             _has_clearance, title="energy dissipated", cumulative=True, law_error=film_error),
    Quantity("dissipated_per_stroke", "J",
             "energy that the joint dissipates per revolution, over whole revolutions",
             ENERGY, lambda run, joint: run.per_stroke(run[f"{joint}_loss"]), Owner.JOINT,
             _has_clearance, title="per stroke", is_detail=True, signed=True, law_error=film_error),
    Quantity("mean_power", "W", "mean power that the joint dissipates, over whole revolutions",
             LOAD, lambda run, joint: run.rate(run[f"{joint}_loss"]), Owner.JOINT, _has_clearance,
             signed=True, law_error=film_error),
    Quantity("film.pump_power", "W",
             "power of the pump that feeds its grooves, mean over whole revolutions",
             LOAD, lambda run, joint: run.mean(run[f"{joint}_pump_power"]), Owner.JOINT, _is_fed,
             signed=True, law_error=film_error),
)  # fmt: skip
