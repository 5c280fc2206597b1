"""Quantities of gears, and of springs between bodies."""

from exu_press.mechanism.springs import GasSpring
from exu_press.quantities.acceleration import peak
from exu_press.quantities.kind import ENERGY, LOAD, MOTION
from exu_press.quantities.quantity import Extreme, Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene, mechanism_of

__all__ = ["GEARS", "SPRINGS"]


def _is_gas(scene: Scene, name: str) -> bool:
    springs = {spring.name: spring for spring in mechanism_of(scene).springs}
    return isinstance(springs[name], GasSpring)


def _peak_pressure(run: Reading, name: str) -> float:
    spring = next(spring for spring in run.mechanism.springs if spring.name == name)
    assert isinstance(spring, GasSpring)
    return float(spring.gas_pressure(run[f"spring_{name}_length"]).max())


GEARS = (
    Quantity("peak_torque", "N m", "largest torque of the gear on its body",
             LOAD, lambda run, gear: run.peak(f"gear_{gear}_torque"), Owner.GEAR,
             title="gear torque, max", display_unit="kN m", extreme=Extreme.LARGEST,
             curve="torque"),
)  # fmt: skip

SPRINGS = (
    Quantity("peak_force", "N", "largest force of the spring",
             MOTION, lambda run, name: peak(run[f"spring_{name}_force"]), Owner.SPRING,
             title="spring force, max", display_unit="kN", extreme=Extreme.LARGEST, curve="force"),
    Quantity("min_length", "m", "least length of the spring",
             MOTION, lambda run, name: float(run[f"spring_{name}_length"].min()), Owner.SPRING,
             extreme=Extreme.LEAST),
    Quantity("max_length", "m", "largest length of the spring",
             MOTION, lambda run, name: float(run[f"spring_{name}_length"].max()), Owner.SPRING,
             extreme=Extreme.LARGEST, curve="length"),
    Quantity("peak_pressure", "Pa", "largest absolute pressure of the gas",
             MOTION, _peak_pressure, Owner.SPRING, _is_gas,
             title="gas pressure, max", display_unit="MPa", is_detail=True,
             extreme=Extreme.LARGEST),
    Quantity("dissipated", "J", "energy that the spring has dissipated",
             ENERGY, lambda run, name: float(run[f"spring_{name}_loss"][-1]), Owner.SPRING,
             cumulative=True),
)  # fmt: skip
