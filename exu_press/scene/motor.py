"""[drive]: a motor with its flywheel, and how it starts and stops."""

from dataclasses import dataclass
from typing import ClassVar

from exu_press.errors import InputError
from exu_press.laws.motor import MotorLaw, kloss, torque_table
from exu_press.scene.start_stop import StartStop
from exu_press.scene.tables import RPM
from exu_press.schema.checks import check_columns, check_increasing, demand_keys, key

__all__ = ["Motor"]

USUAL_BREAKDOWN = 2.5  # of the rated torque

OF_KLOSS = ("rated_torque", "slip", "breakdown_torque", "no_load_speed_rpm")
"""Keys of a motor without a table of its torque."""


@dataclass(frozen=True)
class Motor(StartStop):
    """A motor with its flywheel instead of a crank at constant speed; all reduced to the crank.

    An induction motor by Kloss' formula, through the rated point up to the breakdown torque; or any
    motor by a table of its torque. The run starts at `speed_rpm`, unless it begins at rest. With
    `clutch_torque` a friction clutch lies between flywheel and crank, and perhaps a brake on the
    crank, which a schedule of starts and stops engages.
    """

    table: ClassVar[str] = "drive"
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
    table_speed_rpm: tuple[float, ...] | None = key(
        None, "of a table of torques instead, which goes on at both ends", "rpm", numbers=0
    )
    table_torque: tuple[float, ...] | None = key(None, "at these speeds", "N m", numbers=0)
    inertia: float = key(None, "of flywheel, gear and motor", "kg m^2", above=0, example=50.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        demand_keys("[drive]", self, ("inertia",), "drive", "[drive]")
        speeds, torques = self.table_speed_rpm or (), self.table_torque or ()
        if self.table_speed_rpm is None and self.table_torque is None:
            demand_keys("[drive]", self, ("rated_torque",), "drive", "[drive]")
            given, rated = self.breakdown_torque, self.rated_torque
            if given is not None and rated is not None and given < rated:
                raise InputError(
                    f"drive.breakdown_torque = {given!r}: allowed is a number >= "
                    f"drive.rated_torque = {rated!r}"
                )
            return
        check_columns(("drive.table_speed_rpm", "drive.table_torque"), speeds, torques)
        check_increasing("drive.table_speed_rpm", speeds)
        if speeds[-1] <= 0.0:
            raise InputError(
                f"drive.table_speed_rpm = {speeds[-1]!r} at the end: allowed is a number > 0"
            )

    def unused(self, **instead: str) -> dict[str, str]:
        """Return the keys that are not used: those of Kloss where a table is given."""
        found = super().unused(**instead)
        if self.table_torque is not None:
            found |= dict.fromkeys(OF_KLOSS, "drive.table_torque is given")
        return found

    @property
    def on_crank(self) -> float:
        """Inertia that turns with the crank, kg m^2: the flywheel's, unless a clutch is between."""
        return self.inertia if self.clutch_torque is None else self.driven_inertia

    def law(self, speed_rpm: float) -> MotorLaw:
        """Return the torque over the speed of the crank, which starts at speed_rpm."""
        if self.table_speed_rpm is not None and self.table_torque is not None:
            return torque_table([speed * RPM for speed in self.table_speed_rpm], self.table_torque)
        assert self.rated_torque is not None
        largest = self.breakdown_torque or USUAL_BREAKDOWN * self.rated_torque
        return kloss(self.rated_torque, self.slip, largest, self.fastest(speed_rpm))

    def fastest(self, speed_rpm: float) -> float:
        """Return the speed without torque, or the table's last one, rad/s."""
        if self.table_speed_rpm is not None:
            return self.table_speed_rpm[-1] * RPM
        return (self.no_load_speed_rpm or speed_rpm) * RPM
