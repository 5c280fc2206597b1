"""What flexible crank and linkage do: deformation, energy, stress."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from exu_press.model import Model
from exu_press.result.energy import work
from exu_press.result.info import Stress
from exu_press.result.motion import body_motion, sensor
from exu_press.result.result import Channel

if TYPE_CHECKING:
    from fe_models import ReducedPart

__all__ = ["record_parts", "worst_stress"]

Array = NDArray[np.float64]


def record_parts(model: Model, time: Array) -> tuple[dict[str, Channel], Array, Array]:
    """Return the channels of the flexible bodies, their stored and their dissipated energy, J.

    Modes are orthogonal to rigid motions, so that kinetic energy is that of the undeformed body
    plus half of every modal velocity's square, to terms of the size of deformation over length.
    """
    channels: dict[str, Channel] = {}
    stored, dissipated = np.zeros_like(time), np.zeros_like(time)
    for name, part in model.parts.items():
        motion = body_motion(model, name)
        position, velocity = motion.position, motion.velocity
        q, q_t = modal(model, name, part, len(time))
        strain = 0.5 * (q**2) @ np.diag(part.stiffness_matrix)
        stored += _rigid_energy(part, position, velocity, model.scene.gravity)
        stored += 0.5 * (q_t**2).sum(axis=1) + strain
        assert model.scene.flexible is not None
        damping = np.diag(part.damping_matrix(model.scene.flexible.damping_ratio))
        dissipated += work(time, q_t * damping, q_t)
        channels[f"{name}_strain_energy"] = Channel(strain, "J", f"{name}: elastic energy")
        if part.mode_count:
            words = f"{name}: modal coordinates"
            channels[f"{name}_modes"] = Channel(q, "kg^0.5 m", words, f"{name}_mode")
        if name == "crank":
            moved = q @ part.interface("pin").translation.T
            channels["crank_pin_deflection"] = Channel(
                _turned(moved, position[:, 2]), "m", "crank pin: deflection of the throw", "plane"
            )
        else:
            big, small = part.interface("big bore"), part.interface("small bore")
            channels["linkage_elongation"] = Channel(
                q @ (small.translation - big.translation)[0], "m", "linkage: bores further apart"
            )
            channels["linkage_bending"] = Channel(
                q @ (small.rotation - big.rotation)[2], "rad", "linkage: bores turned apart"
            )
    return channels, stored, dissipated


def worst_stress(model: Model, time: Array) -> dict[str, Stress]:
    """Return the largest von Mises stress (Pa) of each part when its elastic energy is largest."""
    worst: dict[str, Stress] = {}
    for name, part in model.parts.items():
        if part.mode_count and len(part.stress):
            q, _ = modal(model, name, part, len(time))
            instant = int(np.argmax((q**2) @ np.diag(part.stiffness_matrix)))
            stress = float(part.von_mises(q[instant]).max())
            worst[name] = {"von_mises": stress, "time": float(time[instant])}
    return worst


def modal(model: Model, name: str, part: "ReducedPart", count: int) -> tuple[Array, Array]:
    """Return modal coordinates and their rates, (n, modes)."""
    if part.mode_count == 0:
        return np.zeros((count, 0)), np.zeros((count, 0))
    return sensor(model, f"{name}_modes", "position"), sensor(model, f"{name}_modes", "velocity")


def _rigid_energy(part: "ReducedPart", position: Array, velocity: Array, gravity: float) -> Array:
    """Return kinetic and potential energy of the undeformed body, (n,), J."""
    arm = _turned(np.tile(part.centre_of_mass[:2], (len(position), 1)), position[:, 2])
    spin = velocity[:, 2]
    centre_velocity = velocity[:, :2] + spin[:, None] * np.column_stack([-arm[:, 1], arm[:, 0]])
    about_centre = part.inertia[2, 2] - part.mass * (part.centre_of_mass[:2] ** 2).sum()
    kinetic = 0.5 * part.mass * (centre_velocity**2).sum(axis=1) + 0.5 * about_centre * spin**2
    return np.asarray(kinetic + part.mass * gravity * (position[:, 1] + arm[:, 1]))


def _turned(vectors: Array, angle: Array) -> Array:
    """Return the x and y of vectors (n, 2 or 3) of a body turned by angles (n,)."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors[:, 0], vectors[:, 1]
    return np.column_stack([c * x - s * y, s * x + c * y])
