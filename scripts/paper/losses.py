"""Power lost in the joints with clearance."""

import math

import numpy as np
from numpy.typing import NDArray

from exu_press.mechanism import mechanism_of
from exu_press.result import Result

__all__ = ["losses", "shear_loss"]

Array = NDArray[np.float64]


def losses(result: Result, inside: NDArray[np.bool_]) -> dict[str, float]:
    """Return mean powers over the instants that are `inside` (n,), W.

    Returns:
        balls: contact and friction in both; pin: contact, friction or the film's pressure;
        shear: the drag of the pin's sheared film, which the joint leaves out, since the crank's
        speed is given and nothing else feels it.
    """
    time = result.time[inside]
    span = float(time[-1] - time[0]) or 1.0
    lost = {"balls": 0.0, "pin": 0.0, "shear": 0.0}
    for name in result.clearance_joints:
        energy = result[f"{name}_loss"][inside]
        lost["pin" if name == "crank_pin" else "balls"] += float(energy[-1] - energy[0]) / span
    if result.scene.film is not None:
        lost["shear"] = float(np.trapezoid(shear_loss(result)[inside], time)) / span
    return lost


def shear_loss(result: Result) -> Array:
    r"""Return the power that shears the crank pin's film, (n,), W.

    .. math:: 2 \pi \mu L R^3 (\omega_J - \omega_B)^2 / (c \sqrt{1 - \varepsilon^2})

    Petroff's drag of the journal turning in its bearing, with Sommerfeld's factor for the
    eccentricity; the angular velocities are the ideal mechanism's.
    """
    scene = result.scene
    assert scene.film is not None and scene.contact is not None and scene.clearance is not None
    clearance = scene.clearance.crank_pin
    assert clearance is not None
    mechanism = mechanism_of(scene)
    motion = mechanism.motion(result["crank_angle"], scene.angular_speed)
    journal = motion[mechanism.crank].velocity[:, 2]
    bearing = motion[_bearing_of_the_pin(result)].velocity[:, 2]
    ratio = np.linalg.norm(result["crank_pin_eccentricity"], axis=1) / clearance
    scale = 2.0 * math.pi * scene.film.viscosity * scene.film.length * scene.contact.radius**3
    film = np.sqrt(np.maximum(1.0 - ratio**2, 1e-4))  # mixed: the asperities' gap, at least
    return np.asarray(scale * (journal - bearing) ** 2 / (clearance * film))


def _bearing_of_the_pin(result: Result) -> str:
    joints = mechanism_of(result.scene).joints
    return next(joint.bearing for joint in joints if joint.name == "crank_pin")
