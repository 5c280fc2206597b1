"""The error of figures that change from revolution to revolution, as oil warms."""

import numpy as np

from exu_press.result import Result
from exu_press.result.windows import up_to
from exu_press.scene.joint import oil_of

__all__ = ["earlier", "warmed_on"]


def earlier(run: Result) -> Result:
    """Return a run whose figures are read a revolution earlier, where oil warms.

    Changes that shrink by half or more each revolution add up to no more than the last one. A run
    that has nothing to settle cannot be read earlier, and is returned as it is.
    """
    scene, angle = run.scene, run["crank_angle"]
    if not scene.warms or scene.settled < 1.0 or scene.revolutions - scene.settled < 1.0:
        return run
    last = float(np.interp(angle[-1] - 2.0 * np.pi, angle, run.time))
    sooner = {"revolutions": scene.revolutions - 1.0, "settle": scene.settled - 1.0}
    before = up_to(run, last)
    object.__setattr__(before, "scene", scene.replace(sooner))  # a copy that nobody else has
    return before


def warmed_on(run: Result) -> Result:
    """Return a run whose films have the temperatures that the heat of the last revolution asks for.

    These are foretold from the changes of the last two revolutions (`exu_press.model.warm_film`).
    """
    films = run.info.get("state", {}).get("films", {})
    changed = {}
    for name, (temperature, pressure) in films.items():
        oil, channel = oil_of(run.scene.joints[name]), f"{name}_temperature"
        assert oil is not None
        now = run[channel]
        change = temperature - float(now[-1])
        thinner = oil.viscosity(temperature, pressure) / float(run[f"{name}_viscosity"][-1])
        changed[channel] = now + change
        changed[f"{name}_viscosity"] = run[f"{name}_viscosity"] * thinner
    return run.with_values(changed) if changed else run
