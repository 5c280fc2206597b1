"""Fixed steps that resolve the impacts of a run."""

import math
from collections.abc import Iterator

import numpy as np

from exu_press.joints.history import history
from exu_press.laws.contact import NormalContact
from exu_press.mechanism import GROUND
from exu_press.model.system import System
from exu_press.numerics.arrays import Array, lengths
from exu_press.scene.joint import TouchingJoint

__all__ = ["impact_steps"]

STEPS_IN_A_RISE = 3.0
"""So many steps from first touch to the largest force resolve it to some percent."""


def impact_steps(model: System) -> Iterator[float]:
    """Yield the steps that resolve the fastest impact of every joint whose surfaces may touch, s.

    The impact of the lighter body alone: bodies that hang on it make the true one slower.
    """
    scene = model.scene
    if not any(joint.contact_onset < math.inf for joint in model.clearance_joints.values()):
        return
    masses = {body.name: body.mass for body in model.mechanism.bodies} | {GROUND: math.inf}
    if model.mechanism.crank in model.constraints.pivots:
        masses[model.mechanism.crank] = math.inf  # driven
    sensor = next(iter(model.sensors.values()))
    time = np.asarray(model.mbs.GetSensorStoredData(sensor))[:, 0]
    for description in model.mechanism.joints:
        joint, kind = model.clearance_joints.get(description.name), scene.joints[description.name]
        if joint is None or not isinstance(kind, TouchingJoint):
            continue
        law = kind.normal_contact(scene.angular_speed)
        if law is None:
            continue
        states = history(model.states, joint, time)
        apart, moving = states.eccentricity, states.velocity
        distance = lengths(apart)
        closing = (apart * moving).sum(axis=1) / np.maximum(distance, 1e-300)
        free = distance <= joint.clearance
        touches = free[:-1] & ~free[1:]
        speed = float(closing[:-1][touches].max(initial=0.0))
        if speed > 0.0:
            mass = min(masses[description.journal], masses[description.bearing])
            yield _rise_time(law, mass, speed) / STEPS_IN_A_RISE


def _rise_time(contact: NormalContact, mass: float, speed: float) -> float:
    """Return how long a free mass that arrives takes from first touch to the largest force, s."""
    from scipy.integrate import solve_ivp  # type: ignore[import-untyped, unused-ignore]

    def motion(_time: float, state: Array) -> list[float]:
        return [state[1], -contact.force(state[0], state[1], speed)[0] / mass]

    def deepest_penetration(_time: float, state: Array) -> float:
        return float(state[1])

    deepest_penetration.terminal = True  # type: ignore[attr-defined]
    impact = solve_ivp(
        motion,
        (0.0, 1.0),
        (0.0, speed),
        "LSODA",
        events=deepest_penetration,
        rtol=1e-6,
        atol=(1e-15, 1e-9 * speed),
    )
    forces = [contact.force(d, v, speed)[0] for d, v in impact.y.T]
    return float(impact.t[int(np.argmax(forces))])
