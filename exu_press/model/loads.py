"""The loads of a system, as forces on points of its bodies."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import LoadForceVector

from exu_press.laws.load_curve import PulseClock
from exu_press.laws.sheet import PunchStroke, Sheet
from exu_press.model.constraints import crank_angle_of
from exu_press.model.system import System
from exu_press.scene import Scene
from exu_press.scene.applied_load import AppliedLoad

__all__ = ["ActingLoad", "CurvePosition", "add_loads"]

CurvePosition = Callable[[float], tuple[float, float]]
"""Function of time: the argument of a load's curve, and its rate."""

CLOSE = 1e-9
"""Fraction of a revolution within which a corner counts as passed."""

EXTRAPOLATED = 3e-6
"""The same for corners that are extrapolated: the remaining step would be so short that it excites
vibrations."""


class ActingLoad:
    """A load in a system: its force in the current state, and where its curve has corners.

    Attributes:
        applied: the scene's load.
    """

    def __init__(
        self, applied: AppliedLoad, scene: Scene, position: CurvePosition, height: CurvePosition
    ) -> None:
        """Take the load's position on its curve, and the output's height and velocity."""
        self.applied, self._scene = applied, scene
        self._position, self._height = position, height
        self._last = -math.inf, 0.0  # time, s, and rate at the last search of a corner

    def force(self, time: float) -> float:
        """Return the force in its direction, N."""
        moves = self.applied.fade is not None or self.applied.damping
        velocity = self._height(time)[1] if moves else 0.0
        return self.applied.force_at(self._position(time)[0], velocity)

    def force_at_rest(self, time: float) -> float:
        """Return the force, N; of forming, just before the output came to rest."""
        return self.applied.curve(self._position(time)[0])

    def next_corner(self, time: float) -> float:
        """Return the next instant at which the force has a corner, s, or infinity.

        Corners over the output's height, or a motor's crank angle, are extrapolated from its speed
        and its acceleration in the last step.
        """
        over, curve, (now, rate) = self.applied.over, self.applied.curve, self._position(time)
        is_exact = over == "time" or (self._scene.drive is None and over == "crank_angle_deg")
        close = (CLOSE if is_exact else EXTRAPOLATED) * abs(rate) * 60.0 / self._scene.speed_rpm
        if rate == 0.0:
            return math.inf
        corner = curve.corner_after(now, close) if rate > 0.0 else curve.corner_before(now, close)
        return time + self._duration(time, rate, (corner - now) / rate)

    def _duration(self, time: float, rate: float, at_constant_rate: float) -> float:
        """Return the time to a corner, s, from that at a constant rate.

        With v s + a s^2 / 2 = v d, and the mean acceleration a of the last step.
        """
        (last, last_rate), self._last = self._last, (time, rate)
        if not last < time or not at_constant_rate < math.inf:
            return at_constant_rate
        relative = (rate - last_rate) / (rate * (time - last))
        square = 1.0 + 2.0 * relative * at_constant_rate
        return 2.0 * at_constant_rate / (1.0 + math.sqrt(square)) if square > 0.0 else math.inf


class CuttingLoad(ActingLoad):
    """A sheet that resists the punch; its force depends on its history."""

    def __init__(
        self, applied: AppliedLoad, sheet: Sheet, scene: Scene, height: CurvePosition
    ) -> None:
        """Take the sheet, and the output's height and velocity."""
        super().__init__(applied, scene, self.penetration, height)
        self.cut = PunchStroke(sheet)

    def penetration(self, time: float) -> tuple[float, float]:
        """Return the penetration into the sheet, m, and its rate, m/s."""
        height, velocity = self._height(time)
        return self.applied.top - height, -velocity

    def force(self, time: float) -> float:
        """Return the force against the punch's way down, N."""
        return self.cut.force(time, *self.penetration(time))

    force_at_rest = force

    def next_corner(self, time: float) -> float:
        """Return the next instant at which the force has a corner, s, or infinity."""
        now, rate = self.penetration(time)
        close = EXTRAPOLATED * abs(rate) * 60.0 / self._scene.speed_rpm
        return self.cut.next(time, now, rate, close, partial(self._duration, time, rate))


