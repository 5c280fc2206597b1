"""Quantities of the slider's motion."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from exu_press.mechanism import Output
from exu_press.quantities.acceleration import differentiated_peak, mean_peak, peak
from exu_press.quantities.dead_centre import (
    behind_cut_centre,
    ideal_angles,
    lowest,
)
from exu_press.quantities.kind import DIFFERENCE, LOAD, MOTION
from exu_press.quantities.quantity import Extreme, Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene, mechanism_of

__all__ = ["SLIDER", "STROKES", "of_output"]


def _is_displacement(scene: Scene, _: str) -> bool:
    return not mechanism_of(scene).output.rotation


def _rotates(scene: Scene, _: str) -> bool:
    return mechanism_of(scene).output.rotation


def _swings(scene: Scene, _: str) -> bool:
    """Return whether the output is a rotation to and fro."""
    mechanism = mechanism_of(scene)
    return mechanism.output.rotation and mechanism.output_reverses


def _has_soft_guide(scene: Scene, _: str) -> bool:
    """Return whether the slider's guide lets it tilt: the tilt in rigid guides is rounding."""
    mechanism = mechanism_of(scene)
    return any(
        guide.body == mechanism.slider and (guide.lateral or guide.tilting or guide.guideway)
        for guide in mechanism.guides
    )


def _of_strokes(
    read: Callable[["np.ndarray[tuple[int], np.dtype[np.float64]]"], float], least: int
) -> Callable[[Reading, str], float | None]:
    """Return a reader of the dead centres' positions, None of fewer strokes than the least."""

    def value(run: Reading, _: str) -> float | None:
        positions = np.array([centre.position for centre in run.dead_centres])
        return float(read(positions)) if len(positions) >= least else None

    return value


def _ends(run: Reading) -> tuple[float, float]:
    """Return the slider's lowest and highest position, m, of dead centres that are whole."""
    angle, mechanism, ends = run["crank_angle"], run.mechanism, []
    for sign, about in zip((1.0, -1.0), ideal_angles(mechanism), strict=True):
        first = behind_cut_centre(angle, about)
        position, velocity = (run[f"slider_{name}"][first:] for name in ("position", "velocity"))
        ends.append(sign * lowest(run.time[first:], sign * position, sign * velocity)[1])
    return ends[0], ends[1]


def _mean_acceleration(window: float, run: Reading, _: str) -> float | None:
    mean = mean_peak(run.time, run["slider_velocity"], window)
    return run.at_most_peak(mean, "slider_acceleration")


def _differentiated_acceleration(rate: float, run: Reading, _: str) -> float | None:
    position, velocity = run["slider_position"], run["slider_velocity"]
    mean = differentiated_peak(run.time, position, velocity, rate)
    return run.at_most_peak(mean, "slider_acceleration")


_SLIDER = (
    Quantity("stroke", "m", "distance between the slider's highest and lowest position",
             MOTION, lambda run, _: run.once(_ends)[1] - run.once(_ends)[0],
             title="stroke", display_unit="mm", digits=5, extreme=Extreme.LARGEST, headline=True),
    Quantity("bottom_dead_centre", "m", "lowest position of the slider",
             MOTION, lambda run, _: run.once(_ends)[0],
             title="bottom dead centre", display_unit="mm", digits=6, signed=True),
    Quantity("peak_velocity", "m/s", "largest speed of the slider",
             MOTION, lambda run, _: peak(run["slider_velocity"]),
             title="peak velocity", extreme=Extreme.LARGEST, headline=True,
             curve="slider_velocity"),
    Quantity("peak_acceleration.resolved", "m/s^2",
             "largest acceleration of the slider, as the integrator resolves it",
             LOAD, lambda run, _: run.peak("slider_acceleration"),
             title="peak acceleration", extreme=Extreme.LARGEST, headline=True,
             curve="slider_acceleration"),
    Quantity("peak_acceleration.mean_1ms", "m/s^2",
             "largest acceleration of the slider, averaged over 1 ms",
             LOAD, partial(_mean_acceleration, 1e-3), observe=_mean_acceleration,
             title="mean over 1 ms", is_detail=True, extreme=Extreme.LARGEST, headline=True),
    Quantity("peak_acceleration.differentiated_1khz", "m/s^2",
             "largest second difference of the slider's displacement, sampled at 1 kHz",
             LOAD, partial(_differentiated_acceleration, 1e3),
             observe=_differentiated_acceleration,
             title="differentiated, 1 kHz", is_detail=True, extreme=Extreme.LARGEST,
             upper_bound="peak_acceleration.mean_1ms"),  # the mean over 1 ms of such means
)  # fmt: skip

