"""Solve a scene's model: what the scene asks for, in the integrator's terms, and its words."""

import dataclasses
import math
from collections.abc import Iterator, Mapping
from typing import Protocol

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.integrate import Advice, Outcome, Scales, Status, Tuning, solve_dynamic
from exu_press.integrate.outcome import Unresolved
from exu_press.integrate.problem import Problem
from exu_press.joints import history, overlay_of
from exu_press.joints.joint import ClearanceJoint
from exu_press.laws.contact import NormalContact
from exu_press.mechanism import GROUND, Mechanism
from exu_press.mechanism.holding import Holding
from exu_press.scene import IdealJoint, LubricatedJoint, Scene, mechanism_of
from exu_press.scene.applied import applied_loads
from exu_press.scene.laws import contact_law
from exu_press.scene.warnings import doubtful_sizes

__all__ = ["DEFAULTS", "Assembled", "largest_step", "scales", "settings_for", "solve"]

Array = NDArray[np.float64]

DEFAULTS = Tuning()

FALL = 0.03
"""Of free fall's acceleration, what counts as usual at least where there is clearance: parts fall
through it, however slowly the crank turns. Asked for less (below 30 rpm), Newton's method iterates
on what rounding leaves: at 0.01 rpm a hundred times for each step of 1e-4 s."""

THIN = 1e-6
"""m; the damping of a film of 1e-7 m, 1e17 N s/m, makes 10 N of a speed's last digit."""

WIDE_CIRCLE = 0.3
"""Of the friction circle's radius, in crank radii."""

STEPS_IN_AN_EDGE = 5.0
"""So many fixed steps in the steepest edge of a load: a peak, which may lie between two of them, is
then missed by a tenth at most."""

STEPS_IN_A_RISE = 3.0
"""So many steps from first touch to the largest force resolve it to some percent."""


class Assembled(Protocol):
    """What solving needs of a scene's model; `exu_press.model.Model` is one."""

    @property
    def scene(self) -> Scene:
        """What was asked."""

    @property
    def mechanism(self) -> Mechanism:
        """Bodies, joints and guides."""

    @property
    def holding(self) -> Holding:
        """Which ideal joints and guides hold what."""

    @property
    def mbs(self) -> exu.MainSystem:
        """Exudyn's main system, assembled."""

    @property
    def nodes(self) -> Mapping[str, int]:
        """Name -> node number."""

    @property
    def clearance_joints(self) -> Mapping[str, ClearanceJoint]:
        """Name -> joint."""

    @property
    def ways(self) -> Mapping[str, tuple[ClearanceJoint, ClearanceJoint]]:
        """Name of a body with play in its guide -> the contacts of its two ends."""

    @property
    def sensors(self) -> Mapping[tuple[str, str], int]:
        """(name, quantity) -> sensor number."""

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a load has a corner, s, or infinity."""


def solve(model: Assembled, *, tuning: Tuning = DEFAULTS, quiet: bool = True) -> Outcome:
    """Run a model to its end time or to an early stop; what was computed stays in its sensors.

    Args:
        model: of a scene; items that were added to `model.mbs` and assembled take part.
        tuning: the numbers of step control, to vary them.
        quiet: False shows the progress on standard error.
    """
    scene = model.scene
    solver = scene.solver
    assert solver is not None
    masses = {body.name: body.mass for body in model.mechanism.bodies}
    outcome = solve_dynamic(
        model.mbs,
        settings_for(scene, twice=model.holding.twice),
        tolerance=solver.tolerance,
        scales=scales(scene),
        next_corner=model.next_corner,
        # modes and drive: no say
        bodies={node: (name, masses.get(name, math.inf)) for name, node in model.nodes.items()},
        advice=lambda problem, by_tolerance: SceneAdvice(model, problem, by_tolerance),
        tuning=tuning,
        max_steps=solver.max_steps,
        quiet=quiet,
    )
    leapt = _leapt_over_load(model) if outcome.status is Status.COMPLETED else ""
    if leapt:
        return dataclasses.replace(outcome, status=Status.UNDER_RESOLVED, reason=leapt)
    return outcome


def settings_for(scene: Scene, *, twice: bool = False) -> exu.SimulationSettings:
    """Return Exudyn's settings of a scene, for constraints some of which may be redundant.

    A fixed step is the largest one not above `solver.step` that divides the run's duration.
    """
    solver = scene.solver
    assert solver is not None
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    steps = math.ceil(scene.duration / largest_step(scene) * (1.0 - 1e-12))
    integration.numberOfSteps = max(1, steps)
    integration.endTime = scene.duration
    integration.minimumStepSize = solver.min_step
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = solver.spectral_radius
    # For the 20 to 160 unknowns here no slower than the sparse one, and its matrix is read at once.
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.linearSolver.ignoreSingularJacobian = twice
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 0.0  # every step
    return settings


def largest_step(scene: Scene) -> float:
    """Return the fixed step, or the largest one that a tolerance may lead to, s."""
    solver = scene.solver
    assert solver is not None
    return solver.step or math.radians(solver.max_step_deg) / scene.angular_speed


def scales(scene: Scene) -> Scales:
    """Return the crank pin's speed, and what its acceleration takes of all bodies.

    With a slow crank, the speed at which a journal has fallen through its clearance.
    """
    mechanism = mechanism_of(scene)
    play = 0.0 if scene.guide is None else scene.guide.clearance or 0.0
    widest = max([play, *(joint.clearance for joint in scene.joints.values())])
    usual = scene.angular_speed * scene.pin_speed
    return Scales(
        speed=max(scene.pin_speed, math.sqrt(4.0 * scene.gravity * widest)),
        force=sum(body.mass for body in mechanism.bodies)
        * max(usual, FALL * scene.gravity if widest else 0.0),
    )


class SceneAdvice(Advice):
    """The scene's words: crank angles, and the keys to change."""

    def __init__(self, model: Assembled, problem: Problem, by_tolerance: bool) -> None:
        """Speak of a scene's model."""
        super().__init__(problem, by_tolerance)
        self._model, self._scene = model, model.scene

    @property
    def setting(self) -> str:
        """What makes steps larger or smaller."""
        return f"solver.{super().setting}"

    def place(self, time: float) -> str:
        """Return time and crank angle."""
        scene = self._scene
        if scene.drive is not None:  # the angle is not known from the time
            return super().place(time)
        degrees = math.degrees(scene.start_angle + scene.angular_speed * time) % 360.0
        return f"{super().place(time)}, crank angle {degrees:.2f} deg"

    def joint(self, joint: ClearanceJoint) -> str:
        """Return a joint's name."""
        for body, ends in self._model.ways.items():
            if joint in ends:
                return f"{body}'s guide"
        return next(n for n, other in self._model.clearance_joints.items() if other is joint)

    def film(self) -> str:
        """Return what helps a film that broke down."""
        slips = self._slips()
        thicker = "film.at_contact = 'mixed', or a larger film.viscosity or film.length"
        return f"what was meant instead of this: {slips}" if slips else thicker

    def smallest(self) -> str:
        """Return what helps where steps became too small."""
        return "a larger solver.tolerance or a smaller solver.min_step"

    def budget(self) -> str:
        """Return what helps where too many steps were needed."""
        return f"fewer revolutions, a larger {self.setting} or solver.max_steps"

    def cause(self) -> str:
        """Return that the pin seizes, a film is too thin or a size hardly meant, or nothing."""
        slips = self._slips()
        return self._seizing() + self._thin_film() + (f"; hardly meant: {slips}" if slips else "")

    def resolution(self, worst: Unresolved) -> str:
        """Return the step or the tolerance that resolves the impacts."""
        solver = self._scene.solver
        assert solver is not None
        if solver.tolerance is not None:
            return f"solver.tolerance = {0.1 * solver.tolerance:.0e}"
        needed = min([0.5 * worst.step, *_impact_steps(self._model)])
        return f"solver.step = {_rounded_down(needed):.0e}"

    def _slips(self) -> str:
        """Return in words that a size is hardly meant, or nothing."""
        return "; ".join(slip.partition(". ")[0] for slip in doubtful_sizes(self._scene))

    def _seizing(self) -> str:
        """Return in words which pin of the crank has a friction circle wide enough to seize.

        Near dead centre the rod's force passes within it: friction then holds the pin fast,
        whatever the force, and a crank that turns at constant speed makes it grow without bound.
        """
        scene = self._scene
        for name, radius in mechanism_of(scene).crank_pins.items():
            pin = scene.joints[name]
            if isinstance(pin, IdealJoint) or pin.friction is None or pin.friction.law == "none":
                continue
            circle = pin.radius * math.sin(math.atan(pin.friction.mu_static))
            if circle >= WIDE_CIRCLE * radius:
                return (
                    f"; the {name.replace('_', ' ')} seizes near dead centre (friction circle "
                    f"{circle:.2g} m, crank radius {radius:.2g} m): try a smaller "
                    f"friction.mu_static or joints.{name}.radius"
                )
        return ""

    def _thin_film(self) -> str:
        """Return in words that a film is so thin that rounding moves its forces, or nothing."""
        for name, joint in self._scene.joints.with_clearance.items():
            if isinstance(joint, LubricatedJoint) and joint.clearance < THIN:
                return (
                    "; a film this thin is too stiff for rounded speeds: try a larger "
                    f"joints.{name}.clearance"
                )
        return ""


