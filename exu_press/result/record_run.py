"""The result of an integrated model, from all recorders."""

import functools
import importlib.metadata
import platform
from collections.abc import Mapping
from typing import TYPE_CHECKING

from exu_press.integrate import Outcome
from exu_press.mechanism.parts import DRIVE
from exu_press.model import Model
from exu_press.model.continuation import state_of
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel, guide_channel
from exu_press.result.info import Info
from exu_press.result.motion import body_motion, sensor
from exu_press.result.recorders import recorders
from exu_press.result.recording import Record, Recording
from exu_press.result.result import Result

if TYPE_CHECKING:
    from exu_press.joints.history import JointHistory
    from exu_press.result.surface import Surface

__all__ = ["record"]


def record(model: Model, outcome: Outcome) -> Result:
    """Return the result of an integrated model."""
    mechanism = model.mechanism
    time = sensor(model, mechanism.slider, "position", with_time=True)[:, 0]
    motions = {body.name: body_motion(model, body.name) for body in mechanism.bodies}
    turned = body_motion(model, DRIVE) if DRIVE in model.nodes else motions[mechanism.crank]
    histories, total = _histories(model, time), Record({})
    for recorder in recorders(model.scene):
        total += recorder.record(Recording(model, time, motions, turned, histories, total))
    determined = _without_undetermined(model, total.channels)
    info: Info = {**_info(model, outcome), **total.info}  # type: ignore[typeddict-item]
    return Result(
        scene=model.scene,
        channels=determined,
        info=info,
        bodies=tuple(motions),
        surfaces=_surfaces(model),
    )


def _without_undetermined(model: Model, channels: Mapping[str, Channel]) -> dict[str, Channel]:
    """Return channels without forces that ideal constraints stress against each other.

    Their sums, as the force on the frame, are determined.
    """
    omitted = set()
    for constraint in model.constraints.undetermined:
        kind, _, name = constraint.partition(".")
        owner = {"gears": f"gear_{name}", "joints": name}.get(kind)
        owner = owner or guide_channel(model.mechanism, name)
        omitted |= {f"{owner}_{quantity}" for quantity in ("force", "moment", "torque")}
    return {name: channel for name, channel in channels.items() if name not in omitted}


def _histories(model: Model, time: Array) -> "Mapping[str, JointHistory]":
    """Return the states of the joints with clearance at the recorded instants."""
    if not model.clearance_joints:
        return {}
    from exu_press.result.joints import joint_histories

    return joint_histories(model, time)


def _surfaces(model: Model) -> "Mapping[str, Surface]":
    """Return the surfaces of the flexible bodies, by body."""
    if not model.parts:
        return {}
    from exu_press.result.surface import surfaces_of

    return surfaces_of(model.parts)


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
        "versions": dict(_versions(flexible=bool(model.parts))),
        "state": state_of(model),
    }


@functools.cache
def _versions(*, flexible: bool) -> Mapping[str, str]:
    """Return the versions of Python and packages; looking them up takes a tenth of a short run."""
    packages = ("exu-press", "exudyn", "numpy", "scipy", *(["ngsolve"] if flexible else []))
    installed = {name: importlib.metadata.version(name) for name in packages}
    return {"python": platform.python_version(), **installed}
