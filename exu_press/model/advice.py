"""Advice for a run that stops early: crank angles, and the keys to change."""

import math
from collections.abc import Iterator

from exu_press.integrate import Advice, Outcome
from exu_press.integrate.resolution import UnresolvedImpact
from exu_press.integrate.system import System as ExudynSystem
from exu_press.integrate.task import Task
from exu_press.joints.joint import ClearanceJoint
from exu_press.model.system import System
from exu_press.scene import LubricatedJoint, mechanism_of
from exu_press.scene.joint import TouchingJoint

__all__ = ["SceneAdvice", "leapt_over_load"]

THIN = 1e-6
"""m; the damping of a film of 1e-7 m, 1e17 N s/m, makes 10 N of a speed's last digit."""

WIDE_CIRCLE = 0.3
"""Radius of a wide friction circle, in crank radii."""

VANISHED = 1e-3
"""Share of a spring's length or of its gas' volume in the drawing that is as good as none."""

STEPS_IN_AN_EDGE = 5.0
"""So many fixed steps in the steepest edge of a load: a peak, which may lie between two of them, is
then missed by a tenth at most."""


class SceneAdvice(Advice):
    """The scene's words: crank angles, and the keys to change."""

    def __init__(self, model: System, system: ExudynSystem, by_tolerance: bool) -> None:
        super().__init__(system, by_tolerance)
        self._model, self._scene = model, model.scene

    def about_outcome(self, outcome: Outcome) -> Iterator[str]:
        """Say nothing: the result tells how its run ended."""
        return iter(())

    def about_start(self, task: Task, changes: tuple[float, float]) -> Iterator[str]:
        """Say nothing: a scene's start fits, but where it goes on with another geometry."""
        return iter(())

    @property
    def setting(self) -> str:
        """The keys that make steps larger or smaller."""
        return f"solver.{super().setting}"

    def location(self, time: float) -> str:
        """Return time and crank angle."""
        scene = self._scene
        if scene.drive is not None:  # the angle is not known from the time
            return super().location(time)
        angle = scene.start_angle + scene.angular_speed * time + self._model.ahead[0]
        return f"{super().location(time)}, crank angle {math.degrees(angle) % 360.0:.2f} deg"

    def joint(self, joint: ClearanceJoint) -> str:
        """Return a joint's name."""
        for body, ends in self._model.guideways.items():
            if joint in ends:
                return f"{body}'s guide"
        return next(n for n, own in self._model.clearance_joints.items() if own is joint)

    def film(self) -> str:
        """Return the cure of a film that broke down."""
        inclined = any(
            joint.film is not None and joint.film.law.inclination
            for joint in self._scene.joints.values()
        )
        first = "a smaller film.tilt" if inclined else "film.at_contact = 'mixed'"
        return self._slips_or(f"{first}, or a larger film.viscosity or film.length")

    def smallest(self) -> str:
        """Return the cure where steps became too small."""
        return self._slips_or("a larger solver.tolerance or a smaller solver.min_step")

    def budget(self) -> str:
        """Return the cure where too many steps were needed."""
        larger = f"fewer revolutions, a larger {self.setting} or solver.max_steps"
        return self._slips_or(larger)

    def convergence(self) -> str:
        """Return the cure where Newton's method did not converge."""
        return self._slips_or(super().convergence())

    def redundancy(self, redundant: int) -> str:
        """Return the cure where so many constraints are redundant."""
        say = "constraints say" if redundant > 1 else "constraint says"
        here = f"{redundant} {say} the same as others where the mechanism is"
        return f"{here}; try {self.convergence()}"

    def stiff(self, joint: ClearanceJoint) -> str:
        """Return the keys of a guide or of a joint that make it need small steps."""
        scene = self._scene
        for name, ends in self._model.guideways.items():
            if joint in ends:
                clearance = scene.guide_key(name, "clearance")
                if joint.lubricated:
                    return f" ({scene.guide_key(name, 'viscosity')}, {clearance})"
                law = scene.guides[name].friction.kind
                return f" ({scene.guide_key(name, 'friction')} = {law!r}, {clearance})"
        if scene.friction and "law" in scene.friction and not joint.lubricated:
            return f" (friction.law = {scene.friction['law']!r}, contact)"
        return " (viscosity of the film, clearance)" if joint.lubricated else " (contact)"

    def cause(self) -> str:
        """Return that the pin seizes or a film is too thin, or nothing."""
        return self._seizing() + self._thin_film()

    def resolution(self, worst: UnresolvedImpact) -> str:
        """Return the step or the tolerance that resolves the impacts."""
        solver = self._scene.solver
        if solver.tolerance is not None:
            return f"solver.tolerance = {0.1 * solver.tolerance:.0e}"
        from exu_press.model.impact_steps import impact_steps

        needed = min([0.5 * worst.step, *impact_steps(self._model)])
        return f"solver.step = {_rounded_down(needed):.0e}"

    def _slips_or(self, cure: str) -> str:
        """Return that another size is the cure where one is hardly meant, or the usual cure."""
        for spring in self._model.mechanism.springs:
            ends = self._model.mbs.GetSensorValues(
                self._model.sensors[f"spring_{spring.name}", "ends"]
            )
            if reason := spring.why_impossible(math.hypot(*ends), VANISHED):
                return f"another spring, as springs.{spring.name} {reason}"
        from exu_press.scene.warnings import doubtful_sizes

        slips = "; ".join(slip.partition(". ")[0] for slip in doubtful_sizes(self._scene))
        return f"another value, as this one is hardly meant: {slips}" if slips else cure

    def _seizing(self) -> str:
        """Return in words which pin of the crank has a friction circle wide enough to seize.

        Near dead centre the rod's force passes within it: friction then holds the pin fast,
        whatever the force, and a crank that turns at constant speed makes it grow without bound.
        """
        scene = self._scene
        for name, radius in mechanism_of(scene).crank_pins.items():
            pin = scene.joints[name]
            law = None if pin.friction is None else pin.friction.law
            if law is None or not isinstance(pin, TouchingJoint) or not law.largest_coefficient:
                continue
            largest = law.largest_coefficient
            circle = pin.radius * math.sin(math.atan(getattr(law, largest)))
            if circle >= WIDE_CIRCLE * radius:
                return (
                    f"; the {name.replace('_', ' ')} seizes near dead centre (friction circle "
                    f"{circle:.2g} m, crank radius {radius:.2g} m): try a smaller "
                    f"friction.{largest} or joints.{name}.radius"
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


def leapt_over_load(model: System, begin: float) -> str:
    """Return in words that fixed steps are too long for a load, or nothing.

    Steps by tolerance end on its corners, of which the first one is at `begin`, s.
    """
    scene, solver = model.scene, model.scene.solver
    if solver.step is None:
        return ""
    edges = {
        name: load.shortest_edge(model.mechanism, scene.angular_speed)
        for name, load in scene.applied_loads.items()
    }
    name = min(edges, key=edges.__getitem__, default="")
    if not name or begin >= scene.duration:
        return ""
    shortest = edges[name]
    if solver.step <= shortest / STEPS_IN_AN_EDGE * (1.0 + 1e-9):
        return ""
    advice = SceneAdvice(model, ExudynSystem.of_mbs(model.mbs, None), False)
    return (
        f"under-resolved {advice.location(begin)}: steps of {solver.step:.2g} s in load.{name} "
        f"with an edge of {shortest:.2g} s; peaks are the step's; try solver.step = "
        f"{_rounded_down(shortest / STEPS_IN_AN_EDGE):.0e}"
    )


def _rounded_down(value: float) -> float:
    """Return a value with one digit, not above it."""
    power = 10.0 ** math.floor(math.log10(value))
    return math.floor(value / power * (1.0 + 1e-9)) * power
