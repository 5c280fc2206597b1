"""What makes a run right: checks on one run, and its agreement with a more accurate one."""

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.integrate import Tuning
from exu_press.laws.film.contract import film_scale
from exu_press.mechanism import GROUND
from exu_press.observe.energy import energy_residual, energy_scale
from exu_press.result import Result
from exu_press.scene import LubricatedJoint, Scene, mechanism_of
from exu_press.scene.laws import contact_law

__all__ = ["RESIDUAL_LIMIT", "Check", "agreement", "checks_of"]

Array = NDArray[np.float64]

RESIDUAL_LIMIT = 1e-3
"""Of the energy balance, as in the summary."""

FLEXIBLE_RESIDUAL_LIMIT = 2e-3
"""The same with flexible bodies: the balance counts what deformation adds to their kinetic energy
approximately. 1.0e-3 and 1.7e-3 were measured over 0.12 and 1 revolution of the dry press, and do
not fall with the tolerance."""

COARSE_RESIDUAL = 0.1
"""Times the tolerance: what may be left of the energy where more than a hundredth was asked for."""

DRIFT_LIMIT = 1e-9  # m

ENERGY_LIMIT = 1e-3
"""Of what joints may seem to create or to store beyond what was there, relative to the same: what
the energy balance itself leaves open."""

STEP_ERROR = 0.03
"""What a fixed step that resolves its impacts leaves of error, as measured at 2e-5 s."""


@dataclass(frozen=True)
class Check:
    """One figure that must not be above its limit.

    Attributes:
        name: what is checked.
        value: None where it is not finite.
        limit: in the same unit.
        note: what is worst, where there are several.
    """

    name: str
    value: float | None
    limit: float
    note: str = ""

    @property
    def passed(self) -> bool:
        """Whether the figure is finite and not above its limit."""
        return self.value is not None and self.value <= self.limit

    def to_dict(self) -> dict[str, Any]:
        """Return the check as it stands in stability.json."""
        return {**asdict(self), "passed": self.passed}


def checks_of(result: Result) -> list[Check]:
    """Return the checks of one run that reached its end."""
    unsound = sum(int(np.count_nonzero(~np.isfinite(result[name]))) for name in result)
    if unsound:
        return [_check("numbers that are not finite", unsound, 0.0)]
    scale, lost = energy_scale(result), result["energy_dissipated"]
    solver = result.scene.solver
    assert solver is not None
    coarse = COARSE_RESIDUAL * (solver.tolerance or 0.0)
    fallen = float((np.maximum.accumulate(lost) - lost).max())
    drift, where = max(_drifts(result), default=(0.0, ""))
    flexible = result.scene.flexible is not None
    limit = FLEXIBLE_RESIDUAL_LIMIT if flexible else RESIDUAL_LIMIT
    checks = [
        _check("numbers that are not finite", 0.0, 0.0),
        _check("energy residual", energy_residual(result) or 0.0, max(limit, coarse)),
        _check("constraint drift, m", drift, DRIFT_LIMIT, where),
        _check("energy created in joints", _ratio(fallen, scale), ENERGY_LIMIT),
    ]
    elastic = _elastic_energy(result)
    if elastic is not None:
        surplus = float((elastic - _energy_there(result)).max())
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
    """Return how far a run is from a more accurate one: 1 is as far as it may be.

    Compared is what stays when the instants of impacts shift a little, each with a tolerance of its
    own: extremes of the motion, peaks over the first impacts, root mean squares, means, energy;
    forces of a film no closer than rounded speeds allow. A run may be off by four times the
    tolerance it was given on top, which is how far journals drift in films of 0.1 um, or by the
    error of a fixed step.
    """
    solver = result.scene.solver
    assert solver is not None
    asked = STEP_ERROR if solver.tolerance is None else 4.0 * solver.tolerance
    worst, which = 0.0, ""
    there = {name: value for name, value, _ in _quantities(finer, asked)}
    for name, value, tolerance in _quantities(result, asked):
        difference = abs(value - there.get(name, math.nan)) / tolerance(there[name])
        if not difference <= worst:
            worst, which = difference, f"{name}: {value:.5g} for {there[name]:.5g}"
    return _check("difference from a finer run, of what is allowed", worst, 1.0, which)


