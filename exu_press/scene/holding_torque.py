"""The torque with which loads, springs and weights turn a crank."""

from collections.abc import Mapping

import numpy as np

from exu_press.mechanism import Mechanism
from exu_press.mechanism.spring_motion import spring_motion
from exu_press.numerics.arrays import Array
from exu_press.scene.scene import Scene

__all__ = ["holding_torque"]


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
    loads = scene.applied_loads if forces else {}
    for name, force in forces.items():
        load = loads[name]
        along = per_angle[load.body].point_motion(load.point).velocity[:, :2]
        work = force * (along @ np.array(load.direction))
        torque -= work if load.fade is None else np.where(closes, work, 0.0)
    for spring in mechanism.springs:
        motion = spring_motion(mechanism, spring, per_angle)
        torque -= spring.static_force(motion.length) * motion.rate
    return torque
