"""Quantities of a press that starts and stops: for clutches and safety standards."""

from collections.abc import Iterator

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities.kind import DIFFERENCE, ENERGY, MOTION
from exu_press.quantities.quantity import Extreme, Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene
from exu_press.scene.start_stop import Clutch

__all__ = ["START_STOP", "commands_to_come", "still_turns"]

SAME = 1e-9
"""s: an instant that a step ends on."""

STILL = 1e-3
"""Part of the nominal speed: a crank that turns no faster until the next start stands."""


def _clutch(scene: Scene, _: str) -> bool:
    return scene.drive is not None and scene.drive.clutch is not None


def _stops(scene: Scene, _: str) -> bool:
    return scene.drive is not None and scene.drive.stops


def _starts(scene: Scene, _: str) -> bool:
    return scene.drive is not None and scene.drive.starts


def _brakes(scene: Scene, _: str) -> bool:
    clutch = None if scene.drive is None else scene.drive.clutch
    return clutch is not None and clutch.brake is not None


def _clutch_of(run: Reading) -> Clutch:
    motor = run.result.scene.drive
    assert motor is not None and motor.clutch is not None
    return motor.clutch


def _starts_of(run: Reading) -> tuple[float, ...]:
    clutch = _clutch_of(run)
    return () if clutch.start is None else clutch.start.start_time


def _stops_of(run: Reading) -> list[float]:
    """Return the instants of commands to stop, s, as far as the run got."""
    stop, time = _clutch_of(run).stop, run.time
    if stop is None:
        return []
    commands = list(stop.stop_time or ())
    if stop.stop_angle_deg is not None:
        reached = np.flatnonzero(run["crank_angle"] >= np.radians(stop.stop_angle_deg))
        if reached.size and reached[0]:
            pair = slice(reached[0] - 1, reached[0] + 1)
            angles = run["crank_angle"][pair]
            commands = [float(np.interp(np.radians(stop.stop_angle_deg), angles, time[pair]))]
    return [at for at in commands if time[0] <= at <= time[-1]]


def _standstills(run: Reading) -> Iterator[tuple[float, float | None]]:
    """Yield each command to stop, s, and when the crank has come to stand behind it, or None.

    That is when the crank first turns no further; from then on shafts untwist a little. It has to
    stand until the next start, or the end of the run.
    """
    time, speed = run.time, run["crank_speed"]
    slow = STILL * run.result.scene.angular_speed
    for stop in _stops_of(run):
        until = min((at for at in _starts_of(run) if at > stop), default=float(time[-1]))
        rows = np.flatnonzero((time >= stop - SAME) & (time <= until + SAME))
        if not rows.size or abs(speed[rows[-1]]) > slow:
            yield stop, None
        else:
            yield stop, _falls_to_zero(time[rows], speed[rows])


def _falls_to_zero(time: Array, values: Array) -> float | None:
    """Return when values, (n,), first are no longer positive, s, between two steps; or None."""
    down = np.flatnonzero(values <= 0.0)
    if not down.size:
        return None
    row = int(down[0])
    if row == 0:
        return float(time[0])
    fraction = float(values[row - 1] / (values[row - 1] - values[row]))
    return float(time[row - 1] + fraction * (time[row] - time[row - 1]))


def still_turns(run: Reading) -> bool:
    """Return whether the press does not stand at its end, although it was told to stop."""
    standstills = list(_standstills(run))
    return bool(standstills) and standstills[-1][1] is None


def commands_to_come(run: Reading) -> Iterator[str]:
    """Yield the commands that a run with a clutch ends before."""
    stop, end, angle = _clutch_of(run).stop, run.time[-1], np.degrees(run["crank_angle"][-1])
    times = {"start_time": _starts_of(run), "stop_time": (stop and stop.stop_time) or ()}
    for name, instants in times.items():
        yield from (f"drive.{name} = {at:g} s" for at in instants if at > end)
    if stop is not None and stop.stop_angle_deg is not None and angle < stop.stop_angle_deg:
        yield f"drive.stop_angle_deg = {stop.stop_angle_deg:g} deg"


