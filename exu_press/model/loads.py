"""The load of a system: a blanking pulse."""

import math
from typing import Any

import exudyn as exu
from exudyn.itemInterface import LoadCoordinate, LoadForceVector, SensorLoad

from exu_press.errors import InputError
from exu_press.laws.blanking import blanking_force
from exu_press.model.system import System
from exu_press.scene import Scene

__all__ = ["add_blanking", "next_corner"]


def add_blanking(system: System) -> None:
    """Press the slider in its direction once a revolution, at a place of the frame."""
    pulse = system.scene.blanking
    if pulse is None or pulse.force == 0.0:
        return
    period, begin = _pulse_period(system.scene)
    slider, direction = system.mechanism.slider, system.mechanism.output.direction
    if slider in system.flexible:
        raise InputError(f"blanking: acts on {slider}, which is flexible; allowed is a rigid one")

    def force(mbs: exu.MainSystem, t: float, load: float) -> float:
        return blanking_force((t - begin) % period, pulse.force, pulse.rise, pulse.fall)

    def along(mbs: exu.MainSystem, t: float, load: Any) -> list[float]:
        size = force(mbs, t, 0.0)
        return [size * direction[0], size * direction[1], 0.0]

    vector: Any = along

    def moment(mbs: exu.MainSystem, t: float, load: float) -> float:
        return pulse.eccentricity * force(mbs, t, load)

    upwards = direction == (0.0, 1.0) and "y" in system.rigid[slider].coordinates
    if upwards:
        pressed: Any = LoadCoordinate(
            markerNumber=system.coordinate(slider, "y"), load=0.0, loadUserFunction=force
        )
    else:
        pressed = LoadForceVector(
            markerNumber=system.marker(slider, (0.0, 0.0)), loadVectorUserFunction=vector
        )
    number = system.mbs.AddLoad(pressed)
    if pulse.eccentricity != 0.0 and "angle" in system.rigid[slider].coordinates:
        turned = system.coordinate(slider, "angle")
        system.mbs.AddLoad(LoadCoordinate(markerNumber=turned, load=0.0, loadUserFunction=moment))
    sensor = SensorLoad(loadNumber=number, storeInternal=True)
    system.sensors["blanking", "force"] = system.mbs.AddSensor(sensor)


def next_corner(scene: Scene, time: float) -> float:
    """Return the next instant at which the blanking force has a corner, s, or infinity."""
    pulse = scene.blanking
    if pulse is None or pulse.force == 0.0:
        return math.inf
    period, begin = _pulse_period(scene)
    corners = (0.0, pulse.rise, pulse.rise + pulse.fall)
    since = [(time - begin - corner) / period for corner in corners]
    return min(
        begin + corner + period * (math.floor(turns + 1e-9) + 1)
        for corner, turns in zip(corners, since, strict=True)
    )


def _pulse_period(scene: Scene) -> tuple[float, float]:
    """Return the time between two blanking pulses and the begin of one of them, s."""
    pulse, period = scene.blanking, 60.0 / scene.speed_rpm
    assert pulse is not None
    end = (pulse.end_angle_deg - scene.start_angle_deg) / 360.0 * period
    return period, end - pulse.rise - pulse.fall
