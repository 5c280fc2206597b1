"""From a model's sensors to the motion of its bodies in the plane."""

import numpy as np
from numpy.typing import NDArray

from exu_press.mechanism import Motion
from exu_press.model import Model

__all__ = ["body_motion", "frame_motion", "point_acceleration", "sensor"]

Array = NDArray[np.float64]


def sensor(model: Model, name: str, quantity: str, *, with_time: bool = False) -> Array:
    """Return what a sensor recorded, (n, k)."""
    data = np.asarray(model.mbs.GetSensorStoredData(model.sensors[name, quantity]))
    return data if with_time else data[:, 1:]


def body_motion(model: Model, name: str) -> Motion:
    """Return position, velocity and acceleration (x, y, angle) of a body's frame, each (n, 3).

    The frame sits where the mechanism has the centre of mass; a flexible body's moves with the
    mean of the whole body.
    """
    if name not in model.rigid:
        return model.parts[name].body(frame_motion(model, name))
    return model.rigid[name].motion(
        *(sensor(model, name, level) for level in ("position", "velocity", "acceleration"))
    )


def frame_motion(model: Model, name: str) -> Motion:
    """Return the motion of the frame of a flexible body's solid, as `body_motion`."""
    position, velocity, acceleration = (
        sensor(model, name, level) for level in ("position", "velocity", "acceleration")
    )
    position = position + model.mbs.GetNodeParameter(model.nodes[name], "referenceCoordinates")
    turn = position[:, 3:]  # Euler parameters
    angle = np.unwrap(2.0 * np.arctan2(turn[:, 3], turn[:, 0]))
    about_z = 2.0 * np.column_stack([-turn[:, 3], -turn[:, 2], turn[:, 1], turn[:, 0]])
    ideal = model.mechanism.motion(np.array([model.scene.start_angle]), 1.0)[name]
    start = ideal.position[0, 2] - model.parts[name].angle
    angle += 2.0 * np.pi * np.round((start - angle[0]) / (2.0 * np.pi))
    return Motion(
        np.column_stack([position[:, :2], angle]),
        np.column_stack([velocity[:, :2], (about_z * velocity[:, 3:]).sum(axis=1)]),
        np.column_stack([acceleration[:, :2], (about_z * acceleration[:, 3:]).sum(axis=1)]),
    )


def point_acceleration(model: Model, name: str, point: Array) -> Array:
    """Return the acceleration (n, 3) of a point (3,) fixed in the frame of a flexible body.

    In space: the frame of a bending crank shaft tilts a little.
    """
    position, velocity, acceleration = (
        sensor(model, name, level) for level in ("position", "velocity", "acceleration")
    )
    start = model.mbs.GetNodeParameter(model.nodes[name], "referenceCoordinates")
    e_0, e = (position + start)[:, 3:4], (position + start)[:, 4:]  # Euler parameters
    arm = point + 2.0 * np.cross(e, np.cross(e, point) + e_0 * point)
    spin, turn = (
        2.0 * (e_0 * rate[:, 4:] - rate[:, 3:4] * e + np.cross(e, rate[:, 4:]))
        for rate in (velocity, acceleration)
    )
    swing = np.cross(turn, arm) + np.cross(spin, np.cross(spin, arm))
    return np.asarray(acceleration[:, :3] + swing)
