"""What is read from a system at equally distant instants of a run."""

from typing import Any, NamedTuple

import exudyn as exu
import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["MOST_SAMPLES", "Samples", "Variables"]

MOST_SAMPLES = 200  # largest number of samples of a run
NOT_HERE = exu.ExudynError, RuntimeError, ValueError, TypeError  # a node has no such output


class Samples(NamedTuple):
    """A run at equally distant instants, the first of which is its start.

    Each array has a row for each instant: times (s), coordinates and velocities of second order,
    coordinates of first order and their rates, displacements (m) of nodes, their rotation matrices,
    their angular velocities (rad/s), and the values of all sensors.
    """

    times: Array
    coordinates: Array
    velocities: Array
    first_order: Array
    rates: Array
    displacements: Array
    rotations: Array
    angular_velocities: Array
    sensors: Array


class Variables:
    """Nodes and sensors of an assembled system, classified by what they output.

    Nodes are `placed` (they have a displacement), `turning` (a rotation matrix too), or `plain`
    (their coordinates count together: modes, scalar coordinates, slopes).
    """

    def __init__(self, mbs: exu.MainSystem) -> None:
        """Ask all nodes and sensors what they have."""
        system: Any = mbs
        self._mbs, data, output = system, system.systemData, exu.OutputVariableType
        self.placed, self.turning, self.plain = list[int](), list[int](), list[int]()
        self.spans = dict[int, slice]()  # node -> its coordinates among those of second order
        for node in range(data.NumberOfNodes()):
            count = self._size(node, output.Coordinates)
            try:
                start = system.GetNodeODE2Index(node)
            except NOT_HERE:
                continue
            if count:
                self.spans[node] = slice(start, start + count)
                displaced = self._size(node, output.Displacement) > 0
                turns = displaced and self._size(node, output.RotationMatrix) > 0
                self.placed += [node] * displaced
                self.turning += [node] * turns
                self.plain += [node] * (not displaced or (not turns and count > 3))
        sensors = [system.GetSensor(number) for number in range(data.NumberOfSensors())]
        self.sensors = [int(np.size(system.GetSensorValues(n))) for n in range(len(sensors))]
        types = [str(sensor.get("outputVariableType", sensor["sensorType"])) for sensor in sensors]
        self.kinds = np.repeat(np.array(types, dtype=str), self.sensors)
        names = {node: f"node {node} ({system.GetNode(node)['name']})" for node in self.spans}
        self.names = [f"displacement of {names[node]}" for node in self.placed]
        self.names += [f"rotation of {names[node]}" for node in self.turning]
        self.names += [f"coordinates of {names[node]}" for node in self.plain]
        self.names += [f"first-order coordinate {i}" for i in range(int(data.ODE1Size()))]
        for number, (sensor, size) in enumerate(zip(sensors, self.sensors, strict=True)):
            self.names += [f"value {i} of sensor {number} ({sensor['name']})" for i in range(size)]
        self.names.append("time at which a user function ends the run")

    def _size(self, node: int, output: Any) -> int:
        try:
            return int(np.size(self._mbs.GetNodeOutput(node, output)))
        except NOT_HERE:
            return 0

    def row(self, time: float) -> list[Array]:
        """Return the current state at a time (s), in the order of `Samples`."""
        mbs, data, output = self._mbs, self._mbs.systemData, exu.OutputVariableType

        def of_nodes(nodes: list[int], kind: Any, *shape: int) -> Array:
            return np.reshape([mbs.GetNodeOutput(node, kind) for node in nodes], (-1, *shape))

        sensors = [np.ravel(mbs.GetSensorValues(number)) for number in range(len(self.sensors))]
        row: list[Any] = [time, data.GetODE2Coordinates(), data.GetODE2Coordinates_t()]
        row += [data.GetODE1Coordinates(), data.GetODE1Coordinates_t()]
        row += [of_nodes(self.placed, output.Displacement, 3)]
        row += [of_nodes(self.turning, output.RotationMatrix, 3, 3)]
        row += [of_nodes(self.turning, output.AngularVelocity, 3), np.concatenate([*sensors, []])]
        return [np.array(values, dtype=float) for values in row]
