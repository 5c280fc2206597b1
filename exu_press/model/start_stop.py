"""A clutch between flywheel and crank, and a brake on the crank, by a schedule."""

import math
from collections.abc import Callable, Sequence
from typing import Any, cast

import exudyn as exu
import numpy as np
from exudyn.itemInterface import ObjectConnectorCoordinateSpringDamper, SensorObject

from exu_press.laws.clutch import Coupling
from exu_press.laws.schedule import Schedule
from exu_press.mechanism import Body, Mechanism
from exu_press.mechanism.parts import FLYWHEEL
from exu_press.model.rigid_body import PivotedBody
from exu_press.model.system import System

__all__ = ["StartStop", "add_flywheel", "add_start_stop"]

Turned = Callable[[], tuple[float, float]]
"""An angle, rad, and its rate, rad/s, in the current state."""

OPEN, STICKS, SLIPS = 0.0, 1.0, 2.0
"""State of a clutch or brake."""

DAMPED = 4.0
"""Over critical damping: the energy of the twist hardly moves the shafts as slip ends."""

CLOSE = 2e-5
"""rad at the nominal speed: an end of slip that is foreseen and as near as that is passed. The rest
of the way would be a step so short that it rings."""

STILL = 1e-3
"""Part of the nominal speed: a crank that a brake holds and that turns by less stands."""


class Pressed:
    """A clutch or brake in a system.

    Attributes:
        coupling: its memory.
        most: its full torque, N m.
        item: number of Exudyn's connector.
        state: at the last step's end: SLIPS, STICKS or OPEN.
    """

    def __init__(
        self,
        mbs: exu.MainSystem,
        coupling: Coupling,
        most: float,
        part: Callable[[float, float], float],
        crank: Turned,
        markers: list[int],
    ) -> None:
        """Add it to a system.

        Args:
            mbs: not yet assembled.
            coupling: at rest.
            most: its full torque, N m.
            part: of it that acts at a time, s, and a crank angle, rad.
            crank: the crank's angle and angular velocity.
            markers: on the coordinates of its two sides.
        """
        self._mbs, self.coupling, self.most = mbs, coupling, most
        self._part, self._crank = part, crank
        self.state, self._way = OPEN, 1.0  # the sign of its torque
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
        """Return the torque at which it slips in the current state, at a time, s, N m."""
        return self.most * self._part(time, self._crank()[0])

    def begin(self, torque: float) -> None:
        """Start in the current state, with a torque, N m."""
        angle = self._mbs.GetObjectOutput(self.item, exu.OutputVariableType.Displacement)
        self.coupling.begin(cast(float, angle), max(-self.most, min(self.most, torque)))

    def next_stick(self, time: float, close: float) -> float:
        """Return when slip will end, s, or infinity; foreseen from how it has changed of late.

        Args:
            time: s.
            close: an end that is as near as that is passed, s.
        """
        rate = self._way * self._rate
        if self.state != SLIPS or self._slope * self._way >= 0.0:
            return math.inf
        left = rate / abs(self._slope)
        return time + left if left > close else math.inf

    def accept(self, step: float, time: float) -> None:
        """Keep the state at the end of a step, s."""
        kinds = exu.OutputVariableType.Displacement, exu.OutputVariableType.Velocity
        angle, rate = (cast(float, self._mbs.GetObjectOutput(self.item, kind)) for kind in kinds)
        capacity = self.capacity(time)
        turned_back = self.state == SLIPS and self._way * rate <= 0.0
        slips = not turned_back and self.coupling.excess_torque(angle, rate, capacity) > 0.0
        self._way = math.copysign(1.0, self.coupling.torque(angle, rate, capacity))
        self._slope = (rate - self._rate) / step if step > 0.0 else 0.0
        self._rate = rate
        self.coupling.accept(step, angle, rate, capacity)
        self.state = (SLIPS if slips else STICKS) if capacity > 0.0 else OPEN

    @property
    def sticks(self) -> bool:
        """Return whether it held at the last step's end."""
        return self.state == STICKS

    def memory(self) -> list[float]:
        """Return all that its future follows from, as numbers."""
        return [*self.coupling.memory(), self.state, self._way]

    def recall(self, memory: Sequence[float]) -> None:
        """Take over another's memory."""
        twist, angle, self.state, self._way = memory
        self.coupling.recall((twist, angle))


