"""A clutch between flywheel and crank, and a brake on the crank, by a schedule."""

import math
from collections.abc import Callable, Sequence
from typing import Any, cast

import exudyn as exu
import numpy as np
from exudyn.itemInterface import ObjectConnectorCoordinateSpringDamper

from exu_press.laws.clutch import Coupling
from exu_press.laws.schedule import Schedule
from exu_press.mechanism import Body, Mechanism
from exu_press.mechanism.parts import FLYWHEEL
from exu_press.model.constraints import CrankAngle, turned_body
from exu_press.model.rigid_body import PivotedBody
from exu_press.model.system import System

__all__ = ["StartStop", "add_flywheel", "add_start_stop"]

OPEN, STICKS, SLIPS = 0.0, 1.0, 2.0
"""State of a clutch or brake."""

DAMPING_RATIO = 4.0
"""Of the twist: its energy hardly moves the shafts at the end of slip."""

CLOSE = 2e-5
"""rad at the nominal speed: an extrapolated end of slip as close as this counts as passed. The
remaining step would be so short that it excites vibrations."""

STILL = 1e-3
"""Speed over the nominal one, below which a crank that a brake holds stands."""


class ClutchElement:
    """A clutch or brake of a system.

    Attributes:
        coupling: with the twist and its memory.
        full_torque: N m.
        item: number of Exudyn's connector.
        state: at the end of the last step: SLIPS, STICKS or OPEN.
    """

    def __init__(
        self,
        mbs: exu.MainSystem,
        coupling: Coupling,
        full_torque: float,
        engagement: Callable[[float, float], float],
        crank: CrankAngle,
        markers: list[int],
    ) -> None:
        """Add it to a system.

        Args:
            mbs: not yet assembled.
            coupling: at rest.
            full_torque: N m.
            engagement: fraction of it that acts at a time, s, and a crank angle, rad.
            crank: the crank's angle and angular velocity.
            markers: of the coordinates of its two sides.
        """
        self._mbs, self.coupling, self.full_torque = mbs, coupling, full_torque
        self._engagement, self._crank = engagement, crank
        self.state, self._sign = OPEN, 1.0  # of its torque
        self._rate = self._slope = 0.0  # rad/s and rad/s^2, of slip

        def torque(
            mbs: Any,
            t: float,
            item: int,
            angle: float,
            rate: float,
            k: float,
            d: float,
            zero: float,
        ) -> float:
            return coupling.torque(angle, rate, self.capacity(t))

        function: Any = torque
        item = ObjectConnectorCoordinateSpringDamper(
            markerNumbers=markers, springForceUserFunction=function
        )
        self.item = int(mbs.AddObject(item))

    def capacity(self, time: float) -> float:
        """Return the torque, N m, above which it slips in the current state, at a time, s."""
        return self.full_torque * self._engagement(time, self._crank()[0])

    def begin(self, torque: float) -> None:
        """Start in the current state, with a torque, N m."""
        angle = self._mbs.GetObjectOutput(self.item, exu.OutputVariableType.Displacement)
        self.coupling.begin(
            cast(float, angle), max(-self.full_torque, min(self.full_torque, torque))
        )

    def end_of_slip(self, time: float, close: float) -> float:
        """Return the time at which slip will end, s, by extrapolation, or infinity.

        An end as close as some time, s, counts as passed.
        """
        rate = self._sign * self._rate
        if self.state != SLIPS or self._slope * self._sign >= 0.0:
            return math.inf
        remaining = rate / abs(self._slope)
        return time + remaining if remaining > close else math.inf

    def accept(self, step: float, time: float) -> None:
        """Keep the state at the end of a step, s."""
        kinds = exu.OutputVariableType.Displacement, exu.OutputVariableType.Velocity
        angle, rate = (cast(float, self._mbs.GetObjectOutput(self.item, kind)) for kind in kinds)
        capacity = self.capacity(time)
        reverses = self.state == SLIPS and self._sign * rate <= 0.0
        slips = not reverses and self.coupling.excess_torque(angle, rate, capacity) > 0.0
        self._sign = math.copysign(1.0, self.coupling.torque(angle, rate, capacity))
        self._slope = (rate - self._rate) / step if step > 0.0 else 0.0
        self._rate = rate
        self.coupling.accept(step, angle, rate, capacity)
        self.state = (SLIPS if slips else STICKS) if capacity > 0.0 else OPEN

    def memory(self) -> list[float]:
        """Return all numbers that determine its future."""
        return [*self.coupling.memory(), self.state, self._sign]

    def recall(self, memory: Sequence[float]) -> None:
        """Set the numbers of `memory`."""
        twist, angle, self.state, self._sign = memory
        self.coupling.recall((twist, angle))


