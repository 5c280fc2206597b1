"""Checks of a run, and its agreement with a more accurate one."""

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from exu_press.integrate import SolverTuning
from exu_press.mechanism import GROUND, Motion, Point
from exu_press.numerics.arrays import Array
from exu_press.quantities.catalogue import ECCENTRICITY_RATIO, JOINT_FORCE, quantity_of
from exu_press.quantities.energy import energy_residual, energy_scale, kinetic_energy
from exu_press.result import Result
from exu_press.scene import LubricatedJoint, Scene, mechanism_of
from exu_press.scene.joint import TouchingJoint
from exu_press.verification.stated_errors import compare_errors

__all__ = ["RESIDUAL_LIMIT", "Check", "agreement", "checks_of"]

RESIDUAL_LIMIT = 1e-3
"""Largest residual of the energy balance, as in the summary."""

COARSE_RESIDUAL = 0.1
"""Times the tolerance: allowed residual of the energy where that is above a hundredth."""

DRIFT_LIMIT = 1e-9  # m

ENERGY_LIMIT = 1e-3
"""Energy that joints may seem to create, or to store beyond the available one, over that: the
uncertainty of the energy balance."""

NEGLIGIBLE = 0.01
"""Difference over a figure (of an eccentricity over the clearance) that does not count."""

ROUNDOFF = 1e-12
"""The same in the figure's unit: roundoff of tilts and means that are zero."""

ALLOWED_RATIO = 1.25
"""Difference from a finer run over the stated error. A run at a tenth of the tolerance has an error
itself, about 10^(-2/3) of the run's."""

AGREEMENT = "difference from a finer run, over the stated error"


@dataclass(frozen=True)
class Check:
    """One figure that must not be above its limit.

    Attributes:
        value: None where it is not finite.
        limit: in the same unit.
        note: the worst one, where there are several.
    """

    name: str
    value: float | None
    limit: float
    note: str = ""

    @property
    def is_within_limit(self) -> bool:
        """Return whether the figure is finite and not above its limit."""
        return self.value is not None and self.value <= self.limit

    def to_dict(self) -> dict[str, Any]:
        """Return the check as it stands in stability.json."""
        return {**asdict(self), "passed": self.is_within_limit}


def checks_of(result: Result) -> list[Check]:
    """Return the checks of one run that reached its end."""
    scale, lost = energy_scale(result), result["energy_dissipated"]
    coarse = COARSE_RESIDUAL * (result.scene.solver.tolerance or 0.0)
    created = float((np.maximum.accumulate(lost) - lost).max())
    drift, where = max(_joint_openings(result), default=(0.0, ""))
    checks = [
        _check("energy residual", energy_residual(result) or 0.0, max(RESIDUAL_LIMIT, coarse)),
        _check("constraint drift, m", drift, DRIFT_LIMIT, where),
        _check("energy created in joints", _ratio(created, scale), ENERGY_LIMIT),
    ]
    elastic = _elastic_energy(result)
    if elastic is not None:
        surplus = float((elastic - elastic[0] - _available_energy(result)).max())
        checks.append(_check("contact energy out of nothing", _ratio(surplus, scale), ENERGY_LIMIT))
    films = [
        float(result.joints[name].distance.max()) / joint.clearance
        for name, joint in result.scene.joints.with_clearance.items()
        if joint.onset is None
    ]
    if films:
        checks.append(_check("eccentricity ratio of the film", max(films), 1.0))
    return checks


