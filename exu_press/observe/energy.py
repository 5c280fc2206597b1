"""The energy balance of a run in numbers: how much, and how well it closes."""

import numpy as np

from exu_press.arrays import Array
from exu_press.result import Result

__all__ = ["energy_residual", "energy_scale", "energy_summary", "has_balance"]

BALANCE = ("input", "stored", "dissipated")

NOTHING = 1e-9
"""J; the last digits of a megajoule of kinetic energy change by as much."""


def energy_summary(result: Result) -> dict[str, float | None]:
    """Return what was put in, stored and dissipated until the end, J, and the residual.

    All are None where the user's own items were part of the system: what those put in, store and
    dissipate is not known.
    """
    if not has_balance(result):
        return dict.fromkeys((*BALANCE, "residual"))
    ends = {name: float(values[-1]) for name, values in _balance(result).items()}
    return {**ends, "residual": energy_residual(result)}


def has_balance(result: Result) -> bool:
    """Return whether the balance of a run is known."""
    return "energy_input" in result


def energy_scale(result: Result) -> float:
    """Return the largest energy, J, that was put in, exchanged with what is stored, or dissipated.

    Since the start and in either direction: a rotor that runs down is put nothing in.
    """
    return max(float(np.abs(values).max()) for values in _balance(result).values())


def energy_residual(result: Result) -> float | None:
    """Return the worst that the balance misses over the run, relative to `energy_scale`.

    None where there is no balance, or next to no energy that it could be relative to.
    """
    if not has_balance(result) or energy_scale(result) < NOTHING:
        return None
    given, stored, lost = _balance(result).values()
    return float(np.abs(given - stored - lost).max()) / energy_scale(result)


def _balance(result: Result) -> dict[str, Array]:
    return {name: result[f"energy_{name}"] for name in BALANCE}
