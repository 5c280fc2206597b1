"""The result of an integrated model: every recorder in turn."""

import functools
import importlib.metadata
import platform
from collections.abc import Mapping

from exu_press.integrate import Outcome
from exu_press.mechanism.parts import DRIVE
from exu_press.model import Model
from exu_press.model.state import state_of
from exu_press.result.info import Info
from exu_press.result.joints import joint_histories
from exu_press.result.motion import body_motion, sensor
from exu_press.result.recorders import recorders
from exu_press.result.recording import Record, Recording
from exu_press.result.result import Result
from exu_press.result.surface import surfaces_of

__all__ = ["record"]


def record(model: Model, outcome: Outcome) -> Result:
    """Return the result of an integrated model."""
    mechanism = model.mechanism
    time = sensor(model, mechanism.slider, "position", with_time=True)[:, 0]
    motions = {body.name: body_motion(model, body.name) for body in mechanism.bodies}
    turned = body_motion(model, DRIVE) if DRIVE in model.nodes else motions[mechanism.crank]
    histories, total = joint_histories(model, time), Record({})
    for recorder in recorders(flexible=bool(model.parts)):
        total += recorder.record(Recording(model, time, motions, turned, histories, total))
    info: Info = {**_info(model, outcome), **total.info}  # type: ignore[typeddict-item]
    return Result(
        scene=model.scene,
        channels=total.channels,
        info=info,
        bodies=tuple(motions),
        surfaces=surfaces_of(model.parts),
    )


def _info(model: Model, outcome: Outcome) -> Info:
    """Return status, statistics, sizes and versions."""
    mbs = model.mbs
    return {
        "status": outcome.status.value,
        "reason": outcome.reason,
        "end_time": outcome.end_time,
        "wall_time": outcome.wall_time,
        "steps": outcome.steps,
        "rejected_steps": outcome.rejected_steps,
        "newton_iterations": outcome.newton_iterations,
        "law_evaluations": outcome.law_evaluations,
        "own_items": model.own_items,
        "coordinates": mbs.systemData.ODE2Size(),
        "bodies": len(model.nodes),
        "connectors": mbs.systemData.NumberOfObjects() - len(model.nodes) - 1,
        "versions": dict(_versions()),
        "state": state_of(model),
    }


@functools.cache
def _versions() -> Mapping[str, str]:
    """Return the versions behind a result; looking them up takes a tenth of a short run."""
    packages = ("exu-press", "exudyn", "numpy", "scipy")
    found = {name: importlib.metadata.version(name) for name in packages}
    return {"python": platform.python_version(), **found}