_STROKES = (
    Quantity("strokes.mean", "m", "mean of the strokes' bottom dead centres",
             MOTION, _of_strokes(np.mean, 1),
             signed=True),
    Quantity("strokes.range", "m",
             "distance between the highest and the lowest bottom dead centre of the strokes",
             DIFFERENCE, _of_strokes(np.ptp, 2),
             title="dead centres differ by", display_unit="um", extreme=Extreme.LARGEST),
    Quantity("strokes.standard_deviation", "m",
             "standard deviation of the strokes' bottom dead centres",
             DIFFERENCE, _of_strokes(lambda positions: positions.std(ddof=1), 2)),
)  # fmt: skip

_BESIDE = (
    Quantity("slider_tilt", "rad", "largest tilt of the slider in its guide",
             DIFFERENCE, lambda run, _: peak(run["slider_tilt"]),
             available=_has_soft_guide, title="slider tilt, max", display_unit="urad",
             extreme=Extreme.LARGEST, curve="slider_tilt"),
    Quantity("slider_lateral", "m", "largest displacement of the slider across its guide",
             DIFFERENCE, lambda run, _: peak(run["slider_lateral"]),
             available=_has_soft_guide, extreme=Extreme.LARGEST, curve="slider_lateral"),
)  # fmt: skip

AS_ROTATION = {
    "stroke": ("swing", "angle between the output's ends"),
    "bottom_dead_centre": ("least_angle", "least angle of the output"),
    "peak_velocity": ("peak_angular_velocity", "largest angular velocity of the output"),
    "peak_acceleration.resolved": (
        "peak_angular_acceleration.resolved",
        "largest angular acceleration of the output, as the integrator resolves it",
    ),
    "peak_acceleration.mean_1ms": (
        "peak_angular_acceleration.mean_1ms",
        "largest angular acceleration of the output, averaged over 1 ms",
    ),
    "peak_acceleration.differentiated_1khz": (
        "peak_angular_acceleration.differentiated_1khz",
        "largest second difference of the output's angle, sampled at 1 kHz",
    ),
    "strokes.mean": ("swings.mean", "mean of the swings' least angles"),
    "strokes.range": (
        "swings.range",
        "difference between the largest and the smallest of the swings' least angles",
    ),
    "strokes.standard_deviation": (
        "swings.standard_deviation",
        "standard deviation of the swings' least angles",
    ),
}
"""Quantity of a displacement -> name and meaning of that of a rotation."""


def of_output(quantity: Quantity, output: Output) -> str:
    """Return the name that a quantity of the output has: where that is a rotation, another one."""
    return AS_ROTATION[quantity.name][0] if output.rotation else quantity.name


def _as_rotation(quantity: Quantity) -> Quantity:
    """Return the quantity of a rotation that corresponds to one of a displacement."""
    name, meaning = AS_ROTATION[quantity.name]
    swings = "velocity" not in name and "acceleration" not in name
    display = quantity.display_unit.removesuffix(quantity.unit)
    unit = quantity.unit.replace("m", "rad", 1)
    title = quantity.title and name.partition(".")[0].replace("_", " ")
    return replace(
        quantity,
        name=name,
        meaning=meaning,
        unit=unit,
        display_unit=f"{display}{unit}",
        title=quantity.title if quantity.is_detail else title,
        upper_bound=AS_ROTATION.get(quantity.upper_bound, ("",))[0],
        available=_swings if swings else _rotates,
    )


SLIDER, STROKES = (
    tuple(replace(quantity, available=_is_displacement) for quantity in quantities)
    + tuple(map(_as_rotation, quantities))
    for quantities in (_SLIDER, _STROKES)
)
STROKES += _BESIDE