def _leapt_over_load(model: Assembled) -> str:
    """Return in words that fixed steps are too long for a load, or nothing.

    Steps by tolerance end on its corners.
    """
    scene, solver = model.scene, model.scene.solver
    if solver is None or solver.step is None:
        return ""
    edges = {name: load.shortest_edge(scene) for name, load in applied_loads(scene).items()}
    name = min(edges, key=edges.__getitem__, default="")
    begin = model.next_corner(0.0)
    if not name or begin >= scene.duration:
        return ""
    shortest = edges[name]
    if solver.step <= shortest / STEPS_IN_AN_EDGE * (1.0 + 1e-9):
        return ""
    advice = SceneAdvice(model, Problem.of(model.mbs, None), False)
    return (
        f"under-resolved {advice.place(begin)}: steps of {solver.step:.2g} s in load.{name} with "
        f"an edge of {shortest:.2g} s; peaks are the step's; try solver.step = "
        f"{_rounded_down(shortest / STEPS_IN_AN_EDGE):.0e}"
    )


def _impact_steps(model: Assembled) -> Iterator[float]:
    """Yield the steps that resolve the fastest impact of every joint whose surfaces may touch, s.

    The impact of the lighter body alone: what hangs on it makes the true one slower.
    """
    scene = model.scene
    if not any(joint.reach < math.inf for joint in model.clearance_joints.values()):
        return
    overlay = overlay_of(model.mbs)
    held = {number: name for name, number in model.nodes.items()}
    masses = {body.name: body.mass for body in model.mechanism.bodies} | {GROUND: math.inf}
    if model.mechanism.crank in model.holding.pivoted:
        masses[model.mechanism.crank] = math.inf  # driven
    sensor = next(iter(model.sensors.values()))
    time = np.asarray(model.mbs.GetSensorStoredData(sensor))[:, 0]
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
        joint, kind = model.clearance_joints.get(description.name), scene.joints[description.name]
        if joint is None or isinstance(kind, IdealJoint) or kind.contact is None:
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
            law = contact_law(kind.contact, joint.clearance, revolute=not description.spherical)
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
