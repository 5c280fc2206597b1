"""Warnings about films whose oil warms."""

from collections.abc import Iterator

import numpy as np

from exu_press.quantities.oil import film_balance, film_change
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.scene import LubricatedJoint

__all__ = ["oil_warnings"]

UNSETTLED = 0.5
"""K, within which a film has found its temperature."""

UNBALANCED = 0.05
"""Of the dissipated heat, within which it is carried off in the revolutions that are read."""

THICKER = 1.5
"""Viscosity at the largest force over that at the mean one."""


def oil_warnings(result: Result) -> Iterator[str]:
    """Yield films that have not found their temperature, or in which an oil's law is stretched."""
    if not result.completed:
        return
    for name, joint in result.scene.joints.items():
        if isinstance(joint, LubricatedJoint) and f"{name}_temperature" in result:
            yield from _settling(result, name)
            yield from _outside(result, name, joint)


def _settling(result: Result, name: str) -> Iterator[str]:
    """Yield a film that still warms."""
    run, shown = Reading(result), name.replace("_", " ")
    change, balance = film_change(run, name), film_balance(run, name)
    now = float(result[f"{name}_temperature"][-1])
    if change is not None and abs(change) > UNSETTLED:
        yield (
            f"{shown}: the film is at {now:.1f} deg C, and the heat of the last revolution asks "
            f"for {change:+.2g} K; it warms from revolution to revolution: try more revolutions"
        )
    elif balance is not None and abs(balance) > UNBALANCED:
        yield (
            f"{shown}: {balance:+.0%} of the film's heat is not carried off in the revolutions "
            "that are read, as it still warms in the first of them: try more, and a larger settle"
        )


def _outside(result: Result, name: str, joint: LubricatedJoint) -> Iterator[str]:
    """Yield where the laws of the oil do not hold."""
    oil, shown = joint.film.oil, name.replace("_", " ")
    assert oil is not None and joint.film.length is not None
    now = float(result[f"{name}_temperature"][-1])
    low, high = oil.at_celsius
    if not low <= now <= high:
        yield (
            f"{shown}: the film is at {now:.1f} deg C; its viscosity is extrapolated beyond the "
            f"points of film.oil at {low:g} and {high:g} deg C"
        )
    if oil.pressure_viscosity is not None:
        area = 2.0 * joint.radius * joint.film.length
        peak = float(np.linalg.norm(result[f"{name}_force"], axis=1).max()) / area
        ratio = oil.viscosity(now, peak) / float(result[f"{name}_viscosity"][-1])
        if ratio > THICKER:
            yield (
                f"{shown}: under the largest force, {peak / 1e6:.3g} MPa, the oil would be "
                f"{ratio:.2g} times as thick as the run has it, with the mean pressure of a "
                "revolution"
            )
