"""The keys of [drive] for a press that starts and stops: clutch, brake, and when they act."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields
from itertools import pairwise

from exu_press.errors import InputError
from exu_press.laws.schedule import Ramp, Schedule
from exu_press.schema.checks import Table, check_increasing, demand_keys, key

__all__ = ["StartStop"]

BEGINS = ("turning", "standing", "rest")

OF_START, OF_STOP = ("clutch_on", "brake_off"), ("clutch_off", "brake_on")
"""Ramps behind a command: the first has to be over before the other begins."""


@dataclass(frozen=True)
class StartStop(Table):
    """Start of the run, and a friction clutch and brake behind the flywheel, by a schedule.

    A clutch or brake slips at its torque, and below it sticks. A start lets the brake go, then
    engages the clutch; a stop does the reverse. Ramps are lines between two places behind the
    command.
    """

    begins: str = key(
        "turning",
        "flywheel and crank turn at speed_rpm; the flywheel does, and the crank stands; or both "
        "are at rest, and the motor starts",
        choices=BEGINS,
    )
    clutch_torque: float | None = key(
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
        source="assumed",
    )
    start_time: tuple[float, ...] | None = key(None, "commands to start", "s", numbers=0)
    clutch_on: tuple[float, float] | None = key(
        None,
        "behind a start, between which the clutch's torque rises to its full one",
        "s",
        numbers=2,
    )
    brake_off: tuple[float, float] | None = key(
        None, "behind a start, between which the brake's torque falls to nothing", "s", numbers=2
    )
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
    brake_torque: float | None = key(
        None, "of the brake at most, on the crank's shaft", "N m", above=0
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
    ends_after: float | None = key(
        None,
        "for which the run goes on when the press stands after its last stop; to the end of "
        "`revolutions` unless given",
        "s",
        above=0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.clutch_torque is None:
            if self.begins == "standing":
                demand_keys("drive.begins = 'standing'", self, ("clutch_torque",), "drive", "drive")
            return
        for name in (*OF_START, *OF_STOP, "clutch_off_deg", "brake_on_deg"):
            _rising(name, getattr(self, name))
        if self.begins != "turning" and not self.start_time:
            raise InputError(
                f"drive.begins = {self.begins!r} needs drive.start_time (commands to start, s), "
                "as in start_time = [0.0]"
            )
        for name in ("start_time", "stop_time"):
            _rising(name, getattr(self, name))
        if self.stop_time and self.stop_angle_deg is not None:
            raise InputError("drive.stop_time and drive.stop_angle_deg: allowed is one of the two")
        once = self.begins != "turning" and len(self.start_time or ()) == 1
        if self.stop_angle_deg is not None and self.start_time and not once:
            raise InputError(
                "drive.stop_angle_deg with drive.start_time: allowed is one start, of a press that "
                "stands, as the time of the stop is not known beforehand"
            )
        self._demand_ramps()
        self._refuse_overlaps()

    def _demand_ramps(self) -> None:
        """Demand how clutch and brake answer to commands that there are."""
        wanted = ["clutch_on"] if self.start_time else []
        if self.stops:
            wanted += [] if self.clutch_off_deg is not None else ["clutch_off"]
        if self.brake_torque is not None:
            wanted += ["brake_off"] if self.start_time else []
            if self.stops:
                wanted += [] if self.brake_on_deg is not None else ["brake_on"]
        for name in wanted:
            if getattr(self, name) is None:
                raise InputError(
                    f"[drive] with drive.clutch_torque needs drive.{name}, which decides its "
                    f"result and has no default; give it in [drive], as in {name} = [0.02, 0.06]"
                )
        for name in OF_STOP:
            if getattr(self, name) is not None and getattr(self, f"{name}_deg") is not None:
                raise InputError(f"drive.{name} and drive.{name}_deg: allowed is one of the two")

    def _refuse_overlaps(self) -> None:
        """Refuse clutch and brake that act at once, and a command before the last one is done."""
        for first, second in (
            ("brake_off", "clutch_on"),
            ("clutch_off", "brake_on"),
            ("clutch_off_deg", "brake_on_deg"),
        ):
            over, begins = getattr(self, first), getattr(self, second)
            if over is not None and begins is not None and begins[0] < over[1]:
                raise InputError(
                    f"drive.{second} = {list(begins)!r} overlaps drive.{first} = {list(over)!r}: "
                    f"clutch and brake would act at once; allowed is a begin >= {over[1]:g}"
                )
        if self.brake_torque is not None:
            for first, second in (("clutch_off", "brake_on_deg"), ("clutch_off_deg", "brake_on")):
                if getattr(self, first) is not None and getattr(self, second) is not None:
                    raise InputError(
                        f"drive.{first} and drive.{second}: allowed are both over time, or both "
                        "over angle, as else nothing says whether they overlap"
                    )
        for (name, at), (then, after) in pairwise(self._commands()):
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

    def _commands(self) -> Iterator[tuple[str, float]]:
        """Yield the commands with known times, in their order, from the run's beginning on."""
        if self.begins == "turning":
            yield "start_time", -math.inf
        else:
            yield "stop_time", -math.inf
        given = [("start_time", at) for at in self.start_time or ()]
        given += [("stop_time", at) for at in self.stop_time or ()]
        yield from sorted(given, key=lambda command: command[1])

    def _ramps(self, command: str) -> list[tuple[float, float]]:
        names = OF_START if command == "start_time" else OF_STOP
        return [ramp for name in names if (ramp := getattr(self, name)) is not None]

    @property
    def stops(self) -> bool:
        """Return whether a stop is commanded."""
        return bool(self.stop_time) or self.stop_angle_deg is not None

    @property
    def scheduled(self) -> bool:
        """Return whether the press starts or stops in the run."""
        return self.begins != "turning" or self.stops or bool(self.start_time)

    @property
    def stands(self) -> bool:
        """Return whether the crank stands at the start."""
        return self.begins != "turning"

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys of clutch, brake and schedule that are not used."""
        if self.clutch_torque is None:
            return dict.fromkeys(OF_CLUTCH, "drive.clutch_torque is not given")
        found: dict[str, str] = {}
        if not self.start_time:
            found |= dict.fromkeys(OF_START, "drive.start_time is not given")
        if not self.stops:
            why = "neither drive.stop_time nor drive.stop_angle_deg is given"
            found |= dict.fromkeys((*OF_STOP, "clutch_off_deg", "brake_on_deg", "ends_after"), why)
            if not self.stands:
                found["brake_torque"] = why
        if self.brake_torque is None:
            why = "drive.brake_torque is not given"
            found |= dict.fromkeys(("brake_on", "brake_on_deg", "brake_off"), why)
        return found

    def schedule(self) -> Schedule:
        """Return the commands, and how clutch and brake answer."""

        def ramp(name: str) -> Ramp | None:
            over_time, over_angle = getattr(self, name), getattr(self, f"{name}_deg", None)
            if over_angle is not None:
                begin, end = map(math.radians, over_angle)
                return Ramp(begin, end, over_angle=True)
            return None if over_time is None else Ramp(*over_time)

        return Schedule(
            not self.stands,
            self.start_time or (),
            self.stop_time or (),
            None if self.stop_angle_deg is None else math.radians(self.stop_angle_deg),
            ramp("clutch_on"),
            ramp("clutch_off"),
            ramp("brake_off"),
            ramp("brake_on"),
        )


OF_CLUTCH = {field.name for field in fields(StartStop)} - {"begins", "clutch_torque"}
"""Keys that only a drive with a clutch has."""


def _rising(name: str, given: tuple[float, ...] | None) -> None:
    """Refuse places that do not increase from 0 on."""
    check_increasing(f"drive.{name}", given or ())
    if given and given[0] < 0.0:
        raise InputError(f"drive.{name} = {given[0]!r}: allowed is a number >= 0")
