"""Quantities of the energy balance: how much, and how well it closes."""

from collections.abc import Callable

import numpy as np

from exu_press.numerics.arrays import Array
from exu_press.quantities.kind import ENERGY, FLOW, MEASURE
from exu_press.quantities.law_errors import dissipation_error
from exu_press.quantities.quantity import Quantity
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.result.energy import mechanical_energy
from exu_press.scene import Scene, mechanism_of

__all__ = ["BALANCE", "energy_residual", "energy_scale", "has_balance", "kinetic_energy"]

PARTS = ("input", "stored", "dissipated")

LITTLE = 1e-6
"""Over the kinetic energy with ideal joints: an exchange that its last digits may be."""


def has_balance(result: Result) -> bool:
    """Return whether the balance of a run is known."""
    return "energy_input" in result


def energy_scale(result: Result) -> float:
    """Return the largest energy, J, that was put in, exchanged with the stored one, or dissipated.

    Since the start and in either direction: a rotor that runs down is put nothing in.
    """
    return max(float(np.abs(values).max()) for values in _balance(result).values())


def energy_residual(result: Result) -> float | None:
    """Return the worst that the balance misses over the run, relative to `energy_scale`.

    None where there is no balance, or next to no energy that it could be relative to, as in a run
    of a few degrees in which no surfaces touch. Relative to the kinetic energy where next to
    nothing is put in or dissipated, as by a motor that coasts: the misfit is all that is stored.
    """
    if not has_balance(result):
        return None
    scale, kinetic = energy_scale(result), kinetic_energy(result.scene)
    if scale <= LITTLE * kinetic:
        return None
    put_in, stored, dissipated = _balance(result).values()
    if max(np.abs(put_in).max(), np.abs(dissipated).max()) <= LITTLE * kinetic:
        scale = kinetic
    return float(np.abs(put_in - stored - dissipated).max()) / scale


def kinetic_energy(scene: Scene) -> float:
    """Return the kinetic energy at the start, J, with ideal joints and the nominal speed."""
    mechanism = mechanism_of(scene)
    motions = mechanism.motion(np.array([scene.start_angle]), scene.angular_speed)
    return float(mechanical_energy(mechanism.bodies, motions, gravity=0.0)[0])


def _balance(result: Result) -> dict[str, Array]:
    return {name: result[f"energy_{name}"] for name in PARTS}


def _end(kind: str) -> Callable[[Reading, str], float | None]:
    """Return a reader of a balance at the end, None with own items, whose energy is unknown."""
    return lambda run, _: float(run[f"energy_{kind}"][-1]) if has_balance(run.result) else None


def _per_stroke(kind: str) -> Callable[[Reading, str], float | None]:
    """Return a reader of the mean change of a balance's channel in a revolution, likewise."""
    return lambda run, _: run.per_stroke(run[f"energy_{kind}"]) if has_balance(run.result) else None


BALANCE = (
    Quantity("energy.input", "J", "energy that drive, loads and pumps put in",
             FLOW, _end("input"),
             title="energy from drive and loads", signed=True, cumulative=True),
    Quantity("energy.input_per_stroke", "J",
             "energy that drive, loads and pumps put in per revolution, over whole revolutions",
             FLOW, _per_stroke("input"),
             title="per stroke", is_detail=True, signed=True),
    Quantity("energy.stored", "J", "change of the stored energy",
             ENERGY, _end("stored"),
             signed=True, cumulative=True),
    Quantity("energy.dissipated", "J", "energy that joints, guides and flexible bodies dissipate",
             ENERGY, _end("dissipated"),
             title="energy dissipated", headline=True, cumulative=True,
             law_error=dissipation_error),
    Quantity("energy.dissipated_per_stroke", "J",
             "energy that joints, guides and flexible bodies dissipate per revolution, over whole "
             "revolutions",
             ENERGY, _per_stroke("dissipated"),
             title="per stroke", is_detail=True, law_error=dissipation_error),
    Quantity("energy.residual", "",
             "largest misfit of the energy balance, over the largest energy in it",
             MEASURE, lambda run, _: energy_residual(run.result),
             title="energy residual", digits=2),
)  # fmt: skip
