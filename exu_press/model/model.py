"""An assembled Exudyn system with the names of its items."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import exudyn as exu

from exu_press.integrate import ARRIVED, Outcome, SolverTuning
from exu_press.model.drive import CrankAngle
from exu_press.model.rigid_body import RigidBody
from exu_press.model.stall import Stall, holding_torque, stalled
from exu_press.solving import DEFAULTS, SolvableModel, solve

if TYPE_CHECKING:
    from exu_press.joints.guide_friction import GuideFriction
    from exu_press.laws.sheet import Clock
    from exu_press.mechanism.section import Section
    from exu_press.model.loads import ActingLoad, Place
    from exu_press.model.placed_part import PlacedPart
    from exu_press.model.start_stop import StartStop
    from exu_press.model.warm_film import WarmFilm

__all__ = ["Model", "count_items"]

CLOSE = 1e-9
"""rad: a sample that is no further away is reached."""


@dataclass(frozen=True)
class Model(SolvableModel):
    """An assembled system with the names of its items.

    Attributes:
        SC: Exudyn's system container; its main system is `mbs`.
        bodies: name -> object number.
        rigid: name -> rigid body.
        drive: object number of the item that turns the crank.
        crank_angle: tells the crank's angle and angular velocity.
        start_stop: clutch, brake and their schedule, if there is a clutch.
        stall: tells whether the press has stalled.
        loads: name -> load that acts.
        clocks: of pulses and sheets of loads, and the readers of their state.
        ahead: angle, rad, by which a crank at constant speed had turned further at time 0, alone.
        remembered: by those, where the run goes on from another one.
        guide_friction: name of a body in a guide without clearance -> its friction there.
        parts: name -> flexible body's part; empty for rigid bodies.
        made: number of objects and loads that the scene was made of.
        warm: name of a joint -> its film, whose oil warms.
        until: crank angle at which a run with a motor has arrived, rad; None: it goes on to its
            end time.
    """

    SC: exu.SystemContainer
    bodies: dict[str, int]
    rigid: Mapping[str, RigidBody]
    drive: int
    crank_angle: CrankAngle
    start_stop: "StartStop | None"
    stall: Stall
    loads: Mapping[str, "ActingLoad"]
    clocks: "list[tuple[Clock, Place]]"
    ahead: list[float]
    guide_friction: Mapping[str, "GuideFriction"]
    parts: Mapping[str, "PlacedPart"]
    made: int
    warm: Mapping[str, "WarmFilm"] = field(default_factory=dict, kw_only=True)
    remembered: tuple[tuple[float, float | None], ...] = field(default=(), kw_only=True)
    until: float | None = field(default=None, kw_only=True)

    @property
    def own_items(self) -> int:
        """Number of objects and loads that the user has added since."""
        return count_items(self.mbs) - self.made

    def solve(self, *, tuning: SolverTuning = DEFAULTS, quiet: bool = True) -> Outcome:
        """Run to the end time or to an early stop; sensors and `states` keep the results.

        Films whose oil warms keep their temperature meanwhile; `simulate` renews it.

        Items that were added to `mbs` since, and assembled, take part.
        `exu_press.result.record(model, outcome)` makes a result of it.

        Args:
            tuning: the numbers of step control, to vary them.
            quiet: False shows the progress on standard error.
        """
        self.states.clear()
        return solve(self, tuning=tuning, quiet=quiet)

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a load has a corner or a sample lies, s, or infinity."""
        corners = (load.next_corner(time) for load in self.loads.values())
        soonest = min(corners, default=math.inf)
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
        """A function that changes its sign where a motor's crank is sampled or arrives, or None."""
        if self.scene.drive is None:
            return None
        output = self.scene.output
        angles = [] if output is None else [math.radians(each) for each in output.samples or ()]
        if self.until is not None and not any(_same(self.until, angle) for angle in angles):
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
        """Return whether the press has stood at a time, s, for as long as its scene asks for."""
        return self.start_stop is not None and self.start_stop.over(time)

    def watch(self, time: float) -> str:
        """Return why the press goes no further, after a step that ends at a time, s, or nothing."""
        self.states.take(time)
        for clock, state in self.clocks:
            clock.accept(time, *state(time))
        motor, start_stop = self.scene.drive, self.start_stop
        if motor is None:
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
        forces = {name: load.force_at_rest(time) for name, load in self.loads.items()}
        wanted = holding_torque(self.mechanism, self.scene, forces, angle)
        slips = start_stop is not None and start_stop.slips
        there = motor.law(self.scene.speed_rpm)(speed)[0]
        if slips and motor.clutch_torque is not None:
            there = motor.clutch_torque
        return stalled(time, angle, wanted, there, slips=slips)


def _same(angle: float, other: float) -> bool:
    return abs(math.remainder(angle - other, 2.0 * math.pi)) < CLOSE


def count_items(mbs: exu.MainSystem) -> int:
    """Return the number of objects and loads of a system."""
    return int(mbs.systemData.NumberOfObjects() + mbs.systemData.NumberOfLoads())
