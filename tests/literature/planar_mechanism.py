"""A planar Exudyn model of rods: bodies with their weight, pins, and their motion at instants."""

import math

import exudyn as exu
import numpy as np
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyPosition,
    ObjectGround,
    ObjectJointRevolute2D,
)
from stand_in_system import planar_body, recorded, settings

from exu_press import solve_dynamic

GRAVITY = 9.81


class PlanarMechanism:
    """Bodies in the order in which they are added; a point of a body is x along it, m."""

    def __init__(self):
        self._container = exu.SystemContainer()
        self.mbs = self._container.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround())
        self.nodes, self._sensors = [], []

    def add_body(self, mass, inertia, pose, velocity=(0.0, 0.0, 0.0)):
        """Return a body with its weight, at a pose x, y, angle."""
        mbs = self.mbs
        body, node = planar_body(mbs, mass, inertia, list(pose), list(velocity))
        marker = mbs.AddMarker(MarkerBodyPosition(bodyNumber=body))
        weight = [0.0, -mass * GRAVITY, 0.0]
        mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVector=weight))
        kinds = "Coordinates", "Coordinates_t"
        self._sensors.append([recorded(mbs, node, kind) for kind in kinds])
        self.nodes.append(node)
        return body

    def add_pin(self, first, second):
        """Pin two points, each (body, x), without clearance."""
        markers = [
            self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=body, localPosition=[x, 0.0, 0.0]))
            for body, x in (first, second)
        ]
        self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=markers))

    def run(self, tolerance, end, interval):
        """Return times (n,), and poses and velocities (bodies, n, 3) relative to the start."""
        self.mbs.Assemble()
        chosen = settings(end, 500, period=0.0, minimumStepSize=1e-12)

        def next_row(time):
            return (math.floor(time / interval + 1e-9) + 1) * interval

        solve_dynamic(self.mbs, chosen, tolerance=tolerance, next_corner=next_row).check()
        stored = np.array([[self.mbs.GetSensorStoredData(s) for s in b] for b in self._sensors])
        self._container.Reset()
        time = stored[0, 0, :, 0]
        rows = np.searchsorted(time, np.arange(0.0, end + 1e-9, interval) - 1e-9)
        return time[rows], stored[:, 0, rows, 1:], stored[:, 1, rows, 1:]