class StartStop:
    """Commands of a model, with its clutch and brake."""

    def __init__(
        self, schedule: Schedule, crank: Turned, speed: float, ends_after: float | None
    ) -> None:
        """Begin.

        Args:
            schedule: of the commands.
            crank: its angle and angular velocity.
            speed: of the crank in operation, rad/s.
            ends_after: for how long the press stands when the run ends, s; None: as long as it may.
        """
        self.schedule, self._crank, self._speed = schedule, crank, speed
        self._ends_after = math.inf if ends_after is None else ends_after
        self.clutch: Pressed | None = None
        self.brake: Pressed | None = None
        self._time: float | None = None
        self._stood: float | None = None  # since when the press stands

    @property
    def pressed(self) -> list[Pressed]:
        """Clutch and brake, as far as there are."""
        return [one for one in (self.clutch, self.brake) if one is not None]

    def next_corner(self, time: float) -> float:
        """Return the next instant at which a torque has a corner, s, or infinity."""
        soonest = self.schedule.corner(time, *self._crank())
        for one in self.pressed:
            soonest = min(soonest, one.next_stick(time, CLOSE / self._speed))
        return soonest if self._stood is None else min(soonest, self._stood + self._ends_after)

    def accept(self, time: float) -> None:
        """Keep the state at the end of a step, s."""
        step = 0.0 if self._time is None else time - self._time
        self._time = time
        angle, speed = self._crank()
        for one in self.pressed:
            one.accept(step, time)
        self.schedule.accept(time, angle)
        held = self.brake is None or self.brake.sticks
        stands = self.schedule.done(time) and held and abs(speed) < STILL * self._speed
        self._stood = (self._stood if self._stood is not None else time) if stands else None

    def over(self, time: float) -> bool:
        """Return whether it has stood after its last stop for as long as its run goes on then."""
        return self._stood is not None and time - self._stood >= self._ends_after * (1.0 - 1e-9)

    @property
    def slips(self) -> bool:
        """Return whether the clutch slips."""
        return self.clutch is not None and self.clutch.state == SLIPS

    def begin(self, torque: float) -> None:
        """Start in the current state, with a torque on the crank that holds it, N m."""
        for one, on_crank in ((self.clutch, 1.0), (self.brake, -1.0)):
            if one is not None:
                one.begin(on_crank * torque)

    def memory(self) -> list[float]:
        """Return all that the future follows from, as numbers."""
        found = self.schedule.memory()
        for one in self.pressed:
            found += one.memory()
        return found

    def recall(self, memory: list[float]) -> None:
        """Take over another's memory."""
        self.schedule.recall(memory[:5])
        for number, one in enumerate(self.pressed):
            one.recall(memory[5 + 4 * number : 9 + 4 * number])


def add_flywheel(system: System) -> None:
    """Add the flywheel, which turns about the shaft by itself."""
    scene, motor = system.scene, system.scene.drive
    assert motor is not None
    mechanism = system.mechanism
    at = mechanism.shaft.at
    start = system.ideal[mechanism.crank].point_motion(mechanism.body(mechanism.crank).local(at))
    speed = 0.0 if motor.begins == "rest" else scene.angular_speed
    start.velocity[:] = 0.0, 0.0, speed
    wheel = Body(FLYWHEEL, 1.0, motor.inertia)  # its weight is borne by the frame
    added = PivotedBody(system.mbs, wheel, start, at, (0.0, 0.0))
    system.take_in(FLYWHEEL, added)


def add_start_stop(system: System, turned: str, crank: Turned) -> StartStop:
    """Add clutch and brake.

    Args:
        system: with crank and flywheel.
        turned: body that the clutch turns.
        crank: its angle and angular velocity.
    """
    motor = system.scene.drive
    assert motor is not None
    assert motor.clutch_torque is not None
    schedule = motor.schedule()
    found = StartStop(schedule, crank, system.scene.angular_speed, motor.ends_after)
    inertia = _crank_inertia(system.mechanism)
    both = 1.0 / (1.0 / inertia + 1.0 / motor.inertia)
    wheel, shaft = system.coordinate(FLYWHEEL, "angle"), system.coordinate(turned, "angle")
    ends = {
        "clutch": (motor.clutch_torque, both, schedule.clutch, [shaft, wheel]),
        "brake": (motor.brake_torque, inertia, schedule.brake, [system.still, shaft]),
    }
    for name, (most, against, part, markers) in ends.items():
        if most is None:
            continue
        stiffness = most / math.radians(motor.windup_deg)
        coupling = Coupling(stiffness, 2.0 * DAMPED * math.sqrt(stiffness * against))
        one = Pressed(system.mbs, coupling, most, part, crank, markers)
        kind = exu.OutputVariableType.Force
        sensor = SensorObject(objectNumber=one.item, storeInternal=True, outputVariableType=kind)
        system.sensors[name, "torque"] = system.mbs.AddSensor(sensor)
        setattr(found, name, one)
    return found


def _crank_inertia(mechanism: Mechanism) -> float:
    """Return the mean inertia of the whole mechanism on its crank, kg m^2."""
    moving = mechanism.motion(np.linspace(0.0, 2.0 * math.pi, 73), 1.0)
    energy = 0.0
    for body in mechanism.bodies:
        x, y, turn = moving[body.name].velocity.T
        energy += body.mass * float(np.mean(x * x + y * y)) + body.inertia * float(
            np.mean(turn * turn)
        )
    return energy
