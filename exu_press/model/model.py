"""A scene's assembled system, and its run."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np

from exu_press.integrate import ARRIVED, Outcome, SolverStatus, SolverTuning, solve_dynamic
from exu_press.integrate.error import default_criteria
from exu_press.model.advice import SceneAdvice, leapt_over_load
from exu_press.model.constraints import CrankAngle
from exu_press.model.settings import scales, settings_for, spring_errors
from exu_press.model.system import System
from exu_press.scene import Scene
from exu_press.scene.holding_torque import holding_torque

if TYPE_CHECKING:
    from exu_press.joints.guide_friction import GuideFriction
    from exu_press.mechanism.section import Section
    from exu_press.model.loads import ActingLoad
    from exu_press.model.placed_part import PlacedPart
    from exu_press.model.stall import Stall
    from exu_press.model.start_stop import StartStop
    from exu_press.model.warm_film import WarmFilm

__all__ = ["Model", "count_items"]

DEFAULTS = SolverTuning()

CLOSE = 1e-9
"""rad: a sample that is as close counts as reached."""


class Model(System):
    """An assembled system, which a run takes to its end; attributes as of `System`, and these.

    Attributes:
        crank_angle: returns the crank's angle and angular velocity in the current state.
        start_stop: clutch, brake and their schedule, if there is a clutch.
        stall: detects that a press with a motor has stalled.
        loads: name -> acting load.
        guide_friction: name of a body in a guide without clearance -> its friction there.
        warm: name of a joint -> its film, whose oil warms.
        scene_items: number of objects and loads of the scene.
        begin: time of the start, s.
        first_step: s; 0.0 where the integration finds it.
        remembered: memory of the clocks, where the run continues another one.
        until: crank angle at which a run with a motor ends, rad; None: it runs to its end time.
    """

    crank_angle: CrankAngle
    scene_items: int

    def __init__(self, scene: Scene, parts: "Mapping[str, PlacedPart]") -> None:
        super().__init__(scene, parts)
        self.start_stop: StartStop | None = None
        self.stall: Stall | None = None
        self.loads: dict[str, ActingLoad] = {}
        self.guide_friction: dict[str, GuideFriction] = {}
        self.warm: Mapping[str, WarmFilm] = {}
        self.begin = self.first_step = 0.0
        self.remembered: tuple[tuple[float, float | None], ...] = ()
        self.until: float | None = None

    @property
    def own_items(self) -> int:
        """Number of objects and loads that the user has added."""
        return count_items(self.mbs) - self.scene_items

    def solve(self, *, tuning: SolverTuning = DEFAULTS, quiet: bool = True) -> Outcome:
        """Run to the end time or to an early stop; sensors and `states` keep the results.

        Items that were added to `mbs` and assembled take part.

        Films whose oil warms keep their temperature; `simulate` updates it between revolutions.
        Items that were added to `mbs`, and assembled, take part.
        `exu_press.result.record(model, outcome)` makes a result of the run.

        Args:
            tuning: numbers of the step control.
            quiet: False shows the progress on standard error.
        """
        scene, solver = self.scene, self.scene.solver
        masses = {body.name: body.mass for body in self.mechanism.bodies}
        settings = settings_for(scene, keeps_redundant=self.constraints.keeps_redundant)
        settings.timeIntegration.startTime = self.begin
        settings.timeIntegration.endTime = self.begin + scene.duration
        if solver.tolerance is not None:
            settings.timeIntegration.initialStepSize = self.first_step
        self.states.clear()
        outcome = solve_dynamic(
            self.mbs,
            settings,
            tolerance=solver.tolerance,
            scales=scales(scene),
            criteria=lambda task: [*default_criteria(task), *spring_errors(self, task)],
            next_corner=self.next_corner,
            watch=self.watch,
            event=self.event,
            # modes and drive: excluded from the norm
            bodies={node: (name, masses.get(name, math.inf)) for name, node in self.nodes.items()},
            advice=lambda system, by_tolerance: SceneAdvice(self, system, by_tolerance),
            tuning=tuning,
            max_steps=solver.max_steps,
            quiet=quiet,
        )
        completed = outcome.status is SolverStatus.COMPLETED
        if completed and (leapt := leapt_over_load(self, self.next_corner(0.0))):
            return replace(outcome, status=SolverStatus.UNDER_RESOLVED, reason=leapt)
        return outcome

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a load has a corner or a sample lies, s, or infinity."""
        soonest = math.inf
        for load in self.loads.values():
            soonest = min(soonest, load.next_corner(time))
        if self.start_stop is not None:
            soonest = min(soonest, self.start_stop.next_corner(time))
        if self._section is None:
            return soonest
        speed, (ahead,) = self.scene.angular_speed, self.ahead
        return min(
            soonest, (self._section.next_sample(speed * time + ahead, CLOSE) - ahead) / speed
        )

    @cached_property
    def _section(self) -> "Section | None":
        output = self.scene.output
        if output is None or not output.samples or self.scene.drive is not None:
            return None
        return output.section(self.scene.start_angle)

    @property
    def event(self) -> Callable[[exu.MainSystem, float], float] | None:
        """Function that changes its sign where a motor's crank is sampled or arrives, or None."""
        if self.scene.drive is None:
            return None
        output = self.scene.output
        angles = (
            [] if output is None else [math.radians(degrees) for degrees in output.samples or ()]
        )
        if self.until is not None and not any(_is_same(self.until, angle) for angle in angles):
            angles.append(self.until)
        if not angles:
            return None
        from exu_press.mechanism.section import Section

        section = Section(angles, self.scene.start_angle)
        return lambda mbs, time: section.event_function(self.crank_angle()[0])

    def crank_at_start(self) -> float:
        """Return the crank's angle in the initial state, rad, which becomes the current one."""
        data: Any = self.mbs.systemData
        begin = data.GetSystemState(configuration=exu.ConfigurationType.Initial)
        data.SetSystemState(systemStateList=begin, configuration=exu.ConfigurationType.Current)
        return self.crank_angle()[0]

    def has_stood(self, time: float) -> bool:
        """Return whether the press has stood at a time, s, for as long as its scene demands."""
        return self.start_stop is not None and self.start_stop.is_over(time)

    def watch(self, time: float) -> str:
        """Return why the run ends after a step to a time, s, or nothing; update all memories."""
        self.states.take(time)
        for clock, state in self.clocks:
            clock.accept(time, *state(time))
        motor, start_stop = self.scene.drive, self.start_stop
        if motor is None or self.stall is None:
            return ""
        if start_stop is not None:
            start_stop.accept(time)
            if self.has_stood(time):
                return ARRIVED
        angle, speed = self.crank_angle()
        if self.until is not None and angle >= self.until:
            return ARRIVED
        driven = start_stop is None or start_stop.schedule.is_engaged(time, angle)
        if not self.stall(time, speed, driven=driven):
            return ""
        forces = {name: np.array([load.force_at_rest(time)]) for name, load in self.loads.items()}
        needed = float(holding_torque(self.mechanism, self.scene, forces, np.array([angle]))[0])
        slips = start_stop is not None and start_stop.slips
        available = motor.torque.law(self.scene.speed_rpm)(speed)[0]
        if slips and motor.clutch is not None:
            available = motor.clutch.clutch_torque
        return self.stall.message(time, angle, needed, available, slips=slips)


def _is_same(a: float, b: float) -> bool:
    return abs(math.remainder(a - b, 2.0 * math.pi)) < CLOSE


def count_items(mbs: exu.MainSystem) -> int:
    """Return the number of objects and loads of a system."""
    return int(mbs.systemData.NumberOfObjects() + mbs.systemData.NumberOfLoads())
