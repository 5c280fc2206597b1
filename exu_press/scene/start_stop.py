"""The keys of [drive] for a press that starts and stops: clutch, brake, and when they act."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

from exu_press.errors import InputError, MissingKeysError
from exu_press.laws.schedule import Ramp, Schedule
from exu_press.schema.checks import check_increasing, key
from exu_press.schema.registry import alternatives
from exu_press.schema.table import Table, declared_keys, key_values, need_text

__all__ = ["BEGINS", "Brake", "Clutch", "Starts", "Stops"]

BEGINS = ("turning", "standing", "rest")

OF_START, OF_STOP = ("clutch_on", "brake_off"), ("clutch_off", "brake_on")
"""Ramps behind a command: the first has to be over before the other begins."""

COMMANDS = ("start_time", "stop_time")

NO_STOP = "neither drive.stop_time nor drive.stop_angle_deg is given"


@dataclass(frozen=True)
class Starts(Table):
    """Commands to start."""

    table: ClassVar[str] = "drive"
    start_time: tuple[float, ...] = key(None, "commands to start", "s", numbers=0)
    clutch_on: tuple[float, float] | None = key(
        None,
        "behind a start, between which the clutch's torque rises to its full one",
        "s",
        numbers=2,
    )


@dataclass(frozen=True)
class Stops(Table):
    """Commands to stop."""

    table: ClassVar[str] = "drive"
    exclusive: ClassVar[tuple[tuple[str, str], ...]] = (("stop_time", "stop_angle_deg"),)
    stop_time: tuple[float, ...] | None = key(None, "commands to stop", "s", numbers=0)
    stop_angle_deg: float | None = key(
        None,
        "crank angle at which the stop is commanded instead; it goes on over revolutions",
        "deg",
    )
    clutch_off: tuple[float, float] | None = key(
        None, "behind a stop, between which the clutch's torque falls to nothing", "s", numbers=2
    )
    clutch_off_deg: tuple[float, float] | None = key(
        None, "the same as angles that the crank turns behind the stop", "deg", numbers=2
    )
    ends_after: float | None = key(
        None,
        "for which the run goes on when the press stands after its last stop; to the end of "
        "`revolutions` unless given",
        "s",
        above=0,
    )


@dataclass(frozen=True)
class Brake(Table):
    """A brake on the crank's shaft."""

    table: ClassVar[str] = "drive"
    brake_torque: float = key(None, "of the brake at most, on the crank's shaft", "N m", above=0)
    brake_off: tuple[float, float] | None = key(
        None, "behind a start, between which the brake's torque falls to nothing", "s", numbers=2
    )
    brake_on: tuple[float, float] | None = key(
        None,
        "behind a stop, between which the brake's torque rises to its full one",
        "s",
        numbers=2,
    )
    brake_on_deg: tuple[float, float] | None = key(
        None, "the same as angles that the crank turns behind the stop", "deg", numbers=2
    )


