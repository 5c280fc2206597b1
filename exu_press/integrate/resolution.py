"""Whether a run's steps resolved its impacts: asked of its record, after its end.

A step of any size gets through an impact, and generalized-alpha is stable at all of them: the run
ends, its curves look smooth, and its peaks have the height that the step gives them. What tells is
how a peak is reached. Resolved, a force rises over several steps; where the largest force of the
run comes or goes within one step, its height is the step's.

So the figure is the largest change of an inertia force m |a| within one step, of any body, against
the largest inertia force of the run. Measured against a tolerance of 1e-5 on dry, lubricated and
mixed presses and slider-cranks of many clearances, speeds and dampings, steps of 1e-3 to 1e-5 s:
above 0.8 the joints' peak forces were off by 9 to 90 %, seldom less; between 0.65 and 0.8 by 2 to
17 %; below by 7 % at most.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from exu_press.joints import history, overlay_of
from exu_press.laws.contact import NormalContact
from exu_press.model import Model
from exu_press.scene.laws import contact_law

__all__ = ["Unresolved", "unresolved"]

Array = NDArray[np.float64]

LARGEST_JUMP = 0.65
"""Of an inertia force within one step, relative to the run's largest one."""

STEPS_IN_A_PULSE = 5.0
"""So many fixed steps in the rise and in the fall of a blanking pulse: its peak, which may lie
between two of them, is then missed by a tenth at most."""

STEPS_IN_A_RISE = 3.0
"""So many steps from first touch to the largest force resolve it to some percent."""


@dataclass(frozen=True)
class Unresolved:
    """The worst step of a run that its steps do not resolve.

    Attributes:
        time: where the step ends, s.
        what: it leaps over, in words.
        step_needed: that would resolve the run, s.
    """

    time: float
    what: str
    step_needed: float


def unresolved(model: Model) -> Unresolved | None:
    """Return the worst step of an integrated model, or None if its steps resolved the motion."""
    time, forces = _inertia_forces(model)
    if len(time) < 3:
        return None
    return _leapt_over_impact(model, time, forces) or _leapt_over_pulse(model)


def _leapt_over_impact(model: Model, time: Array, forces: dict[str, Array]) -> Unresolved | None:
    """Return the step with the largest change of an inertia force, if it is too large."""
    solver = model.scene.solver
    assert solver is not None
    # A stiff film that starts from rest makes the accelerations ring; the ringing is not an impact.
    ring = solver.spectral_radius ** np.arange(len(time))
    jumps, largest = {}, 0.0
    for body, force in forces.items():
        jump = np.linalg.norm(np.diff(force, axis=0), axis=1)
        started = 2.0 * jump[0]
        jumps[body] = np.maximum(jump - started * ring[:-1], 0.0)
        rest = np.linalg.norm(force, axis=1) - started * ring
        largest = max(largest, float(rest.max()))
    if largest <= 0.0:
        return None
    body = max(jumps, key=lambda name: float(jumps[name].max()))
    at = int(np.argmax(jumps[body]))
    relative = float(jumps[body][at]) / largest
    if relative <= LARGEST_JUMP:
        return None
    step = float(time[at + 1] - time[at])
    return Unresolved(
        time=float(time[at + 1]),
        what=f"{relative:.0%} of the largest inertia force ({body}) within a step of {step:.2g} s",
        step_needed=_rounded_down(min([0.5 * step, *_impact_steps(model, time)])),
    )


def _leapt_over_pulse(model: Model) -> Unresolved | None:
    """Return the first blanking pulse that is too short for a fixed step.

    Steps by tolerance end on a pulse's corners.
    """
    solver, pulse = model.scene.solver, model.scene.blanking
    assert solver is not None
    if solver.step is None or pulse is None:
        return None
    shortest, begin = min(pulse.rise, pulse.fall), model.next_corner(0.0)
    if begin >= model.scene.duration or solver.step <= shortest / STEPS_IN_A_PULSE * (1.0 + 1e-9):
        return None
    return Unresolved(
        time=begin,
        what=f"steps of {solver.step:.2g} s in a blanking pulse with an edge of {shortest:.2g} s",
        step_needed=_rounded_down(shortest / STEPS_IN_A_PULSE),
    )