def agreement(result: Result, finer: Result) -> Check:
    """Return a run's largest difference from a finer one over its stated error.

    Each figure may differ by its stated error, or by NEGLIGIBLE if that is more. Bounds of a figure
    that the scene does not determine hold 19 of 20 runs: it may differ by 1.5 times their distance.

    Args:
        result: with its errors.
        finer: the same scene at a smaller tolerance; with errors, its own count as well.
    """
    worst, which = 0.0, ""
    of_finer = finer.info.get("errors", {})
    for comparison in compare_errors(result, finer):
        error, stated = comparison.stated, comparison.stated["error"]
        if not error["determined"]:
            is_above = comparison.reference > comparison.value
            bound = error["high"] if is_above else error["low"]
            stated = 1.5 * (bound - comparison.value if is_above else comparison.value - bound)
        if comparison.name in of_finer:
            stated += of_finer[comparison.name]["error"]
        allowed = max(
            stated + comparison.reading_error,
            _negligible_difference(result.scene, comparison.name, comparison.reference),
        )
        if comparison.true_error == 0.0:
            continue  # also of a figure that is zero, with nothing allowed
        ratio = comparison.true_error / allowed if allowed else math.inf
        if not ratio <= worst:
            text = f"{comparison.value:.5g} +- {error['error']:.2g} for {comparison.reference:.5g}"
            worst, which = ratio, f"{comparison.name}: {text}"
    return _check(AGREEMENT, worst, ALLOWED_RATIO, which)


def _negligible_difference(scene: Scene, name: str, true: float) -> float:
    """Return the difference of a figure that does not count, in its unit."""
    placed = quantity_of(scene, name)
    if placed.quantity is ECCENTRICITY_RATIO:
        return NEGLIGIBLE
    least = ROUNDOFF
    if placed.quantity is JOINT_FORCE and placed.owner in scene.joints.with_clearance:
        least = _rounding(scene, placed.owner)
    return max(NEGLIGIBLE * abs(true), least)


def _joint_openings(result: Result) -> Iterator[tuple[float, str]]:
    """Yield the largest opening of every ideal joint and guide between rigid bodies, m."""
    scene, mechanism = result.scene, mechanism_of(result.scene)
    poses = result["body_position"]
    still = np.zeros_like(poses[:, 0])
    motions = {name: Motion(poses[:, i], still, still) for i, name in enumerate(result.bodies)}

    def world(body: str, point: Point) -> Array:
        return (
            np.array([point])
            if body == GROUND
            else motions[body].point_motion(point).position[:, :2]
        )

    for joint in mechanism.joints:
        rigid = not {joint.journal, joint.bearing} & set(scene.bodies)
        if rigid and joint.name in scene.joints.ideal:
            journal, bearing = mechanism.ends(joint)
            gap = world(*journal) - world(*bearing)
            yield float(np.linalg.norm(gap, axis=1).max()), joint.name


def _elastic_energy(result: Result) -> Array | None:
    """Return the elastic energy of all contacts, (n,), J; None where nothing may touch."""
    total, has_contact = np.zeros_like(result.time), False
    for name, joint in result.scene.joints.with_clearance.items():
        if not isinstance(joint, TouchingJoint) or joint.onset is None:
            continue
        law = joint.normal_contact(result.scene.angular_speed)
        if law is None:
            continue
        has_contact, record = True, result.joints[name]
        depth = joint.onset - record.gap
        total += [law.elastic_energy(d) for d in depth.tolist()]
    return total if has_contact else None


def _available_energy(result: Result) -> Array:
    """Return the largest energy that contacts can have stored since the start, (n,), J.

    The kinetic energy of the start and the drive's work, less the potential energy.
    """
    mass = np.array([body.mass for body in mechanism_of(result.scene).bodies])
    height = result.scene.gravity * (result["body_position"][:, :, 1] @ mass)
    supplied = kinetic_energy(result.scene) + result["energy_input"]
    return np.asarray(supplied - (height - height[0]))


def _rounding(scene: Scene, name: str) -> float:
    """Return the force of a film due to roundoff of a speed, N; 0 without a film.

    A centred film resists being squeezed by up to 12 pi mu L (R/c)^3 N s/m (long bearing); a ball
    by less, with R for L.
    """
    joint = scene.joints[name]
    if not isinstance(joint, LubricatedJoint):
        return 0.0
    damping = 12.0 * math.pi * joint.film_scale / joint.clearance
    return SolverTuning().rounding * scene.pin_speed * damping


def _ratio(value: float, scale: float) -> float:
    return max(0.0, value) / scale if scale > 0.0 else 0.0


def _check(name: str, value: float, limit: float, note: str = "") -> Check:
    return Check(name, value if math.isfinite(value) else None, limit, note)
