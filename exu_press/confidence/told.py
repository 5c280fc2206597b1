"""What came of a wanted error, in words."""

import math

from exu_press.confidence.within import Delivered
from exu_press.result import Result

__all__ = ["delivered_lines"]


def delivered_lines(delivered: Delivered, within: float) -> list[str]:
    """Return what a tolerance delivers, and what no tolerance does, for the terminal."""
    if not delivered.missed:
        return [
            f"within {within:.3g} of every figure asked for: tolerance {delivered.tolerance:.2g}"
        ]
    lines = _chaos(delivered.result)
    for name, found in delivered.missed.items():
        lines.append(f"{name}: not determined within {within:.3g} at any tolerance tried")
        if found is None:
            continue
        shown = "; ".join(
            f"{percent:.0f} % below {value:.4g} ({low:.4g} to {high:.4g})"
            for percent, (value, low, high) in found.percentiles.items()
        )
        lines.append(f"  over {found.revolutions} revolutions: {shown}")
    return lines


def _chaos(result: Result) -> list[str]:
    """Return from when on errors exceed the figures, and how they grow."""
    horizon, rate = result.info["errors_from"], result.info["amplification"]
    if horizon is None:
        return []
    angle = math.degrees(result.scene.angular_speed * horizon)
    growth = ""
    if rate is not None:
        impacts = sum(
            joint.get("impacts") or 0 for joint in result.summary()["joints"].values()
        ) / float(result.time[-1])
        growth = f", and grow tenfold in {math.log(10.0) / rate * 1e3:.3g} ms"
        if impacts > 0.0:
            growth += f", {math.exp(rate / impacts):.2g}-fold an impact"
    return [
        f"errors exceed the figures from t = {horizon * 1e3:.4g} ms on, "
        f"{angle:.0f} deg of the crank after the start{growth}"
    ]
