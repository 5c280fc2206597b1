"""Sensors: the record of every step, in memory."""

from collections.abc import Mapping

import exudyn as exu
from exudyn.itemInterface import SensorNode, SensorObject

from exu_press.model.system import System

__all__ = ["add_sensors"]


def add_sensors(
    system: System, joints: Mapping[str, int], guides: Mapping[str, Mapping[str, int]]
) -> None:
    """Record bodies' coordinates and the constraints' forces."""
    levels = {
        "position": exu.OutputVariableType.Coordinates,
        "velocity": exu.OutputVariableType.Coordinates_t,
        "acceleration": exu.OutputVariableType.Coordinates_tt,
    }
    for name, node in system.nodes.items():
        for level, output in levels.items():
            sensor = SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=output)
            system.sensors[name, level] = system.mbs.AddSensor(sensor)
    forces = {(name, "force"): number for name, number in joints.items()}
    for body, numbers in guides.items():
        forces |= {(f"{body}_guide", kind): number for kind, number in numbers.items()}
    for key, number in forces.items():
        local = number in system.local_forces
        kind = exu.OutputVariableType.ForceLocal if local else exu.OutputVariableType.Force
        load = SensorObject(objectNumber=number, storeInternal=True, outputVariableType=kind)
        system.sensors[key] = system.mbs.AddSensor(load)
