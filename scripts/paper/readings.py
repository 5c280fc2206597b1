"""What is read off a run: the measures that the paper's numbers and trends are compared with."""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from exu_press.numerics.arrays import Array
from exu_press.quantities import Quantity, QuantityAt, differentiated_peak, mean_peak, peak
from exu_press.quantities.kind import LOAD, MOTION, SHARE
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.scene import IdealJoint, Scene, mechanism_of

__all__ = ["DATUM", "MODELS", "OBSERVED", "declared", "permanent_contact", "readings", "span_of"]

MODELS = ("resolved", "mean_1ms", "differentiated_1khz")
"""Of observing accelerations: the integrator's own steps, means over 1 ms, 1 kHz samples."""

OBSERVED = "mean_1ms"
"""The one that verdicts are made under. The paper's program printed one value a millisecond, from
steps of a millisecond: what an impact of 75 us does in such a step is its change of velocity,
spread over the step. The mean over a moving millisecond is that, wherever samples would fall."""

DATUM = 0.47
"""The paper's ideal bottom dead centre, m. Positions are judged by how far they lie below it:
beside an arbitrary datum of half a metre anything would agree."""

LONGEST_IMPACT = 1e-3
"""A touch that lasts longer is permanent contact, s: one value of the paper's curves holds it."""

WINDOW = 1e-3  # s
RATE = 1e3  # samples per second


def span_of(scene: Scene) -> tuple[float, float]:
    """Return from when to when a run is observed, s: its last revolution, or all of a short run."""
    turn = 60.0 / scene.speed_rpm
    return (max(0.0, scene.duration - turn) if scene.revolutions > 1.5 else 0.0), scene.duration


def readings(result: Result) -> dict[str, float]:
    """Return every measure of what a record has of the observed span; none of less than 3 ms.

    Returns:
        peak_acceleration.MODEL (m/s^2); peak_velocity (m/s) and below_ideal (m), means over 1 ms;
        oscillation_frequency (Hz); ball.share_permanent and pin.share_permanent, of joints with
        clearance; power and power.pin (W), the mean loss in all of them and in the pin alone.
    """
    start = span_of(result.scene)[0]
    inside = result.time >= start - 1e-12
    time = result.time[inside]
    if len(time) < 3 or time[-1] - time[0] < 3.0 * WINDOW:
        return {}
    position, velocity, acceleration = (
        result[f"slider_{level}"][inside] for level in ("position", "velocity", "acceleration")
    )
    motion = CubicHermiteSpline(time, position, velocity)
    area = motion.antiderivative()
    late = time[time >= time[0] + WINDOW]
    found = {
        "peak_acceleration.resolved": peak(acceleration),
        "peak_acceleration.mean_1ms": mean_peak(time, velocity),
        "peak_acceleration.differentiated_1khz": differentiated_peak(time, position, velocity),
        "peak_velocity": peak((motion(late) - motion(late - WINDOW)) / WINDOW),
        "below_ideal": DATUM - float(((area(late) - area(late - WINDOW)) / WINDOW).min()),
        "oscillation_frequency": _oscillation_frequency(result, time, motion),
        **_joints(result, inside),
    }
    return {name: float(value) for name, value in found.items() if value is not None}


def declared(result: Result) -> dict[str, QuantityAt]:
    """Return the measures of a run as quantities, of which errors are known."""
    return {name: QuantityAt(_quantity(name)) for name in readings(result)}


def _quantity(name: str) -> Quantity:
    kind = LOAD if "acceleration" in name or "power" in name else MOTION
    if "share" in name:
        kind = SHARE
    return Quantity(name, "", name, kind, lambda run, _: run.once(_readings).get(name))


def _readings(run: Reading) -> dict[str, float]:
    return readings(run.result)


def _oscillation_frequency(result: Result, time: Array, motion: CubicHermiteSpline) -> float | None:
    """Return the mean frequency of the velocity's deviation from the ideal, in 1 kHz samples, Hz.

    It is Rice's: the root of the mean square of the derivative over that of the deviation, over
    2 pi (S. O. Rice, Bell System Technical Journal 24 (1945) 46-156); none without a deviation.
    """
    at = np.arange(time[0], time[-1], 1.0 / RATE)
    angle = result.scene.start_angle + result.scene.angular_speed * at
    ideal = mechanism_of(result.scene).ideal_slider(angle, result.scene.angular_speed)[1]
    deviation = motion(at, 1) - ideal
    size = float(np.std(deviation))
    if size < 1e-9:
        return None
    return float(np.sqrt(np.mean(np.diff(deviation) ** 2)) * RATE / (2.0 * np.pi * size))


def _joints(result: Result, inside: NDArray[np.bool_]) -> dict[str, float]:
    """Return shares of permanent contact, and mean powers over the instants that are inside."""
    if not result.clearance_joints:
        return {}
    time = result.time[inside]
    found, lost = {}, {}
    for name in result.clearance_joints:
        joint = result.scene.joints[name]
        assert not isinstance(joint, IdealJoint)
        depth = (joint.onset or 0.0) - result.joints[name].gap[inside]
        short = {"ball_left": "ball", "crank_pin": "pin"}.get(name, name)
        found[f"{short}.share_permanent"] = permanent_contact(time, depth)
        energy = result[f"{name}_loss"][inside]
        lost[short] = float(energy[-1] - energy[0]) / float(time[-1] - time[0])
    return found | {"power": sum(lost.values()), "power.pin": lost["pin"]}


def permanent_contact(time: Array, depth: Array) -> float:
    """Return the share of time in touches longer than LONGEST_IMPACT.

    Args:
        time: (n,), s.
        depth: (n,), m, of what touches first; negative where the surfaces are apart.
    """
    touching = depth > 0.0
    held = np.concatenate([[False], touching[1:] & touching[:-1], [False]])
    edges = np.flatnonzero(np.diff(held.astype(int)))
    lasting = time[edges[1::2]] - time[edges[::2]]
    return float(lasting[lasting > LONGEST_IMPACT].sum() / (time[-1] - time[0]))