@dataclass(frozen=True)
class Clutch(Table):
    """A friction clutch behind the flywheel, and perhaps a brake, which a schedule engages.

    A clutch or brake slips at its torque, and below it sticks. A start lets the brake go, then
    engages the clutch; a stop does the reverse. Ramps are lines between two places behind the
    command.
    """

    table: ClassVar[str] = "drive"
    clutch_torque: float = key(
        None, "that the clutch transmits at most, reduced to the crank", "N m", above=0
    )
    driven_inertia: float = key(
        0.0, "of the clutch's driven half and the brake, on the crank", "kg m^2", at_least=0
    )
    windup_deg: float = key(
        0.01,
        "twist of shafts and linings of clutch or brake under its full torque",
        "deg",
        above=0,
        at_most=5,
        source="estimated",
    )
    start: Starts | None = alternatives({"start_time": "scene.start_stop:Starts"})
    stop: Stops | None = alternatives(
        {"stop_time": "scene.start_stop:Stops", "stop_angle_deg": "scene.start_stop:Stops"}
    )
    brake: Brake | None = alternatives({"brake_torque": "scene.start_stop:Brake"})

    def __post_init__(self) -> None:
        super().__post_init__()
        keys = self._keys
        for name in (*OF_START, *OF_STOP, "clutch_off_deg", "brake_on_deg", *COMMANDS):
            _check_times(name, keys.get(name, ()))
        if self.brake is not None:
            for names, reason in (
                (("brake_off",), "" if self.start else "drive.start_time is not given"),
                (("brake_on", "brake_on_deg"), "" if self.stop else NO_STOP),
            ):
                if reason:
                    self.brake.refuse_unused(names, reason)
        for name in OF_STOP:
            if name in keys and f"{name}_deg" in keys:
                raise InputError(f"drive.{name} and drive.{name}_deg: allowed is one of the two")
        self._demand_ramps()
        self._refuse_overlaps()

    def check_start(self, begins: str) -> None:
        """Raise InputError unless commands and brake suit the state in which a run begins."""
        standing, keys = begins != "turning", self._keys
        if standing and self.start is None:
            raise InputError(
                f"drive.begins = {begins!r} needs drive.start_time (commands to start, s), "
                "as in start_time = [0.0]"
            )
        once = standing and len(keys.get("start_time", ())) == 1
        if "stop_angle_deg" in keys and self.start and not once:
            raise InputError(
                "drive.stop_angle_deg with drive.start_time: allowed is one start, of a press that "
                "stands, as the time of the stop is not known beforehand"
            )
        if self.brake is not None and not standing and self.stop is None:
            self.brake.refuse_unused(("brake_torque",), NO_STOP)
        self._check_order(standing)

    @property
    def _keys(self) -> dict[str, Any]:
        """The keys that are given, of the parts, too."""
        return {name: value for name, value, _ in key_values(self) if value is not None}

    def _demand_ramps(self) -> None:
        """Demand how clutch and brake answer to commands that there are."""
        keys, fields, ramps = self._keys, declared_keys(Clutch), []
        if self.start is not None:
            ramps += ["clutch_on", *(["brake_off"] if self.brake else [])]
        if self.stop is not None:
            ramps += ["clutch_off", *(["brake_on"] if self.brake else [])]
        if missing := {n: fields[n] for n in ramps if not {n, f"{n}_deg"} & keys.keys()}:
            where = f"[drive], as in {next(iter(missing))} = [0.02, 0.06]"
            text = need_text(missing, "drive", where)
            raise MissingKeysError([("[drive] with drive.clutch_torque", text)])

    def _refuse_overlaps(self) -> None:
        """Refuse clutch and brake that act at once."""
        keys = self._keys
        for first, second in (
            ("brake_off", "clutch_on"),
            ("clutch_off", "brake_on"),
            ("clutch_off_deg", "brake_on_deg"),
        ):
            if first in keys and second in keys and keys[second][0] < keys[first][1]:
                raise InputError(
                    f"drive.{second} = {list(keys[second])!r} overlaps drive.{first} = "
                    f"{list(keys[first])!r}: clutch and brake would act at once; allowed is a "
                    f"begin >= {keys[first][1]:g}"
                )
        for first, second in (("clutch_off", "brake_on_deg"), ("clutch_off_deg", "brake_on")):
            if first in keys and second in keys:
                raise InputError(
                    f"drive.{first} and drive.{second}: allowed are both over time, or both "
                    "over angle, as else nothing says whether they overlap"
                )

    def _check_order(self, standing: bool) -> None:
        """Refuse a command before the last one is done, or the same one twice."""
        for (name, at), (then, after) in pairwise(self._commands(standing)):
            ends = at + max([0.0, *(ramp[1] for ramp in self._ramps(name))])
            if name == then:
                raise InputError(
                    f"drive.{name} = {after:g} after {at:g}: allowed is a "
                    f"{'stop' if name == 'start_time' else 'start'} in between"
                )
            if after < ends:
                raise InputError(
                    f"drive.{then} = {after:g} overlaps drive.{name} = {at:g}, whose clutch and "
                    f"brake are done at {ends:g} s: allowed is a time >= {ends:g}"
                )

    def _commands(self, standing: bool) -> Iterator[tuple[str, float]]:
        """Yield the commands with known times, in their order, from the run's beginning on."""
        yield "stop_time" if standing else "start_time", -math.inf
        keys = self._keys
        commands = [(name, at) for name in COMMANDS for at in keys.get(name, ())]
        yield from sorted(commands, key=lambda command: command[1])

    def _ramps(self, command: str) -> list[tuple[float, float]]:
        names, keys = OF_START if command == "start_time" else OF_STOP, self._keys
        return [keys[name] for name in names if name in keys]

    def schedule(self, turning: bool) -> Schedule:
        """Return the commands of a run that begins turning or not, and how the parts answer."""
        keys = self._keys

        def ramp(name: str) -> Ramp | None:
            if f"{name}_deg" in keys:
                begin, end = map(math.radians, keys[f"{name}_deg"])
                return Ramp(begin, end, over_angle=True)
            return Ramp(*keys[name]) if name in keys else None

        angle = keys.get("stop_angle_deg")
        return Schedule(
            turning,
            keys.get("start_time", ()),
            keys.get("stop_time", ()),
            None if angle is None else math.radians(angle),
            ramp("clutch_on"),
            ramp("clutch_off"),
            ramp("brake_off"),
            ramp("brake_on"),
        )


def _check_times(name: str, times: tuple[float, ...]) -> None:
    """Refuse times that do not increase from 0 on."""
    check_increasing(f"drive.{name}", times)
    if times and times[0] < 0.0:
        raise InputError(f"drive.{name} = {times[0]!r}: allowed is a number >= 0")
