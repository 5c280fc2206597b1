"""The tolerance that delivers figures within a wanted error, and no finer."""

import math
from dataclasses import dataclass

from exu_press.errors import InputError
from exu_press.quantities import quantities_of, quantity_of, value_of
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.verification.distribution import Distribution, distributions
from exu_press.verification.run import simulate_with_errors

__all__ = ["Delivered", "deliver", "headline"]

LOOSEST = 2e-2
FINEST = 1e-6

ROUNDS = 6

ENOUGH = 0.3
"""Part of the allowed error: a tolerance that uses this much of it is not made looser."""

COARSE = 3.0
"""A tolerance is not looked for more closely than by this factor."""

AT_MOST = 30.0
"""By so much a tolerance is made finer at a time: how errors grow at first tells little of how they
do later on, and a finer run takes longer."""

AIM = 0.8
"""Part of the allowed error that is aimed at."""


@dataclass(frozen=True)
class Delivered:
    """The outcome.

    Attributes:
        result: the run at the tolerance that was found, with its errors.
        tolerance: of that run.
        missed: figures that no tolerance determines within what was asked for, with what is
            determined instead; None where that is nothing either.
    """

    result: Result
    tolerance: float
    missed: dict[str, Distribution | None]


def headline(result: Result, name: str | None = None) -> list[str]:
    """Return the names of the quantities that are asked for.

    Args:
        result: whose quantities.
        name: of one quantity; None: those that everybody looks at first.

    Raises:
        InputError: there is no such quantity.
    """
    if name is not None:
        return [quantity_of(result.scene, name).name]
    asked = {n: one for n, one in quantities_of(result.scene).items() if one.quantity.headline}
    return [key for key, value in numbers_of(result, asked).items() if value]


def deliver(
    scene: Scene, within: float, name: str | None = None, *, quiet: bool = True
) -> Delivered:
    """Find the tolerance that delivers figures within an error, and no finer.

    Args:
        scene: its own tolerance is where the search begins.
        within: the error over the figure.
        name: of a figure, dotted; None: the headline ones.
        quiet: False shows the progress.

    Raises:
        InputError: the scene has fixed steps, or no such figure.
    """
    solver = scene.solver
    assert solver is not None
    if solver.tolerance is None:
        raise InputError("--within: finds a tolerance, and solver.step asks for fixed steps")
    if name is not None:
        quantity_of(scene, name)  # refused before anything is run
    tolerance, best = solver.tolerance, None
    fails = math.inf
    for _ in range(ROUNDS):
        result = simulate_with_errors(scene.replace({"solver.tolerance": tolerance}), quiet=quiet)
        names = headline(result, name)
        if not result.completed:
            return Delivered(result, tolerance, dict.fromkeys(names))
        off = {key: _error(result, key) / within for key in names}
        need = max(off.values())
        if need <= 1.0:
            best = Delivered(result, tolerance, {})
            wanted = tolerance * min(AIM / max(need, 1e-3), 20.0)
            if need >= ENOUGH or fails <= COARSE * tolerance:
                return best
            if wanted >= fails:
                wanted = math.sqrt(fails * tolerance)
        else:
            fails = min(fails, tolerance)
            if best is not None:
                if fails <= COARSE * best.tolerance:
                    return best
                tolerance = math.sqrt(fails * best.tolerance)
                continue
            if tolerance <= FINEST:
                break
            wanted = tolerance * min(AIM / need, _for_horizon(result))
            wanted = max(wanted, tolerance / AT_MOST, FINEST)
        if min(wanted, LOOSEST) == tolerance:
            break
        tolerance = min(wanted, LOOSEST)
    if best is not None:
        return best
    missed = [key for key, error in off.items() if error > 1.0]
    found = distributions(scene, missed, within, quiet=quiet)
    return Delivered(result, tolerance, {key: found.get(key) for key in missed})


def _error(result: Result, name: str) -> float:
    """Return an error over the value; values that are not determined count by their bounds."""
    told, value = result.info["errors"].get(name), value_of(result, name).value
    return math.inf if told is None else float(told["error"] / abs(value)) if value else 0.0


def _for_horizon(result: Result) -> float:
    """Return by how much the tolerance would have to fall for the horizon to reach the end."""
    horizon, rate = result.info["horizon"], result.info["lyapunov_exponent"]
    if horizon is None or rate is None:
        return 1.0
    return math.exp(-rate * float(result.time[-1] - horizon))
