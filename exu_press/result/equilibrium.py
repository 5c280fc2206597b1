"""Forces of ideal guides and pivots, by the equilibrium of their bodies.

Such a body has one coordinate (`exu_press.model.rigid_body`), so that no constraint tells the
force.
"""

from collections.abc import Mapping

import numpy as np

from exu_press.joints import JointHistory
from exu_press.mechanism import Motion
from exu_press.model import Model
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel
from exu_press.result.declared import channel
from exu_press.result.forces import guide_channels, vectors

__all__ = ["equilibrium"]


def equilibrium(
    model: Model,
    motions: Mapping[str, Motion],
    channels: Mapping[str, Channel],
    states: Mapping[str, JointHistory],
) -> dict[str, Channel]:
    """Return force and moment of the guides, and the pivots' forces on the journals.

    Args:
        model: integrated.
        motions: of every body.
        channels: with the loads and the forces of all joints that hold a coordinate or have
            clearance.
        states: motion and force of each clearance joint; ideal ones have no moment.
    """
    found: dict[str, Channel] = {}
    guides = {guide.body: guide for guide in model.mechanism.guides}
    masses = {body.name: body.mass for body in model.mechanism.bodies}

    def held(name: str) -> tuple[Array, Array]:
        """Return the reaction to all that acts on a body: force (n, 2) and moment (n,)."""
        applied, moment = _applied(model, name, motions[name], channels, states)
        weight = np.array([0.0, -masses[name] * model.scene.gravity])
        return masses[name] * motions[name].acceleration[:, :2] - applied - weight, -moment

    for name in sorted(model.holding.sliding):
        force, moment = held(name)
        across = force @ np.array(guides[name].across)
        found |= guide_channels(model, name, {"force": across, "moment": moment})
    for name, joint in model.holding.pivoted.items():
        if name in model.rigid:
            force = held(name)[0] * (1.0 if joint.journal == name else -1.0)
            found |= channel("{joint}_force", vectors(force, joint.spherical), joint.name)
    return found


def _applied(
    model: Model,
    name: str,
    motion: Motion,
    channels: Mapping[str, Channel],
    states: Mapping[str, JointHistory],
) -> tuple[Array, Array]:
    """Return force, (n, 2), and moment about its centre, (n,), of joints and loads on a body."""
    angle = motion.position[:, 2]
    cos, sin = np.cos(angle), np.sin(angle)
    force, moment = np.zeros((len(angle), 2)), np.zeros(len(angle))
    for joint in model.mechanism.joints:
        key = f"{joint.name}_force"
        for end, (body, (x, y)) in enumerate(model.mechanism.ends(joint)):
            if body == name and key in channels:
                on_body = (1.0, -1.0)[end] * channels[key].values[:, :2]
                arm_x, arm_y = x * cos - y * sin, x * sin + y * cos
                force += on_body
                moment += arm_x * on_body[:, 1] - arm_y * on_body[:, 0]
                if joint.name in states:
                    moment += states[joint.name].moments_in_plane[:, end]
    for key, (load, _) in model.loads.items():
        if load.body == name:
            pressed = channels[f"load_{key}_force"].values
            force += np.outer(pressed, load.direction)
            moment += load.moment(pressed, angle)
    return force, moment