class StartStop:
    """Clutch and brake of a model, with the schedule of their commands."""

    def __init__(
        self, schedule: Schedule, crank: CrankAngle, speed: float, ends_after: float | None
    ) -> None:
        """Take the schedule, and the crank's speed in operation, rad/s.

        A press that has stood for `ends_after`, s, ends its run.
        """
        self.schedule, self._crank, self._speed = schedule, crank, speed
        self._ends_after = math.inf if ends_after is None else ends_after
        self.clutch: ClutchElement | None = None
        self.brake: ClutchElement | None = None
        self._time: float | None = None
        self._stands_since: float | None = None  # s

    @property
    def elements(self) -> list[ClutchElement]:
        """Clutch and brake, as far as they exist."""
        return [element for element in (self.clutch, self.brake) if element is not None]

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a torque has a corner, s, or infinity."""
        soonest = self.schedule.corner(time, *self._crank())
        for element in self.elements:
            soonest = min(soonest, element.end_of_slip(time, CLOSE / self._speed))
        return (
            soonest
            if self._stands_since is None
            else min(soonest, self._stands_since + self._ends_after)
        )

    def accept(self, time: float) -> None:
        """Keep the state at the end of a step, s."""
        step = 0.0 if self._time is None else time - self._time
        self._time = time
        angle, speed = self._crank()
        for element in self.elements:
            element.accept(step, time)
        self.schedule.accept(time, angle)
        is_held = self.brake is None or self.brake.state == STICKS
        stands = self.schedule.done(time) and is_held and abs(speed) < STILL * self._speed
        self._stands_since = (
            (self._stands_since if self._stands_since is not None else time) if stands else None
        )

    def is_over(self, time: float) -> bool:
        """Return whether the press has stood after its last stop until the end of the run."""
        if self._stands_since is None:
            return False
        return time - self._stands_since >= self._ends_after * (1.0 - 1e-9)

    @property
    def slips(self) -> bool:
        """Return whether the clutch slips."""
        return self.clutch is not None and self.clutch.state == SLIPS

    def begin(self, torque: float) -> None:
        """Start in the current state, with a torque on the crank that holds it, N m."""
        for element, sign in ((self.clutch, 1.0), (self.brake, -1.0)):
            if element is not None:
                element.begin(sign * torque)

    def memory(self) -> list[float]:
        """Return all numbers that determine the future."""
        return [*self.schedule.memory(), *(x for e in self.elements for x in e.memory())]

    def recall(self, memory: list[float]) -> None:
        """Set the numbers of `memory`."""
        self.schedule.recall(memory[:5])
        for number, element in enumerate(self.elements):
            element.recall(memory[5 + 4 * number : 9 + 4 * number])


def add_flywheel(system: System) -> None:
    """Add the flywheel, which turns freely about the shaft."""
    scene, motor = system.scene, system.scene.drive
    assert motor is not None
    mechanism = system.mechanism
    centre, crank = mechanism.shaft.at, mechanism.body(mechanism.crank)
    start = system.ideal[mechanism.crank].point_motion(crank.local(centre))
    speed = 0.0 if motor.begins == "rest" else scene.angular_speed
    start.velocity[:] = 0.0, 0.0, speed
    wheel = Body(FLYWHEEL, 1.0, motor.inertia)  # the frame bears its weight
    body = PivotedBody(system.mbs, wheel, start, centre, (0.0, 0.0))
    system.add_rigid(FLYWHEEL, body)


def add_start_stop(system: System, crank: CrankAngle) -> StartStop:
    """Add clutch and brake to a system with crank and flywheel."""
    motor = system.scene.drive
    assert motor is not None
    assert motor.clutch is not None
    clutch, brake = motor.clutch, motor.clutch.brake
    schedule = clutch.schedule(not motor.stands)
    start_stop = StartStop(schedule, crank, system.scene.angular_speed, motor.ends_after)
    inertia = _crank_inertia(system.mechanism)
    reduced_inertia = 1.0 / (1.0 / inertia + 1.0 / motor.inertia)
    wheel, shaft = (
        system.coordinate(FLYWHEEL, "angle"),
        system.coordinate(turned_body(system), "angle"),
    )
    elements = {
        "clutch": (clutch.clutch_torque, reduced_inertia, schedule.clutch, [shaft, wheel]),
        "brake": (
            None if brake is None else brake.brake_torque,
            inertia,
            schedule.brake,
            [system.still, shaft],
        ),
    }
    for name, (torque, moving, engagement, markers) in elements.items():
        if torque is None:
            continue
        stiffness = torque / math.radians(clutch.windup_deg)
        coupling = Coupling(stiffness, 2.0 * DAMPING_RATIO * math.sqrt(stiffness * moving))
        element = ClutchElement(system.mbs, coupling, torque, engagement, crank, markers)
        system.record(name, "torque", element.item)
        setattr(start_stop, name, element)
    return start_stop


def _crank_inertia(mechanism: Mechanism) -> float:
    """Return the mean inertia of the whole mechanism, reduced to its crank, kg m^2."""
    moving = mechanism.motion(np.linspace(0.0, 2.0 * math.pi, 73), 1.0)
    energy = 0.0
    for body in mechanism.bodies:
        x, y, turn = moving[body.name].velocity.T
        energy += body.mass * float(np.mean(x * x + y * y)) + body.inertia * float(
            np.mean(turn * turn)
        )
    return energy