def add_loads(system: System) -> dict[str, ActingLoad]:
    """Add every load to its body; return them by name."""
    height = _output_height(system)
    return {
        name: _add_load(system, name, load, height) for name, load in system.applied_loads.items()
    }


def _add_load(system: System, name: str, applied: AppliedLoad, height: CurvePosition) -> ActingLoad:
    """Add a force of constant direction on a point of a body, or on faces of a flexible one."""
    load: ActingLoad
    if applied.sheet is None:
        load = ActingLoad(applied, system.scene, _curve_position(system, applied, height), height)
    else:
        load = cutting = CuttingLoad(applied, applied.sheet, system.scene, height)
        system.clocks.append((cutting.cut, cutting.penetration))
    x, y = applied.direction

    def force(mbs: exu.MainSystem, t: float, _: Any) -> list[float]:
        size = load.force(t)
        return [size * x, size * y, 0.0]

    if applied.body in system.flexible:
        points = (point for _, point in system.parts[applied.body].load_points(name))
        marker = system.flexible[applied.body].add_point_marker(system.mbs, *points)
    else:
        marker = system.marker(applied.body, applied.point)
    function: Any = force
    system.mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVectorUserFunction=function))
    return load


def _curve_position(system: System, load: AppliedLoad, height: CurvePosition) -> CurvePosition:
    """Return the position of a load on its curve."""
    scene = system.scene
    if load.over == "time":
        return lambda time: (time, 1.0)
    if load.clock is not None:
        return _pulse_time(system, load.clock)
    if load.over == "crank_angle_deg":
        if scene.drive is not None:
            angle = crank_angle_of(system)
            return lambda time: angle()
        start, speed, ahead = scene.start_angle, scene.angular_speed, system.ahead
        return lambda time: (start + speed * time + ahead[0], speed)
    return height


def _pulse_time(system: System, clock: Callable[[float, float], PulseClock]) -> CurvePosition:
    """Return the time since a pulse's beginning, by a clock of the system."""
    scene, crank = system.scene, crank_angle_of(system)
    running = clock(scene.start_angle, scene.angular_speed)
    system.clocks.append((running, lambda time: crank()))

    def pulse_time(time: float) -> tuple[float, float]:
        since = running.since_begin(time, *crank())
        return since, 1.0 if since > -math.inf else 0.0

    return pulse_time


def _output_height(system: System) -> CurvePosition:
    """Return the output's height, m, and velocity, m/s."""
    mbs, output = system.mbs, system.mechanism.output
    x, y = output.direction
    zero = output.origin[0] * x + output.origin[1] * y + system.mechanism.bottom
    slider = output.body
    levels = exu.OutputVariableType.Position, exu.OutputVariableType.Velocity
    if slider in system.flexible:
        node, middle = system.nodes[slider], np.array([*system.parts[slider].centre, 0.0])

        def read(level: exu.OutputVariableType) -> Any:
            """Return position or velocity of the body's centre of mass."""
            kinds = exu.OutputVariableType.RotationMatrix, exu.OutputVariableType.AngularVelocity
            rotation, omega, own = (np.array(mbs.GetNodeOutput(node, k)) for k in (*kinds, level))
            arm = rotation.reshape(3, 3) @ middle
            return own + (arm if level == levels[0] else np.cross(omega, arm))
    else:
        body, centre = system.bodies[slider], [*system.rigid[slider].local((0.0, 0.0)), 0.0]

        def read(level: exu.OutputVariableType) -> Any:
            return mbs.GetObjectOutputBody(body, level, centre)

    def height(time: float) -> tuple[float, float]:
        position, velocity = map(read, levels)
        return (
            float(x * position[0] + y * position[1]) - zero,
            float(x * velocity[0] + y * velocity[1]),
        )

    return height
