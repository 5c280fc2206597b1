"""Quantities of films whose oil warms."""

from collections.abc import Iterator

from exu_press.laws.film.oil import STEADY
from exu_press.numerics.arrays import lengths
from exu_press.quantities.kind import LOAD, MEASURE
from exu_press.quantities.law_errors import (
    film_error,
    side_flow_error,
    temperature_error,
    viscosity_error,
)
from exu_press.quantities.quantity import Owner, Quantity
from exu_press.quantities.reading import Reading
from exu_press.result import Result
from exu_press.scene import LubricatedJoint, Scene
from exu_press.scene.joint import oil_of

__all__ = ["OIL", "film_balance", "film_change", "oil_warnings"]

UNBALANCED = 0.05
"""Part of the dissipated heat within which it is carried off in the revolutions that are read."""

THICKER = 1.5
"""Viscosity at the largest force over that at the mean one."""


def oil_warnings(run: Reading) -> Iterator[str]:
    """Yield films that have not found their temperature, or in which an oil's law is stretched."""
    result = run.run
    if not result.completed:
        return
    added = result.info.get("added_revolutions", 0)
    if added:
        yield (
            f"{added} revolution{'s' if added > 1 else ''} more than asked for, until the films' "
            "heat and temperature stayed as they were: settle is "
            f"{result.scene.settle_revolutions:g} now"
        )
    for name, joint in result.scene.joints.items():
        if isinstance(joint, LubricatedJoint) and f"{name}_temperature" in result:
            yield from _settling(run, name)
            yield from _outside(result, name, joint)


def _settling(run: Reading, name: str) -> Iterator[str]:
    """Yield a film that still warms."""
    label = name.replace("_", " ")
    change, balance = film_change(run, name), film_balance(run, name)
    now = float(run.run[f"{name}_temperature"][-1])
    if change is not None and abs(change) > STEADY:
        yield (
            f"{label}: the film is at {now:.1f} deg C, and the heat of the last revolution asks "
            f"for {change:+.2g} K; it warms from revolution to revolution: try more revolutions"
        )
    elif balance is not None and abs(balance) > UNBALANCED:
        yield (
            f"{label}: {balance:+.0%} of the film's heat is not carried off in the revolutions "
            "that are read, as it still warms in the first of them: try more, and a larger settle"
        )


def _outside(result: Result, name: str, joint: LubricatedJoint) -> Iterator[str]:
    """Yield where the laws of the oil do not hold."""
    oil, label = joint.film.oil, name.replace("_", " ")
    assert oil is not None and joint.film.length is not None
    now = float(result[f"{name}_temperature"][-1])
    low, high = oil.at_celsius
    if not low <= now <= high:
        yield (
            f"{label}: the film is at {now:.1f} deg C; its viscosity is extrapolated beyond the "
            f"points of film.oil at {low:g} and {high:g} deg C"
        )
    if oil.pressure_viscosity is not None:
        area = 2.0 * joint.radius * joint.film.length
        peak = float(lengths(result[f"{name}_force"]).max()) / area
        ratio = oil.viscosity(now, peak) / float(result[f"{name}_viscosity"][-1])
        if ratio > THICKER:
            yield (
                f"{label}: under the largest force, {peak / 1e6:.3g} MPa, the oil would be "
                f"{ratio:.2g} times as thick as the run has it, with the mean pressure of a "
                "revolution"
            )


def _has_warming_oil(scene: Scene, joint: str) -> bool:
    """Return whether a joint's oil warms."""
    return oil_of(scene.joints[joint]) is not None


def film_balance(run: Reading, joint: str) -> float | None:
    """Return the residual of a film's heat balance, over the dissipated heat.

    Over whole revolutions; None without one.
    """
    heat, off = run.rate(run[f"{joint}_loss"]), run.rate(run[f"{joint}_carried_off"])
    if heat is None or off is None:
        return None
    return (heat - off) / heat if heat else 0.0


def film_change(run: Reading, joint: str) -> float | None:
    """Return by how much a film would go on warming after the last revolution, K."""
    films = run.run.info.get("state", {}).get("films", {})
    last = float(run.run[f"{joint}_temperature"][-1])
    return films[joint][0] - last if joint in films else None


OIL = (
    Quantity("film.temperature", "deg C", "temperature of the film in the last revolution",
             LOAD, lambda run, joint: float(run[f"{joint}_temperature"][-1]), Owner.JOINT,
             _has_warming_oil, title="film temperature", law_error=temperature_error),
    Quantity("film.viscosity", "Pa s", "viscosity of the oil in the film in the last revolution",
             LOAD, lambda run, joint: float(run[f"{joint}_viscosity"][-1]), Owner.JOINT,
             _has_warming_oil,
             title="viscosity there", display_unit="mPa s", is_detail=True,
             law_error=viscosity_error),
    Quantity("film.side_flow", "m^3/s",
             "oil that leaves the bearing's ends, mean over whole revolutions",
             LOAD, lambda run, joint: run.mean(run[f"{joint}_side_flow"]), Owner.JOINT,
             _has_warming_oil, law_error=side_flow_error),
    Quantity("film.carried_off", "W",
             "heat that side flow and frame take off, mean over whole revolutions",
             LOAD, lambda run, joint: run.rate(run[f"{joint}_carried_off"]), Owner.JOINT,
             _has_warming_oil, signed=True, law_error=film_error),
    Quantity("film.residual", "",
             "share of the dissipated heat that is not carried off, over whole revolutions",
             MEASURE, film_balance, Owner.JOINT, _has_warming_oil,
             signed=True),
    Quantity("film.change", "K",
             "change of the film's temperature that the heat of the last revolution asks for",
             MEASURE, film_change, Owner.JOINT, _has_warming_oil,
             signed=True),
)  # fmt: skip
