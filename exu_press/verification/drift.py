"""Readings that show how quantities still change from revolution to revolution as oil warms."""

import numpy as np

from exu_press.result import Result
from exu_press.result.windows import up_to
from exu_press.scene.joint import oil_of

__all__ = ["read_a_revolution_earlier", "with_next_temperatures"]


def read_a_revolution_earlier(run: Result) -> Result:
    """Return a run that ends a revolution earlier, where oil warms.

    Changes that halve with each revolution add up to no more than the last one. A run without
    settling is returned as it is.
    """
    scene, angle = run.scene, run["crank_angle"]
    if not scene.warms or scene.settled < 1.0 or scene.revolutions - scene.settled < 1.0:
        return run
    last = float(np.interp(angle[-1] - 2.0 * np.pi, angle, run.time))
    changes = {"revolutions": scene.revolutions - 1.0, "settle": scene.settled - 1.0}
    shortened = up_to(run, last)
    object.__setattr__(shortened, "scene", scene.replace(changes))  # a copy that nobody else has
    return shortened


def with_next_temperatures(run: Result) -> Result:
    """Return a run whose films have the temperatures of the next revolution.

    They are extrapolated from the last two revolutions (`exu_press.model.warm_film`).
    """
    films = run.info.get("state", {}).get("films", {})
    values = {}
    for name, (temperature, pressure) in films.items():
        oil, channel = oil_of(run.scene.joints[name]), f"{name}_temperature"
        assert oil is not None
        recorded = run[channel]
        change = temperature - float(recorded[-1])
        viscosity_ratio = oil.viscosity(temperature, pressure) / float(run[f"{name}_viscosity"][-1])
        values[channel] = recorded + change
        values[f"{name}_viscosity"] = run[f"{name}_viscosity"] * viscosity_ratio
    return run.with_values(values) if values else run
