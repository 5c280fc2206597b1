"""One value of the key: the long run there, from its own start or from where the last one ended."""

import math
from typing import Any

import numpy as np

from exu_press.model.state import State
from exu_press.scene import Scene
from exu_press.studies.attractor import attractor

__all__ = ["carried", "run_point"]


def carried(state: State, before: float, now: float) -> State:
    """Return a state on the section at another speed of the crank.

    The crank's angle is its speed times the time; all speeds go with it, so that they still fit
    the constraints.

    Args:
        state: on the section.
        before: speed at which it was found, in any unit.
        now: likewise.
    """
    ratio = now / before
    q, q_t, *others = state["coordinates"]
    return {
        **state,
        "time": state["time"] / ratio,
        "step": state["step"] / ratio,
        "coordinates": [q, (ratio * np.array(q_t)).tolist(), *others],
        "accelerations": (ratio**2 * np.array(state["accelerations"])).tolist(),
    }


def run_point(arguments: dict[str, Any]) -> dict[str, Any]:
    """Return what one value of the key leads to.

    Args:
        arguments: "scene", "skip", "revolutions", "longest", and "start": a state on the section,
            and "speed", the one at which it was found; or None.

    Returns:
        status, reason, points (n, k), period (None where there is none), told, in_words, error,
        exponent: [value, low or None, high] per revolution, motion, state.
    """
    scene, start = Scene.from_dict(arguments["scene"]), arguments["start"]
    if start is not None:
        start = carried(start, arguments["speed"], scene.speed_rpm)
    found = attractor(
        scene,
        revolutions=arguments["revolutions"],
        skip=arguments["skip"],
        most=arguments["longest"],
        start=start,
    )
    low = found.exponent.low
    return {
        "status": "completed",
        "reason": "",
        "points": found.points.tolist(),
        "period": found.period.revolutions,
        "told": found.period.told,
        "in_words": str(found.period),
        "finer": found.period.finer,
        "error": found.error,
        "exponent": [
            found.exponent.value,
            low if math.isfinite(low) else None,
            found.exponent.high,
        ],
        "motion": found.exponent.sign,
        "state": found.state,
    }
