"""Text that says which quantities reached the required accuracy."""

import math

from exu_press.quantities import quantities_of
from exu_press.quantities.joints import IMPACTS
from exu_press.quantities.value import numbers_of
from exu_press.result import Result
from exu_press.verification.within import AchievedAccuracy

__all__ = ["accuracy_lines"]


def accuracy_lines(achieved: AchievedAccuracy, required: float) -> list[str]:
    """Return the quantities with and without the required error, for the terminal."""
    tolerance = achieved.tolerance
    if not achieved.unmet:
        return [f"every figure asked for within {100 * required:.3g} %: tolerance {tolerance:.2g}"]
    lines = _horizon_lines(achieved.result)
    for name, distribution in achieved.unmet.items():
        lines.append(
            f"{name}: not within {100 * required:.3g} %, down to a tolerance of {tolerance:.2g}"
        )
        if distribution is None:
            lines.append("  no distribution: it adds up, or one revolution does not have it")
            continue
        text = "; ".join(
            f"{percent:.0f} % below {value:.4g} ({low:.4g} to {high:.4g})"
            for percent, (value, low, high) in distribution.percentiles.items()
        )
        lines.append(f"  over {distribution.revolutions} revolutions: {text}")
    return lines


def _horizon_lines(result: Result) -> list[str]:
    """Return the predictability horizon and the growth of errors."""
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