def _quantities(result: Result, asked: float) -> Iterator[tuple[str, float, Any]]:
    """Yield name, value and allowed difference (a function of the finer value)."""
    summary = result.summary()
    clearance = _largest_clearance(result.scene)
    length = (0.1 + asked) * clearance + 1e-4 * summary["stroke"]

    def relative(share: float, least: float = 1e-12) -> Any:
        return lambda finer: (share + asked) * abs(finer) + least

    yield "stroke", summary["stroke"], lambda _: length
    yield "bottom dead centre", summary["bottom_dead_centre"], lambda _: length
    yield "peak velocity", summary["peak_velocity"], relative(0.01)
    for name, share in (("mean_1ms", 0.05), ("resolved", 0.1)):
        value = summary["peak_acceleration"][name]
        if value is not None:
            yield f"peak acceleration, {name}", value, relative(share)
    for name in result.clearance_joints:
        distance = np.linalg.norm(result[f"{name}_eccentricity"], axis=1)
        force = np.linalg.norm(result[f"{name}_force"], axis=1)
        least = max(1e-12, _rounding(result.scene, name))
        yield f"{name} peak force", float(force.max()), relative(0.1, least)
        yield f"{name} rms force", math.sqrt(_mean(result.time, force**2)), relative(0.05, least)
        yield (
            f"{name} mean eccentricity",
            _mean(result.time, distance),
            lambda _: (0.02 + asked) * clearance,
        )
    work = max(float(np.abs(result[f"energy_{kind}"]).max()) for kind in ("input", "stored"))
    yield "energy dissipated", summary["energy"]["dissipated"], relative(0.05, 1e-3 * work)


def _drifts(result: Result) -> Iterator[tuple[float, str]]:
    """Yield the largest opening of every ideal joint and guide between rigid bodies, m."""
    mechanism = mechanism_of(result.scene)
    flexible = {"crank", "linkage"} if result.scene.flexible is not None else set()
    position = {name: result["body_position"][:, index] for index, name in enumerate(result.bodies)}

    def world(body: str, point: tuple[float, float]) -> Array:
        if body == GROUND:
            return np.array([point])
        x, y, angle = position[body].T
        return np.column_stack(
            [
                x + np.cos(angle) * point[0] - np.sin(angle) * point[1],
                y + np.sin(angle) * point[0] + np.cos(angle) * point[1],
            ]
        )

    for joint in mechanism.joints:
        if joint.name in result.scene.joints.ideal and not flexible & {
            joint.journal,
            joint.bearing,
        }:
            journal, bearing = mechanism.ends(joint)
            gap = world(*journal) - world(*bearing)
            yield float(np.linalg.norm(gap, axis=1).max()), joint.name


def _elastic_energy(result: Result) -> Array | None:
    """Return what the contacts of all joints store, (n,), J; None where nothing may touch."""
    total, found = np.zeros_like(result.time), False
    for name, joint in result.scene.joints.with_clearance.items():
        if joint.contact is None or joint.onset is None:
            continue
        found, record = True, result.joints[name]
        law = contact_law(joint.contact, joint.clearance, revolute=not record.spherical)
        depth = joint.onset - record.gap
        total += [law.elastic_energy(d) for d in depth.tolist()]
    return total if found else None


def _energy_there(result: Result) -> Array:
    """Return what contacts can have stored at most, (n,), J.

    The kinetic energy of the start and the drive's work, less what has gone into height.
    """
    scene = result.scene
    mechanism = mechanism_of(scene)
    motion = mechanism.motion(np.array([scene.start_angle]), scene.angular_speed)
    kinetic = sum(
        0.5 * body.mass * float((motion[body.name].velocity[0, :2] ** 2).sum())
        + 0.5 * body.inertia * float(motion[body.name].velocity[0, 2]) ** 2
        for body in mechanism.bodies
    )
    mass = np.array([body.mass for body in mechanism.bodies])
    height = scene.gravity * (result["body_position"][:, :, 1] @ mass)
    return np.asarray(kinetic + result["energy_input"] - (height - height[0]))


def _largest_clearance(scene: Scene) -> float:
    return max((joint.clearance for joint in scene.joints.values()), default=0.0)


def _rounding(scene: Scene, name: str) -> float:
    """Return what the last digits of a speed make of a film's force, N; 0 without a film.

    A centred film resists being squeezed by up to 12 pi mu L (R/c)^3 N s/m (long bearing).
    """
    joint = scene.joints[name]
    if not isinstance(joint, LubricatedJoint):
        return 0.0
    film, c = joint.film, joint.clearance
    damping = 12.0 * math.pi * film_scale(film.viscosity, film.length, joint.radius, c) / c
    return Tuning().digits * scene.pin_speed * damping


def _mean(time: Array, values: Array) -> float:
    """Return the mean over time."""
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def _ratio(value: float, scale: float) -> float:
    return max(0.0, value) / scale if scale > 0.0 else 0.0


def _check(name: str, value: float, limit: float, note: str = "") -> Check:
    return Check(name, value if math.isfinite(value) else None, limit, note)
