"""Quantities of gears."""

from exu_press.quantities.kind import LOAD
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading

__all__ = ["GEARS"]


def _peak_torque(run: Reading, gear: str) -> float | None:
    channel = f"gear_{gear}_torque"
    return None if run.channel(channel) is None else run.peaks(channel).length


GEARS = (
    Quantity("peak_torque", "N m", "largest torque of the gear on its body",
             LOAD, _peak_torque, Owner.GEAR,
             title="gear torque, max", display_unit="kN m", extreme=Extreme.LARGEST,
             curve="torque"),
)  # fmt: skip
