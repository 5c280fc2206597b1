"""[drive]: a motor with its flywheel, and how it starts and stops."""

from dataclasses import dataclass
from typing import ClassVar

from exu_press.errors import InputError, MissingKeysError
from exu_press.laws.motor import MotorLaw, kloss, torque_table
from exu_press.scene.solver import RPM
from exu_press.scene.start_stop import BEGINS, Clutch
from exu_press.schema.checks import check_columns, check_increasing, key
from exu_press.schema.registry import alternatives
from exu_press.schema.table import Table, missing_keys

__all__ = ["InductionMotor", "Motor", "TorqueTable"]

USUAL_BREAKDOWN = 2.5  # of the rated torque


@dataclass(frozen=True)
class InductionMotor(Table):
    """Kloss' formula, through the rated point up to the breakdown torque."""

    table: ClassVar[str] = "drive"
    needed: ClassVar[tuple[str, ...]] = ("rated_torque",)
    rated_torque: float | None = key(None, "at rated speed", "N m", above=0, example=400.0)
    slip: float = key(
        0.05,
        "(speed without load - rated speed) / speed without load",
        above=0,
        at_most=1,
        source="the least of design D, NEMA MG 10, Table 2-1",
    )
    breakdown_torque: float | None = key(
        None,
        "largest one; 2.5 rated_torque unless given (IEC 60034-1 asks for 1.6, catalogues have 2 "
        "to 3.5)",
        "N m",
        above=0,
    )
    no_load_speed_rpm: float | None = key(
        None, "without torque; speed_rpm unless given", "rpm", above=0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        largest, rated = self.breakdown_torque, self.rated_torque
        if largest is not None and rated is not None and largest < rated:
            raise InputError(
                f"drive.breakdown_torque = {largest!r}: allowed is a number >= "
                f"drive.rated_torque = {rated!r}"
            )

    @property
    def shown_torque(self) -> float:
        """The rated torque, N m."""
        assert self.rated_torque is not None
        return self.rated_torque

    def law(self, speed_rpm: float) -> MotorLaw:
        """Return the torque over the speed of the crank, which starts at speed_rpm."""
        rated = self.shown_torque
        largest = self.breakdown_torque or USUAL_BREAKDOWN * rated
        return kloss(rated, self.slip, largest, self.fastest(speed_rpm))

    def fastest(self, speed_rpm: float) -> float:
        """Return the speed without torque, rad/s."""
        return (self.no_load_speed_rpm or speed_rpm) * RPM


@dataclass(frozen=True)
class TorqueTable(Table):
    """Any motor, by a table of its torque."""

    table: ClassVar[str] = "drive"
    table_speed_rpm: tuple[float, ...] | None = key(
        None, "of a table of torques instead, which goes on at both ends", "rpm", numbers=0
    )
    table_torque: tuple[float, ...] | None = key(None, "at these speeds", "N m", numbers=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        names = ("drive.table_speed_rpm", "drive.table_torque")
        check_columns(names, self._speeds, self.table_torque or ())
        check_increasing(names[0], self._speeds)
        if self._speeds[-1] <= 0.0:
            raise InputError(
                f"{names[0]} = {self._speeds[-1]!r} at the end: allowed is a number > 0"
            )

    @property
    def _speeds(self) -> tuple[float, ...]:
        return self.table_speed_rpm or ()

    @property
    def shown_torque(self) -> float:
        """The largest torque, N m."""
        return max(self.table_torque or ())

    def law(self, speed_rpm: float) -> MotorLaw:
        """Return the torque over the speed of the crank."""
        return torque_table([speed * RPM for speed in self._speeds], self.table_torque or ())

    def fastest(self, speed_rpm: float) -> float:
        """Return the last speed of the table, rad/s."""
        return self._speeds[-1] * RPM


@dataclass(frozen=True)
class Motor(Table):
    """A motor with its flywheel instead of a crank at constant speed; all reduced to the crank.

    The run starts at `speed_rpm`, unless it begins at rest. With `clutch_torque` a friction clutch
    lies between flywheel and crank, and perhaps a brake on the crank, which a schedule of starts
    and stops engages.
    """

    table: ClassVar[str] = "drive"
    needed: ClassVar[tuple[str, ...]] = ("inertia",)
    begins: str = key(
        "turning",
        "flywheel and crank turn at speed_rpm; the flywheel does, and the crank stands; or both "
        "are at rest, and the motor starts",
        choices=BEGINS,
    )
    clutch: Clutch | None = alternatives({"clutch_torque": "scene.start_stop:Clutch"})
    torque: InductionMotor | TorqueTable = alternatives(
        {
            "table_torque": "scene.motor:TorqueTable",
            "table_speed_rpm": "scene.motor:TorqueTable",
            "": "scene.motor:InductionMotor",
        }
    )
    inertia: float = key(None, "of flywheel, gear and motor", "kg m^2", above=0, example=50.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        needs = missing_keys("[drive]", self, (), "drive", "[drive]")
        if self.clutch is None and self.begins == "standing":
            torque = (
                "drive.clutch_torque (that the clutch transmits at most, reduced to the crank, "
                "N m), which decides the result and has no default; give it in [drive]"
            )
            needs.append(("drive.begins = 'standing'", torque))
        if needs:
            raise MissingKeysError(needs)
        if self.clutch is not None:
            self.clutch.check_start(self.begins)

    @property
    def on_crank(self) -> float:
        """Inertia that turns with the crank, kg m^2: the flywheel's, unless a clutch is between."""
        return self.inertia if self.clutch is None else self.clutch.driven_inertia

    @property
    def stops(self) -> bool:
        """Whether a stop is commanded."""
        return self.clutch is not None and self.clutch.stop is not None

    @property
    def starts(self) -> bool:
        """Whether a start is commanded."""
        return self.clutch is not None and self.clutch.start is not None

    @property
    def ends_after(self) -> float | None:
        """For which the run goes on when the press stands after its last stop, s."""
        stop = None if self.clutch is None else self.clutch.stop
        return None if stop is None else stop.ends_after

    @property
    def stands(self) -> bool:
        """Whether the crank stands at the start."""
        return self.begins != "turning"

    @property
    def has_schedule(self) -> bool:
        """Whether the press starts or stops in the run."""
        return self.stands or self.stops or self.starts
