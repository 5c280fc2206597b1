"""Quantities of drive, frame and guides, for press builders."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from exu_press.mechanism import Guide
from exu_press.mechanism.guide_motion import pose_in_guide
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import integral
from exu_press.quantities.acceleration import mean_peak_of, peak
from exu_press.quantities.kind import DIFFERENCE, ENERGY, FLOW, LOAD, MOMENT, MOTION, RESULTANT
from exu_press.quantities.law_errors import guide_film_error
from exu_press.quantities.quantity import Extreme, Owner, Quantity, always
from exu_press.quantities.reading import Reading
from exu_press.result.channel import guide_channel
from exu_press.result.channels import read_columns
from exu_press.scene import Scene, mechanism_of

__all__ = ["DRIVE", "GUIDES", "LOADS", "SHAKING"]

RUBBING = 0.1
"""Coefficient of friction of guides that have none, for the power that they would dissipate."""


def _motor(scene: Scene, _: str) -> bool:
    return scene.drive is not None


def _counterweight(scene: Scene, _: str) -> bool:
    return bool(mechanism_of(scene).counterweight)


def _frictionless(scene: Scene, _: str = "") -> bool:
    """Return whether there are guides, all of them without friction."""
    rubbing = any(guide.rubs for guide in scene.guides.values())
    return bool(mechanism_of(scene).guides) and not rubbing


def _of_guide(run: Reading, body: str, quantity: str) -> Array | None:
    return run.channel(f"{guide_channel(run.mechanism, body)}_{quantity}")


def _guide_peak(quantity: str) -> Callable[[Reading, str], float | None]:
    """Return a reader of the largest magnitude of a guide's channel."""
    return lambda run, body: run.peak(f"{guide_channel(run.mechanism, body)}_{quantity}")


def _sliding_powers(run: Reading) -> dict[str, float | None]:
    """Return the mean of side force times sliding speed, by the guides' bodies."""
    return {guide.name: _sliding_power(run, guide) for guide in run.mechanism.guides}


def _sliding_power(run: Reading, guide: Guide) -> float | None:
    force = _of_guide(run, guide.name, "force")
    if force is None or len(run.time) < 2:
        return None
    bodies, direction = run.result.bodies, np.array(guide.direction)

    def position_of(poses: Array) -> Array:
        return np.asarray(pose_in_guide(run.mechanism, guide, bodies, poses)[:, :2] @ direction)

    position = read_columns(run.result.channels, "body_position", position_of)
    power = np.gradient(position, run.time)
    power *= force
    return run.mean(np.abs(power, out=power))


def _if_guides_rubbed(run: Reading, _: str) -> float | None:
    powers = run.once(_sliding_powers).values()
    return None if None in powers else RUBBING * sum(p for p in powers if p is not None)


def _can_dissipate(scene: Scene, guide: str) -> bool:
    """Return whether a guide can dissipate: an ideal one without friction cannot."""
    return guide in scene.guides


def _guide_loss(run: Reading, body: str) -> Array:
    lost = _of_guide(run, body, "loss")
    return np.zeros_like(run.time) if lost is None else lost


def _is_oiled(scene: Scene, guide: str) -> bool:
    return guide in scene.guides and scene.guides[guide].oil is not None


def _thinnest(run: Reading, body: str) -> float | None:
    gap = _of_guide(run, body, "gap")
    return None if gap is None else float(max(0.0, gap.min()))


def _fluctuation(run: Reading, _: str) -> float | None:
    """Return the largest less the smallest crank speed, over the mean one."""
    mean = _mean_speed(run, _)
    if run.speed_from is None or not mean:
        return None
    speed = run["crank_speed"][run.time >= run.speed_from * (1.0 - 1e-12)]
    return float(np.ptp(speed)) / abs(mean * np.pi / 30.0)


def _mean_speed(run: Reading, _: str) -> float | None:
    """Return the angle that the crank turns over the time that it takes, rpm."""
    if run.speed_from is None:
        return None
    turned = integral(run.time, run["crank_speed"])
    change = turned[-1] - np.interp(run.speed_from, run.time, turned)
    return float(change / (run.time[-1] - run.speed_from)) * 30.0 / np.pi


def _mean_of(channel: str, column: int | None, window: float, run: Reading, _: str) -> float | None:
    """Return the largest mean of a channel, or of one of its columns, over a window, s."""
    values = run[channel]
    mean = mean_peak_of(run.time, values if column is None else values[:, column], window)
    return run.at_most_peak(mean, channel, column or 0)


