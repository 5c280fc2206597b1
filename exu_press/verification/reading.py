"""Readings of a run that show errors which all runs share, so that their differences do not.

These are of loads that are read at steps, and of oil that still warms.
"""

from collections.abc import Callable

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities.alternating import LOADS, second_difference
from exu_press.quantities.energy import has_balance
from exu_press.result import Result
from exu_press.result.windows import settled_part, up_to
from exu_press.scene.joint import oil_of

__all__ = [
    "OF_FIRST_STEP",
    "add_energy_residual",
    "add_start_overshoot",
    "add_work_between_steps",
    "average_neighbours",
    "enlarge_reversing_forces",
    "read_a_revolution_earlier",
    "with_next_temperatures",
]

SPEEDS = frozenset({"m/s", "rad/s"})
"""Units of channels whose peaks lie between steps, too; positions are read as cubics there."""

OF_FIRST_STEP = 0.25
"""Overshoot of a load over its change in the first step: 0.07 to 0.18 were measured with films."""

TRANSVERSE = 0.07
"""Transverse force over the change of a force that reverses within a step: 0.02 to 0.07 were
measured of a mixed film behind a blanking pulse, in steps of 0.1 us."""

AT_ONCE = 1e-6
"""Part of the first step after which the repeated start lies."""


def average_neighbours(run: Result) -> Result:
    """Return a run with loads and speeds averaged with the line through their neighbours.

    The constraints of generalized-alpha leave loads that alternate from step to step, most so at
    the start and in the small steps of impacts; averaging removes that oscillation. A peak between
    steps loses twice the height by which it may exceed the steps. So the change of a quantity
    bounds its reading error. Forces of applied loads do not alternate, and are no larger than their
    curve: one that meets its peak is exact.
    """
    averaged, largest = _transform_units(run, LOADS | SPEEDS, _neighbour_average), _largest(run)
    return averaged.map_values(
        lambda name, values: (
            _limited_average(run.time, values, largest[name]) if name in largest else values
        )
    )


def add_start_overshoot(run: Result) -> Result:
    """Return a run with a second instant just after the start, at which films overshoot.

    Films take up their loads within the first step, with an overshoot of OF_FIRST_STEP of the
    change that the end of the step does not show.
    """
    if len(run.time) < 2:
        return run
    delay = AT_ONCE * (run.time[1] - run.time[0])

    def repeat_start(name: str, values: Array) -> Array:
        extended = np.concatenate([values[:1], values])
        if name == "time":
            extended[1] += delay
        return extended

    return _transform_units(run.map_values(repeat_start), LOADS, _overshoot_of_first_step)


def enlarge_reversing_forces(run: Result) -> Result:
    """Return a run with larger forces where they reverse within a step.

    A film whose load reverses passes it to its other side within microseconds, which no step
    resolves. The force need not go through zero: TRANSVERSE of its change may act across.
    """
    return _transform_units(run, LOADS, _enlarge_reversals)


def add_energy_residual(run: Result) -> Result:
    """Return a run with its largest energy residual added to its input and to the drive's power.

    The input is the integral of a power that is read at steps. Where it flows back and forth, as
    over whole revolutions, errors may cancel at the end by chance.
    """
    if not has_balance(run):
        return run
    run = settled_part(run)
    supplied = run["energy_input"]
    residual = np.abs(supplied - run["energy_stored"] - run["energy_dissipated"]).max()
    corrected = {"energy_input": np.concatenate([supplied[:1], supplied[1:] + residual])}
    if len(run.time) > 1:
        corrected["drive_power"] = run["drive_power"] + residual / (run.time[-1] - run.time[0])
    return run.with_values(corrected)


def add_work_between_steps(run: Result) -> Result:
    """Return a run whose loads do the work, too, that their steps leave out.

    A step's work is its mean force times its mean velocity. Of a force along a line this leaves out
    a twelfth of F' v' + F v'' times the cube of the step; the edge of a pulse may be few steps of
    the same length in all runs.
    """
    run = settled_part(run)
    step = np.diff(run.time)
    corrected = {}
    for name in run.units:
        if name.startswith("load_") and name.endswith("_work") and len(step) > 2:
            force, work = run[f"{name.removesuffix('_work')}_force"], run[name]
            mean = 0.5 * (force[1:] + force[:-1])
            acts = np.abs(mean) > 1e-6 * np.abs(force).max(initial=0.0)
            if acts.any():
                middle = run.time[:-1] + 0.5 * step
                velocity = np.diff(work)[acts] / (step * mean)[acts]
                velocity = np.interp(middle, middle[acts], velocity)
                slope = np.gradient(velocity, middle)
                bend = mean * np.gradient(slope, middle)
                second = np.abs(np.diff(force) / step * slope) + np.abs(bend)
                left_out = np.cumsum(second * step**3) / 12.0
                corrected[name] = work + np.insert(left_out, 0, 0.0)
    return run.with_values(corrected)


