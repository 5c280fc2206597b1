"""The loosest tolerance at which quantities are within a required error."""

import math
from dataclasses import dataclass, field

from exu_press.errors import InputError
from exu_press.quantities import quantities_of, quantity_of, value_of
from exu_press.quantities.joints import IMPACTS
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.verification.distribution import Distribution, distributions
from exu_press.verification.fixed_errors import FixedError, fixed_errors
from exu_press.verification.refine import negligible
from exu_press.verification.run import simulate_with_errors

__all__ = ["AchievedAccuracy", "accuracy_lines", "find_tolerance", "headline"]

LOOSEST = 2e-2
FINEST = 1e-6

ROUNDS = 6

ENOUGH = 0.3
"""Part of the required error from which on a tolerance is not made looser."""

COARSE = 3.0
"""Factor to which the tolerance is determined."""

LARGEST_FACTOR = 30.0
"""Largest factor by which a tolerance is made finer at a time: early growth of errors says little
of the later one, and a finer run takes longer."""

AIM = 0.8
"""Part of the required error that a next tolerance aims at."""


@dataclass(frozen=True)
class AchievedAccuracy:
    """A run at the loosest tolerance with the required accuracy, or at the finest.

    Attributes:
        result: of the run, with its errors.
        unmet: quantities that no tolerance determines within the required error, with their
            distribution over revolutions, where the motion is chaotic and they have one, else None.
        fixed: errors of those whose error exceeds the required one at any tolerance.
    """

    result: Result
    tolerance: float
    unmet: dict[str, Distribution | None]
    fixed: dict[str, FixedError] = field(default_factory=dict)


def headline(result: Result, name: str | None = None) -> list[str]:
    """Return the name of one quantity, or those of the headline quantities that are not zero."""
    if name is not None:
        return [quantity_of(result.scene, name).name]
    headline_quantities = {
        n: placed for n, placed in quantities_of(result.scene).items() if placed.quantity.headline
    }
    return [key for key, value in numbers_of(result, headline_quantities).items() if value]


def find_tolerance(
    scene: Scene, required: float, name: str | None = None, *, quiet: bool = True
) -> AchievedAccuracy:
    """Find the loosest tolerance at which quantities are within a required error.

    Args:
        scene: its tolerance begins the search.
        required: error over value.
        name: of a quantity, dotted; None: the headline ones.

    Raises:
        InputError: the scene has fixed steps, or no such quantity.
    """
    solver = scene.solver
    if solver.tolerance is None:
        raise InputError("--within: finds a tolerance, and solver.step asks for fixed steps")
    if name is not None:
        quantity_of(scene, name)  # refused before anything is run
    tolerance, best = solver.tolerance, None
    failing = math.inf
    for _ in range(ROUNDS):
        result = simulate_with_errors(scene.replace({"solver.tolerance": tolerance}), quiet=quiet)
        names = headline(result, name)
        if not result.completed:
            return AchievedAccuracy(result, tolerance, dict.fromkeys(names))
        known = negligible(result, required) if name is None else set()
        error_ratios = {key: _error(result, key) / required for key in names if key not in known}
        fixed = fixed_errors(result, error_ratios)
        if exceeding := {key: e for key, e in fixed.items() if e.relative > required}:
            return AchievedAccuracy(result, tolerance, dict.fromkeys(exceeding), exceeding)
        largest_ratio = max(error_ratios.values(), default=0.0)
        if largest_ratio <= 1.0:
            best = AchievedAccuracy(result, tolerance, {})
            next_tolerance = tolerance * min(AIM / max(largest_ratio, 1e-3), 20.0)
            if largest_ratio >= ENOUGH or failing <= COARSE * tolerance:
                return best
            if next_tolerance >= failing:
                next_tolerance = math.sqrt(failing * tolerance)
        else:
            failing = min(failing, tolerance)
            if best is not None:
                if failing <= COARSE * best.tolerance:
                    return best
                tolerance = math.sqrt(failing * best.tolerance)
                continue
            if tolerance <= FINEST:
                break
            next_tolerance = tolerance * min(AIM / largest_ratio, _for_horizon(result))
            next_tolerance = max(next_tolerance, tolerance / LARGEST_FACTOR, FINEST)
        if min(next_tolerance, LOOSEST) == tolerance:
            break
        tolerance = min(next_tolerance, LOOSEST)
    if best is not None:
        return best
    unmet = [key for key, error in error_ratios.items() if error > 1.0]
    is_chaotic = result.info["horizon"] is not None
    alternatives = distributions(scene, unmet, required, quiet=quiet) if is_chaotic else {}
    return AchievedAccuracy(result, tolerance, {key: alternatives.get(key) for key in unmet})


def _error(result: Result, name: str) -> float:
    """Return a quantity's error over its value; infinity where it has none."""
    stated, value = result.info["errors"].get(name), value_of(result, name).value
    return math.inf if stated is None else float(stated["error"] / abs(value)) if value else 0.0


def _for_horizon(result: Result) -> float:
    """Return the factor on the tolerance with which the horizon would reach the end."""
    horizon, rate = result.info["horizon"], result.info["lyapunov_exponent"]
    if horizon is None or rate is None:
        return 1.0
    return math.exp(-rate * float(result.time[-1] - horizon))


def accuracy_lines(achieved: AchievedAccuracy, required: float) -> list[str]:
    """Return the quantities with and without the required error, for the terminal."""
    tolerance = achieved.tolerance
    if not achieved.unmet:
        return [f"every figure asked for within {100 * required:.3g} %: tolerance {tolerance:.2g}"]
    lines = [] if achieved.fixed else _horizon_lines(achieved.result)
    for name, distribution in achieved.unmet.items():
        if name in achieved.fixed:
            fixed = achieved.fixed[name]
            lines.append(
                f"{name}: not within {100 * required:.3g} % at any tolerance: {fixed.cause} alone "
                f"leaves {100 * fixed.relative:.2g} %; allow more, or take {fixed.cure}"
            )
            continue
        lines.append(
            f"{name}: not within {100 * required:.3g} %, down to a tolerance of {tolerance:.2g}"
        )
        if distribution is None:
            is_chaotic = achieved.result.info["horizon"] is not None
            why = "it adds up, or one revolution does not have it"
            lines.append(f"  no distribution: {why if is_chaotic else 'motion is not chaotic'}")
            continue
        text = "; ".join(
            f"{percent:.0f} % below {value:.4g} ({low:.4g} to {high:.4g})"
            for percent, (value, low, high) in distribution.percentiles.items()
        )
        lines.append(f"  over {distribution.revolutions} revolutions: {text}")
    return lines


def _horizon_lines(result: Result) -> list[str]:
    horizon, rate = result.info["horizon"], result.info["lyapunov_exponent"]
    if horizon is None:
        return []
    angle = math.degrees(result.scene.angular_speed * horizon)
    growth = ""
    if rate is not None:
        counted = {n: q for n, q in quantities_of(result.scene).items() if q.quantity is IMPACTS}
        impacts = sum(numbers_of(result, counted).values()) / float(result.time[-1])
        growth = f", and grow tenfold in {math.log(10.0) / rate * 1e3:.3g} ms"
        if impacts > 0.0:
            growth += f", {math.exp(rate / impacts):.2g}-fold an impact"
    return [
        f"estimated errors are larger than the values from t = {horizon * 1e3:.4g} ms on, "
        f"{angle:.0f} deg of the crank after the start{growth}"
    ]
