"""Quantities of films whose oil warms."""

from exu_press.quantities.kind import LOAD, MEASURE
from exu_press.quantities.quantity import Place, Quantity
from exu_press.quantities.reading import Reading
from exu_press.scene import Scene
from exu_press.scene.joint import oil_of

__all__ = ["OIL", "film_balance", "film_change"]


def _warm(scene: Scene, joint: str) -> bool:
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
             LOAD, lambda run, joint: float(run[f"{joint}_temperature"][-1]), Place.JOINT, _warm,
             title="film temperature"),
    Quantity("film.viscosity", "Pa s", "viscosity of the oil in the film in the last revolution",
             LOAD, lambda run, joint: float(run[f"{joint}_viscosity"][-1]), Place.JOINT, _warm,
             title="viscosity there", shown="mPa s", under=True),
    Quantity("film.side_flow", "m^3/s",
             "oil that leaves the bearing's ends, mean over whole revolutions",
             LOAD, lambda run, joint: run.mean(run[f"{joint}_side_flow"]), Place.JOINT, _warm),
    Quantity("film.carried_off", "W",
             "heat that side flow and frame take off, mean over whole revolutions",
             LOAD, lambda run, joint: run.rate(run[f"{joint}_carried_off"]), Place.JOINT, _warm,
             signed=True),
    Quantity("film.residual", "",
             "share of the dissipated heat that is not carried off, over whole revolutions",
             MEASURE, film_balance, Place.JOINT, _warm,
             signed=True),
    Quantity("film.change", "K",
             "change of the film's temperature that the heat of the last revolution asks for",
             MEASURE, film_change, Place.JOINT, _warm,
             signed=True),
)  # fmt: skip
