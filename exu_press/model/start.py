"""The start of flexible bodies: on the motion of ideal joints when vibrations are over."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from exu_press.errors import InputError
from exu_press.mechanism import Motion
from exu_press.model.drive import turned_body
from exu_press.model.quasi_static import quasi_static_motion
from exu_press.model.system import System
from exu_press.numerics.arrays import Array
from exu_press.scene import Scene

if TYPE_CHECKING:
    from exu_press.model.flexible_body import FrameStart
    from fe_models import FlexibleBody

__all__ = ["deformed_start"]

SMALL = 0.1
"""Deformation over a body's size, up to which it is small, and so linear in the modes."""


def deformed_start(
    ideal: System, drive: int, speed: float
) -> tuple[dict[str, Motion], dict[str, "FrameStart"]]:
    """Return the motion of the rigid bodies and the frames of the flexible ones at the start.

    Args:
        ideal: assembled, on the start of undeformed bodies; all joints are ideal.
        drive: object number of the constraint that turns the crank.
        speed: of the crank, rad/s.

    Raises:
        InputError: a body is so soft that it does not stay in shape.
    """
    from exu_press.model.flexible_body import deformed

    mbs = ideal.mbs
    turned = turned_body(ideal)
    coordinate = mbs.GetNodeODE2Index(ideal.nodes[turned])
    coordinate += ideal.rigid[turned].coordinates.index("angle")
    state = quasi_static_motion(mbs, drive, coordinate, speed)

    def parts_of(node: int) -> Iterator[Array]:
        indices = mbs.systemData.GetNodeLTGODE2(node)
        return (values[indices] for values in state)

    start, frames = {}, {}
    for name, rigid in ideal.rigid.items():
        q, q_t = (values[None, :] for values in parts_of(rigid.node))
        start[name] = rigid.motion(q, q_t, np.zeros_like(q))
    for name, body in ideal.flexible.items():
        modes = [np.zeros(0)] * 2 if body.node_modes is None else list(parts_of(body.node_modes))
        _refuse_too_compliant(ideal.scene, name, body, modes[0])
        frames[name] = deformed(mbs, body, *parts_of(body.node_rigid), *modes)
    return start, frames


def _refuse_too_compliant(scene: Scene, name: str, body: "FlexibleBody", modes: Array) -> None:
    """Refuse a body whose deformation is not small, or not a number, for its modal coordinates."""
    shift = np.linalg.norm((body.part.modes @ modes).reshape(-1, 3), axis=1).max(initial=0.0)
    share = shift / float(np.ptp(body.part.nodes, axis=0).max())
    if not share <= SMALL:
        given = scene.bodies[name].youngs_modulus
        than = "" if given is None else f" than {given:g} Pa"
        raise InputError(
            f"bodies.{name}: its ideal motion would bend it by {share:.2g} of its size; allowed is "
            f"{SMALL:g}, of a larger youngs_modulus{than} or at a lower speed_rpm"
        )