def _inertia_forces(model: Model) -> tuple[Array, dict[str, Array]]:
    """Return the recorded instants, (n,), and what accelerates the rigid bodies, (n, 3), N.

    Of bodies whose accelerations were recorded.

    The angle's counts over the radius of gyration, so that the norm is the kinetic one. The crank
    is driven at constant speed.
    """
    found = {}
    time = np.zeros(0)
    for body in model.mechanism.bodies:
        recorded = (body.name, "acceleration") in model.sensors
        if not recorded or body.name in model.parts or body.name == model.mechanism.crank:
            continue
        q, q_t, q_tt = (
            np.asarray(model.mbs.GetSensorStoredData(model.sensors[body.name, level]))
            for level in ("position", "velocity", "acceleration")
        )
        time = q[:, 0]
        motion = model.rigid[body.name].motion(q[:, 1:], q_t[:, 1:], q_tt[:, 1:])
        root = math.sqrt(body.inertia * body.mass)
        found[body.name] = motion.acceleration * (body.mass, body.mass, root)
    return time, found


def _impact_steps(model: Model, time: Array) -> Iterator[float]:
    """Yield the steps that resolve the fastest impact of every joint whose surfaces may touch, s.

    The impact of the lighter body alone: what hangs on it makes the true one slower.
    """
    scene = model.scene
    if scene.contact is None or not model.clearance_joints:
        return
    overlay = overlay_of(model.mbs)
    held = {number: name for name, number in model.nodes.items()}
    masses = {body.name: body.mass for body in model.mechanism.bodies}
    masses[model.mechanism.crank] = math.inf  # driven
    q, q_t = (
        np.hstack(
            [
                np.asarray(model.mbs.GetSensorStoredData(model.sensors[held[node], level]))[:, 1:]
                for node in overlay.nodes
            ]
        )
        for level in ("position", "velocity")
    )
    for description in model.mechanism.joints:
        joint = model.clearance_joints.get(description.name)
        if joint is None or (description.kind == "lubricated" and scene.friction is None):
            continue
        states = history(joint, time, q, q_t)
        apart = np.array([state.eccentricity for state in states])
        moving = np.array([state.velocity for state in states])
        distance = np.linalg.norm(apart, axis=1)
        closing = (apart * moving).sum(axis=1) / np.maximum(distance, 1e-300)
        free = distance <= joint.clearance
        touches = free[:-1] & ~free[1:]
        speed = float(closing[:-1][touches].max(initial=0.0))
        if speed > 0.0:
            law = contact_law(scene.contact, joint.clearance, revolute=not description.spherical)
            mass = min(masses[description.journal], masses[description.bearing])
            yield _rise_time(law, mass, speed) / STEPS_IN_A_RISE


def _rise_time(contact: NormalContact, mass: float, speed: float) -> float:
    """Return how long it takes from first touch to the largest force, s.

    Args:
        contact: law of the normal force.
        mass: of a free body, kg.
        speed: at which it arrives, m/s.
    """
    from scipy.integrate import solve_ivp  # type: ignore[import-untyped, unused-ignore]

    def motion(_time: float, state: Array) -> list[float]:
        return [state[1], -contact.force(state[0], state[1], speed)[0] / mass]

    def stopped(_time: float, state: Array) -> float:
        return float(state[1])

    stopped.terminal = True  # type: ignore[attr-defined]
    impact = solve_ivp(
        motion,
        (0.0, 1.0),
        (0.0, speed),
        "LSODA",
        events=stopped,
        rtol=1e-6,
        atol=(1e-15, 1e-9 * speed),
    )
    forces = [contact.force(d, v, speed)[0] for d, v in impact.y.T]
    return float(impact.t[int(np.argmax(forces))])


def _rounded_down(value: float) -> float:
    """Return a value with one digit, not above it."""
    power = 10.0 ** math.floor(math.log10(value))
    return math.floor(value / power * (1.0 + 1e-9)) * power