DRIVE = (
    Quantity("drive.peak_torque", "N m",
             "largest torque of the drive; a motor's turns flywheel and crank",
             LOAD, lambda run, _: run.peak("drive_torque"),
             title="drive torque, max", display_unit="kN m", extreme=Extreme.LARGEST,
             curve="drive_torque"),
    Quantity("drive.peak_torque_mean_1ms", "N m", "largest torque of the drive, averaged over 1 ms",
             LOAD, partial(_mean_of, "drive_torque", None, 1e-3),
             observe=partial(_mean_of, "drive_torque", None), extreme=Extreme.LARGEST),
    Quantity("drive.peak_crank_torque", "N m",
             "largest torque that turns the crank, behind a motor's flywheel",
             LOAD, lambda run, _: run.peak("crank_torque"),
             available=_motor, title="crank torque, max", display_unit="kN m",
             extreme=Extreme.LARGEST, curve="crank_torque"),
    Quantity("drive.peak_crank_torque_mean_1ms", "N m",
             "largest torque that turns the crank, behind a motor's flywheel, averaged over 1 ms",
             LOAD, partial(_mean_of, "crank_torque", None, 1e-3),
             available=_motor, observe=partial(_mean_of, "crank_torque", None),
             extreme=Extreme.LARGEST),
    Quantity("drive.mean_torque", "N m", "mean torque of the drive, over whole revolutions",
             LOAD, lambda run, _: run.mean(run["drive_torque"]),
             signed=True),
    Quantity("drive.peak_power", "W", "largest power of the drive",
             LOAD, lambda run, _: run.peak("drive_power"),
             extreme=Extreme.LARGEST, curve="drive_power"),
    Quantity("drive.mean_power", "W", "mean power of the drive, over whole revolutions",
             LOAD, lambda run, _: run.mean(run["drive_power"]),
             title="drive power, mean", signed=True),
    Quantity("drive.guide_friction_power", "W",
             f"mean power that guides without friction would dissipate with a coefficient of "
             f"{RUBBING}",
             LOAD, _if_guides_rubbed,
             available=_frictionless, title=f"guide friction at mu {RUBBING}", is_detail=True),
    Quantity("drive.mean_speed_rpm", "rpm",
             "mean crank speed, over whole revolutions or a nominal one",
             MOTION, _mean_speed,
             available=_motor, title="crank speed, mean"),
    Quantity("drive.fluctuation", "",
             "largest less smallest crank speed over the mean one, over whole revolutions or a "
             "nominal one",
             DIFFERENCE, _fluctuation,
             available=_motor, title="coefficient of fluctuation", is_detail=True),
)  # fmt: skip


def _resultant(channel: str, column: int, run: Reading, _: str) -> float | None:
    return float(run.peaks(channel).columns[column])


def _resultants() -> Iterator[Quantity]:
    """Yield the peaks of sums over the mechanism, across and up, with their means over 1 ms."""
    titles = {
        "shaking.vertical": ("vertical shaking force, max", False),
        "shaking.vertical_mean_1ms": ("mean over 1 ms", True),
        "shaking.without_counterweight.vertical_mean_1ms": ("mean, without counterweight", True),
    }
    sums = (
        ("shaking", "shaking_force", "shaking force", always),
        ("shaking.without_counterweight", "shaking_force_without_counterweight",
         "shaking force without the counterweight", _counterweight),
        ("shaking.frame", "frame_force", "force on the frame", always),
    )  # fmt: skip
    for prefix, channel, meaning, available in sums:
        for column, direction in enumerate(("horizontal", "vertical")):
            for ending, also in (("", ""), ("_mean_1ms", ", averaged over 1 ms")):
                name = f"{prefix}.{direction}{ending}"
                title, under = titles.get(name, ("", False))
                observe = partial(_mean_of, channel, column) if ending else None
                resolved = partial(_resultant, channel, column)
                yield Quantity(
                    name, "N", f"largest {direction} {meaning}{also}, in either direction",
                    RESULTANT, partial(observe, 1e-3) if observe else resolved,
                    available=available, title=title, display_unit="kN", is_detail=under,
                    extreme=Extreme.LARGEST, curve="" if ending else f"{channel}:{'xy'[column]}",
                    observe=observe,
                )  # fmt: skip


SHAKING = tuple(_resultants())

LOADS = (
    Quantity("peak_force", "N", "largest force of the load",
             MOTION, lambda run, load: peak(run[f"load_{load}_force"]), Owner.LOAD,
             title="load, max", display_unit="kN", extreme=Extreme.LARGEST, curve="force"),
    Quantity("work", "J", "work that the load puts in",
             FLOW, lambda run, load: float(run[f"load_{load}_work"][-1]), Owner.LOAD,
             title="work that it put in", signed=True, cumulative=True),
    Quantity("work_per_stroke", "J",
             "work that the load puts in per revolution, over whole revolutions",
             FLOW, lambda run, load: run.per_stroke(run[f"load_{load}_work"]), Owner.LOAD,
             title="per stroke", is_detail=True, signed=True),
)  # fmt: skip

GUIDES = (
    Quantity("peak_force", "N", "largest force across the guide",
             RESULTANT, _guide_peak("force"), Owner.GUIDE,
             extreme=Extreme.LARGEST, curve="force"),
    Quantity("sliding_power", "W",
             "mean of side force times sliding speed, over whole revolutions: times a "
             "coefficient of power that the guide dissipates by friction",
             RESULTANT, lambda run, body: run.once(_sliding_powers)[body], Owner.GUIDE),
    Quantity("peak_friction", "N", "largest friction along the guide",
             RESULTANT, _guide_peak("friction"), Owner.GUIDE,
             extreme=Extreme.LARGEST, curve="friction"),
    Quantity("min_film", "m",
             "least film thickness of the guide, 0 where surfaces lie in each other",
             MOTION, _thinnest, Owner.GUIDE, _is_oiled,
             title="film thickness, min", display_unit="um", extreme=Extreme.LEAST,
             law_error=guide_film_error, curve="gap"),
    Quantity("peak_moment", "N m", "largest moment of the guide on its body",
             MOMENT, _guide_peak("moment"), Owner.GUIDE,
             extreme=Extreme.LARGEST, curve="moment"),
    Quantity("dissipated", "J", "energy that the guide has dissipated",
             ENERGY, lambda run, body: float(_guide_loss(run, body)[-1]), Owner.GUIDE,
             _can_dissipate, title="energy dissipated", cumulative=True),
    Quantity("dissipated_per_stroke", "J",
             "energy that the guide dissipates per revolution, over whole revolutions",
             ENERGY, lambda run, body: run.per_stroke(_guide_loss(run, body)), Owner.GUIDE,
             _can_dissipate, title="per stroke", is_detail=True, signed=True),
    Quantity("mean_power", "W", "mean power that the guide dissipates, over whole revolutions",
             RESULTANT, lambda run, body: run.rate(_guide_loss(run, body)), Owner.GUIDE,
             _can_dissipate, signed=True),
)  # fmt: skip