def read_a_revolution_earlier(run: Result) -> Result:
    """Return a run that ends a revolution earlier, where oil warms.

    Changes that halve with each revolution add up to no more than the last one. A run without
    settling is returned as it is.
    """
    scene, angle = run.scene, run["crank_angle"]
    if (
        not scene.warms
        or scene.settle_revolutions < 1.0
        or scene.revolutions - scene.settle_revolutions < 1.0
    ):
        return run
    last = float(np.interp(angle[-1] - 2.0 * np.pi, angle, run.time))
    shortened = up_to(run, last)
    object.__setattr__(shortened, "scene", scene.read_later(-1.0))  # a copy that nobody else has
    return shortened


def with_next_temperatures(run: Result) -> Result:
    """Return a run whose films have the temperatures of the next revolution.

    They are extrapolated from the last two revolutions (`exu_press.model.warm_film`).
    """
    films = run.info.get("state", {}).get("films", {})
    values = {}
    for name, (temperature, pressure) in films.items():
        oil, channel = oil_of(run.scene.joints[name]), f"{name}_temperature"
        assert oil is not None
        recorded = run[channel]
        change = temperature - float(recorded[-1])
        viscosity_ratio = oil.viscosity(temperature, pressure) / float(run[f"{name}_viscosity"][-1])
        values[channel] = recorded + change
        values[f"{name}_viscosity"] = run[f"{name}_viscosity"] * viscosity_ratio
    return run.with_values(values) if values else run


def _transform_units(
    run: Result, units: frozenset[str], change: Callable[[Array, Array], Array]
) -> Result:
    """Return a run whose channels of these units are change(time (n,), values (n, ...)).

    Forces of applied loads are left as they are: curves prescribe them.
    """
    time, unit_of, applied = run.time, run.units, _largest(run)
    return run.map_values(
        lambda name, values: (
            change(time, values) if unit_of[name] in units and name not in applied else values
        )
    )


def _largest(run: Result) -> dict[str, float]:
    """Return what applied loads never exceed, N, by the channels of their forces."""
    return {f"load_{name}_force": load.largest for name, load in run.scene.applied_loads.items()}


def _limited_average(time: Array, force: Array, largest: float) -> Array:
    """Return a force (n,) averaged with its neighbours, by twice what it misses of `largest`."""
    change = _neighbour_average(time, force) - force
    missed = np.maximum(largest - np.abs(force), 0.0)
    return force + np.copysign(np.fmin(np.abs(change), 2.0 * missed), change)


def _neighbour_average(time: Array, values: Array) -> Array:
    """Return values (n, ...) without their alternating part, but for the first.

    The last one has one neighbour only, and the alternating part with the other sign.
    """
    if len(time) < 3:
        return values
    alternating = 0.5 * second_difference(time, values)
    last = values[-1:] + alternating[-1:]
    return np.concatenate([values[:1], values[1:-1] - alternating, last])


def _enlarge_reversals(_: Array, values: Array) -> Array:
    """Return vectors (n, k), each component larger where they reverse within a step."""
    if values.ndim != 2 or values.shape[1] < 2:
        return values
    jump = np.linalg.norm(np.diff(values, axis=0), axis=1)
    reverses = np.sum(values[1:] * values[:-1], axis=1) < 0.0
    enlargement = np.where(reverses, TRANSVERSE * jump, 0.0)
    increase = np.maximum(np.append(enlargement, 0.0), np.insert(enlargement, 0, 0.0))[:, None]
    return np.asarray(values + np.copysign(increase, values))


def _overshoot_of_first_step(_: Array, values: Array) -> Array:
    """Return values (n, ...) whose second one overshoots the third one."""
    second = values[2] + OF_FIRST_STEP * (values[2] - values[0])
    return np.concatenate([values[:1], second[None], values[2:]])
