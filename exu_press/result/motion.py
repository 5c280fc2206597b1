"""The motion of a model's bodies from its sensors."""

from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import Motion
from exu_press.mechanism.parts import DRIVE
from exu_press.numerics.arrays import Array

if TYPE_CHECKING:
    from exu_press.model import Model

__all__ = [
    "body_motion",
    "frame_motion",
    "moving_point",
    "point_acceleration",
    "point_motion",
    "sensor",
    "turned_vectors",
]


def sensor(model: "Model", name: str, quantity: str, *, with_time: bool = False) -> Array:
    """Return the record of a sensor, (n, k)."""
    data = np.asarray(model.mbs.GetSensorStoredData(model.sensors[name, quantity]))
    return data if with_time else data[:, 1:]


def body_motion(model: "Model", name: str) -> Motion:
    """Return position, velocity and acceleration (x, y, angle) of a body's frame, each (n, 3).

    The frame sits where the mechanism has the centre of mass; a flexible body's moves with the
    mean of the whole body.
    """
    if name not in model.rigid:
        return model.parts[name].body_motion(frame_motion(model, name))
    levels = ("position", "velocity", "acceleration")
    return model.rigid[name].motion(
        *(np.asfortranarray(sensor(model, name, level)) for level in levels)
    )


def frame_motion(model: "Model", name: str) -> Motion:
    """Return the motion of the frame of a flexible body's solid, as `body_motion`."""
    position, velocity, acceleration = (
        sensor(model, name, level) for level in ("position", "velocity", "acceleration")
    )
    position = position + model.mbs.GetNodeParameter(model.nodes[name], "referenceCoordinates")
    euler = position[:, 3:]
    angle = np.unwrap(2.0 * np.arctan2(euler[:, 3], euler[:, 0]))
    about_z = 2.0 * np.column_stack([-euler[:, 3], -euler[:, 2], euler[:, 1], euler[:, 0]])
    ideal = model.mechanism.motion(np.array([_crank_at_start(model)]), 1.0)[name]
    start = ideal.position[0, 2] - model.parts[name].angle
    angle += 2.0 * np.pi * np.round((start - angle[0]) / (2.0 * np.pi))
    return Motion(
        np.column_stack([position[:, :2], angle]),
        np.column_stack([velocity[:, :2], (about_z * velocity[:, 3:]).sum(axis=1)]),
        np.column_stack([acceleration[:, :2], (about_z * acceleration[:, 3:]).sum(axis=1)]),
    )


def _crank_at_start(model: "Model") -> float:
    """Return the crank's angle, rad, with the turns it has made before the run, if it goes on."""
    mechanism = model.mechanism
    turned = DRIVE if DRIVE in model.nodes else mechanism.crank
    if turned in model.rigid:
        at = sensor(model, turned, "position")[:1]
        pose = model.rigid[turned].motion(at, np.zeros_like(at), np.zeros_like(at)).position
        return float(pose[0, 2] - mechanism.body(mechanism.crank).angle)
    return model.scene.start_angle + model.scene.angular_speed * model.begin


def point_acceleration(model: "Model", name: str, point: Array) -> Array:
    """Return the acceleration (n, 3) of a point (3,) fixed in the frame of a flexible body.

    In space: the frame of a bending crank shaft tilts a little.
    """
    e_0, e, velocity = _in_space(model, name)
    acceleration = sensor(model, name, "acceleration")
    omega, alpha = (_angular_velocity(e_0, e, rates[:, 3:]) for rates in (velocity, acceleration))
    arm = _rotate(e_0, e, point)
    swing = np.cross(alpha, arm) + np.cross(omega, np.cross(omega, arm))
    return np.asarray(acceleration[:, :3] + swing)


def point_motion(model: "Model", name: str, point: Array) -> tuple[Array, Array, Array]:
    """Return height, velocity and angular velocity of a point (3,) of a flexible body's frame.

    In space: the height (n,), m, and the velocity (n, 3), m/s, are global; the frame's angular
    velocity (n, 3), rad/s, is in its own axes.
    """
    e_0, e, velocity = _in_space(model, name)
    omega, arm = _angular_velocity(e_0, e, velocity[:, 3:]), _rotate(e_0, e, point)
    height = frame_motion(model, name).position[:, 1] + arm[:, 1]
    return height, velocity[:, :3] + np.cross(omega, arm), _rotate(e_0, -e, omega)


def moving_point(model: "Model", name: str, position: Array, rate: Array) -> tuple[Array, Array]:
    """Return position and velocity (n, 3) of a point that moves in a flexible body's frame.

    Args:
        model: integrated.
        name: of the body.
        position: (n, 3) in its frame, m.
        rate: (n, 3) of the place, m/s.
    """
    e_0, e, velocity = _in_space(model, name)
    omega, arm = _angular_velocity(e_0, e, velocity[:, 3:]), _rotate(e_0, e, position)
    start = model.mbs.GetNodeParameter(model.nodes[name], "referenceCoordinates")
    position = (sensor(model, name, "position") + start)[:, :3]
    rate_in_space = velocity[:, :3] + np.cross(omega, arm) + _rotate(e_0, e, rate)
    return np.asarray(position + arm), np.asarray(rate_in_space)


def turned_vectors(model: "Model", name: str, vectors: Array) -> Array:
    """Return vectors (n, 3) of a flexible body's frame in global axes, (n, 3)."""
    e_0, e, _ = _in_space(model, name)
    return _rotate(e_0, e, vectors)


def _in_space(model: "Model", name: str) -> tuple[Array, Array, Array]:
    """Return the Euler parameters of a flexible body's frame, (n, 1) and (n, 3), and all rates."""
    start = model.mbs.GetNodeParameter(model.nodes[name], "referenceCoordinates")
    rotation = (sensor(model, name, "position") + start)[:, 3:]
    return rotation[:, :1], rotation[:, 1:], sensor(model, name, "velocity")


def _rotate(e_0: Array, e: Array, vectors: Array) -> Array:
    """Return vectors, (3,) or (n, 3), turned from the frame to global axes, (n, 3)."""
    return np.asarray(vectors + 2.0 * np.cross(e, np.cross(e, vectors) + e_0 * vectors))


def _angular_velocity(e_0: Array, e: Array, rates: Array) -> Array:
    """Return the angular velocity of rates (n, 4) of the Euler parameters, global axes, (n, 3)."""
    return np.asarray(2.0 * (e_0 * rates[:, 1:] - rates[:, :1] * e + np.cross(e, rates[:, 1:])))
