"""The loads of a system, as forces on points of its bodies."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import LoadForceVector

from exu_press.laws.load_curve import PulseClock
from exu_press.laws.sheet import Cut
from exu_press.mechanism import Mechanism
from exu_press.model.drive import crank_angle_of
from exu_press.model.system import System
from exu_press.scene import Scene
from exu_press.scene.applied import AppliedLoad, applied_loads

__all__ = ["Place", "add_loads", "force_at", "next_corner", "torque_wanted"]

Place = Callable[[float], tuple[float, float]]
"""Function of time: the place of a load on its curve, and its rate."""

CLOSE = 1e-9
"""Part of a revolution: corners as close as that are passed."""

FORESEEN = 3e-6
"""The same of corners that are foreseen from a position and its rate, to the square of a step: the
rest of the way would be a step so short that it rings."""


def add_loads(system: System) -> dict[str, tuple[AppliedLoad, Place]]:
    """Let every load press its body; return the loads, each with its place on its curve."""
    added: dict[str, tuple[AppliedLoad, Place]] = {}
    for name, load in system.loads.items():
        if load.sheet is not None:
            added[name] = load, _add_sheet(system, name, load)
            continue
        place = _place(system, load)
        _add_load(system, name, load, place)
        added[name] = load, place
    return added


def next_corner(loads: Mapping[str, tuple[AppliedLoad, Place]], scene: Scene, time: float) -> float:
    """Return the next instant at which a load has a corner, s, or infinity.

    What a load over the output's height, or a motor's crank angle, has before it is foreseen from
    the speed now.
    """
    soonest = math.inf
    for load, place in loads.values():
        now, rate = place(time)
        if isinstance(place, Cutting):
            close = FORESEEN * abs(rate) * 60.0 / scene.speed_rpm
            soonest = min(soonest, place.cut.next(time, now, rate, close))
            continue
        exact = load.over == "time" or (scene.drive is None and load.over == "crank_angle_deg")
        part = CLOSE if exact else FORESEEN
        close = part * abs(rate) * 60.0 / scene.speed_rpm
        if rate > 0.0:
            soonest = min(soonest, time + (load.curve.corner_after(now, close) - now) / rate)
        elif rate < 0.0:
            soonest = min(soonest, time + (load.curve.corner_before(now, close) - now) / rate)
    return soonest


def force_at(load: AppliedLoad, place: Place, time: float) -> float:
    """Return a load's force in the current state, N; that of forming does not fade at rest."""
    now = place(time)
    return place.cut.force(time, *now) if isinstance(place, Cutting) else load.curve(now[0])


def torque_wanted(
    mechanism: Mechanism, scene: Scene, forces: Mapping[str, float], angle: float
) -> float:
    """Return the crank's torque that holds loads and weights, N m, by virtual work.

    Args:
        mechanism: ideal, and without friction.
        scene: with the loads.
        forces: of the loads, as they were before the output came to rest, N.
        angle: of the crank, rad.
    """
    per_angle = mechanism.motion(np.array([angle]), 1.0)
    wanted = 0.0
    for body in mechanism.bodies:
        wanted += body.mass * scene.gravity * float(per_angle[body.name].velocity[0, 1])
    closes = float(mechanism.along(per_angle[mechanism.slider].velocity)[0]) < 0.0
    for name, load in applied_loads(scene).items():
        if load.fade is None or closes:
            moved = per_angle[load.body].at(load.point).velocity[0, :2]
            wanted -= forces[name] * float(moved @ np.array(load.direction))
    return wanted


def _add_load(system: System, name: str, load: AppliedLoad, place: Place) -> None:
    """Press a point of a body, in a direction that stays; on a flexible one the faces carry it."""
    x, y = load.direction
    velocity = _height(system) if load.fade is not None or load.damping else None

    def force(mbs: exu.MainSystem, t: float, _: Any) -> list[float]:
        size = load.at(place(t)[0], velocity(t)[1] if velocity else 0.0)
        return [size * x, size * y, 0.0]

    _press(system, name, load, force)


class Cutting:
    """The penetration into a sheet, m, and its rate, m/s, in the current state."""

    def __init__(self, cut: Cut, top: float, height: Place) -> None:
        """Cut a sheet whose upper face is at a height, m."""
        self.cut, self._top, self._height = cut, top, height

    def __call__(self, time: float) -> tuple[float, float]:
        """Return penetration and rate."""
        height, velocity = self._height(time)
        return self._top - height, -velocity


def _add_sheet(system: System, name: str, load: AppliedLoad) -> Cutting:
    """Let a sheet resist the punch, by its state."""
    assert load.sheet is not None
    place = Cutting(Cut(load.sheet), load.top, _height(system))
    cut, (x, y) = place.cut, load.direction
    system.clocks.append((cut, place))

    def force(mbs: exu.MainSystem, t: float, _: Any) -> list[float]:
        size = cut.force(t, *place(t))
        return [size * x, size * y, 0.0]

    _press(system, name, load, force)
    return place


def _press(system: System, name: str, load: AppliedLoad, function: Any) -> None:
    """Put a force on a rigid body's point, or on a flexible body's faces."""
    if load.body in system.flexible:
        from exu_press.model.flexible_body import load_point

        count = len(system.parts[load.body].loads[name])
        points = (load_point(name, number) for number in range(count))
        marker = system.flexible[load.body].add_point_marker(system.mbs, *points)
    else:
        marker = system.marker(load.body, load.point)
    system.mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVectorUserFunction=function))


def _place(system: System, load: AppliedLoad) -> Place:
    """Return where on its curve a load is."""
    scene = system.scene
    if load.over == "time":
        return lambda time: (time, 1.0)
    if load.clock is not None:
        return _since_the_beginning(system, load.clock)
    if load.over == "crank_angle_deg":
        if scene.drive is not None:
            angle = crank_angle_of(system)
            return lambda time: angle()
        start, speed, ahead = scene.start_angle, scene.angular_speed, system.ahead
        return lambda time: (start + speed * time + ahead[0], speed)
    return _height(system)


def _since_the_beginning(system: System, clock: Callable[[float, float], PulseClock]) -> Place:
    """Return the function of the time since a pulse's beginning, which the clocks keep."""
    scene, crank = system.scene, crank_angle_of(system)
    running = clock(scene.start_angle, scene.angular_speed)
    system.clocks.append((running, lambda time: crank()))

    def place(time: float) -> tuple[float, float]:
        since = running.place(time, *crank())
        return since, 1.0 if since > -math.inf else 0.0

    return place


def _height(system: System) -> Place:
    """Return the function of the output's height, m, and velocity, m/s."""
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

    def place(time: float) -> tuple[float, float]:
        position, velocity = map(read, levels)
        return (
            float(x * position[0] + y * position[1]) - zero,
            float(x * velocity[0] + y * velocity[1]),
        )

    return place
