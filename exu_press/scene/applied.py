"""The loads of a scene on their mechanism, none of which is loaded where there are none."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism import Mechanism
from exu_press.mechanism.spring_motion import spring_motion
from exu_press.numerics.arrays import Array
from exu_press.scene.scene import Scene

if TYPE_CHECKING:
    from exu_press.scene.applied_load import AppliedLoad

__all__ = ["applied_loads", "holding_torque"]


def applied_loads(scene: Scene) -> dict[str, "AppliedLoad"]:
    """Return the loads of a scene that are not zero throughout, by name."""
    if not scene.load:
        return {}
    from exu_press.scene.applied_load import applied_load

    loads = {name: applied_load(load, scene) for name, load in scene.load.items()}
    # the peak of a load of a result may be unknown
    return {name: load for name, load in loads.items() if not load.curve.peak <= 0.0}


def holding_torque(
    mechanism: Mechanism, scene: Scene, forces: Mapping[str, Array], angle: Array
) -> Array:
    """Return the torque (n,), N m, at the crank that balances loads, springs and weights.

    By virtual work, without friction.

    Args:
        mechanism: ideal.
        scene: with the loads.
        forces: name of a load -> its force (n,), of forming just before the output came to rest, N.
        angle: of the crank, (n,), rad.
    """
    per_angle = mechanism.motion(angle, 1.0)
    torque = np.zeros_like(angle)
    for body in mechanism.bodies:
        torque += body.mass * scene.gravity * per_angle[body.name].velocity[:, 1]
    closes = mechanism.output_component(per_angle[mechanism.slider].velocity) < 0.0
    loads = applied_loads(scene) if forces else {}
    for name, force in forces.items():
        load = loads[name]
        along = per_angle[load.body].point_motion(load.point).velocity[:, :2]
        work = force * (along @ np.array(load.direction))
        torque -= work if load.fade is None else np.where(closes, work, 0.0)
    for spring in mechanism.springs:
        motion = spring_motion(mechanism, spring, per_angle)
        torque -= spring.static_force(motion.length) * motion.rate
    return torque