def _over_stops(run: Reading, amount: Array) -> float | None:
    """Return the largest change of a growing amount, (n,), from a stop to its standstill.

    None where the press is not stopped, or does not stand behind each stop.
    """
    stops, standstills = zip(*_standstills(run), strict=True) if _stops_of(run) else ((), ())
    if not stops or None in standstills:
        return None
    begin, end = (np.interp(instants, run.time, amount) for instants in (stops, standstills))
    return float((end - begin).max())


def _travel(run: Reading) -> Array:
    """Return the distance that the output has travelled since the start, (n,), m."""
    from scipy.interpolate import CubicHermiteSpline  # type: ignore[import-untyped, unused-ignore]

    position = CubicHermiteSpline(run.time, run["slider_position"], run["slider_velocity"])
    turns = position.derivative().roots(extrapolate=False)
    instants = np.union1d(run.time, turns[np.isfinite(turns)])
    travel = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(position(instants))))])
    return np.asarray(travel[np.searchsorted(instants, run.time)])


def _stopping_time(run: Reading, _: str) -> float | None:
    return _over_stops(run, run.time)


def _stopping_angle(run: Reading, _: str) -> float | None:
    angle = _over_stops(run, run["crank_angle"])
    return None if angle is None else float(np.degrees(angle))


def _starting_time(run: Reading, _: str) -> float | None:
    """Return the longest time from a start until the clutch slips no more."""
    time, slip = run.time, run["flywheel_speed"] - run["crank_speed"]
    durations = []
    for start in _starts_of(run):
        until = min((at for at in _stops_of(run) if at > start), default=float(time[-1]))
        rows = np.flatnonzero((time >= start - SAME) & (time <= until + SAME))
        if not rows.size:
            continue
        level = _falls_to_zero(time[rows], slip[rows])
        if level is None:
            return None
        durations.append(level - start)
    return max(durations, default=None)


def _per_start(run: Reading, _: str) -> float:
    """Return the energy that the clutch has dissipated for each start."""
    begun = sum(at < float(run.time[-1]) for at in _starts_of(run))
    return float(run["clutch_loss"][-1]) / max(1, begun)


def _per_stop(run: Reading, _: str) -> float:
    return float(run["brake_loss"][-1]) / max(1, len(_stops_of(run)))


def _speed_drop(run: Reading, _: str) -> float:
    """Return the largest fall of the flywheel's speed, over the largest one before."""
    speed = run["flywheel_speed"]
    largest = np.maximum.accumulate(speed)
    return float(((largest - speed) / np.maximum(largest, 1e-300)).max())


START_STOP = (
    Quantity("drive.stopping_time", "s",
             "longest time from a command to stop until the crank stands: the overall response "
             "time of ISO 16092, from the command on",
             MOTION, _stopping_time,
             available=_stops, title="stopping time", display_unit="ms", extreme=Extreme.LARGEST),
    Quantity("drive.stopping_angle_deg", "deg",
             "largest angle that the crank turns from a command to stop until it stands",
             MOTION, _stopping_angle,
             available=_stops, title="stopping angle", is_detail=True, extreme=Extreme.LARGEST),
    Quantity("drive.stopping_travel", "m",
             "longest way of the output from a command to stop until it stands",
             MOTION, lambda run, _: _over_stops(run, _travel(run)),
             available=_stops, title="stopping travel", display_unit="mm", is_detail=True,
             extreme=Extreme.LARGEST),
    Quantity("drive.starting_time", "s",
             "longest time from a command to start until the clutch slips no more",
             MOTION, _starting_time,
             available=_starts, title="starting time", display_unit="ms", extreme=Extreme.LARGEST),
    Quantity("drive.speed_drop", "",
             "largest fall of the flywheel's speed, over the largest one before",
             DIFFERENCE, _speed_drop,
             available=_clutch, title="speed drop of the flywheel", extreme=Extreme.LARGEST),
    Quantity("drive.clutch_energy", "J", "energy that the clutch dissipates, for each start",
             ENERGY, _per_start,
             available=_clutch, title="heat in the clutch, each start", cumulative=True),
    Quantity("drive.brake_energy", "J", "energy that the brake dissipates, for each stop",
             ENERGY, _per_stop,
             available=_brakes, title="heat in the brake, each stop", is_detail=True,
             cumulative=True),
)  # fmt: skip
