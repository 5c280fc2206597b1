"""Channels of clearance joints: eccentricity, force, moments, losses."""

from collections.abc import Mapping

import numpy as np

from exu_press.joints import JointHistory, history
from exu_press.model import Model
from exu_press.model.warm_film import WarmFilm
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import integral
from exu_press.result.channel import Channel
from exu_press.result.declared import channel
from exu_press.result.forces import vectors

__all__ = ["joint_states", "record_joints", "stored_and_lost"]


def joint_states(model: Model, time: Array) -> dict[str, JointHistory]:
    """Return the states of every clearance joint at the recorded instants."""
    return {
        name: history(model.states, joint, time) for name, joint in model.clearance_joints.items()
    }


def stored_and_lost(states: JointHistory, time: Array) -> tuple[Array, Array]:
    """Return the energy that a joint stores, and its losses since the start, (n,), J.

    The losses are the integral of a power that is nowhere negative. As the difference of
    two larger energies, work and stored energy, they would fall where an impact gives back.
    """
    return states.stored_energy, integral(time, states.dissipated_power)


def _record_heat(
    film: WarmFilm, states: JointHistory, time: Array, name: str
) -> dict[str, Channel]:
    """Return the channels of a film whose oil warms."""
    flow = film.side_flow(states)
    channels: dict[str, Channel] = {}
    for quantity, values in (
        ("{warm}_temperature", np.full_like(time, film.temperature)),
        ("{warm}_viscosity", np.full_like(time, film.viscosity)),
        ("{warm}_side_flow", flow),
        ("{warm}_carried_off", integral(time, film.cooling(flow))),
    ):
        channels |= channel(quantity, values, name)
    return channels


def record_joints(
    model: Model, histories: Mapping[str, JointHistory], time: Array
) -> tuple[dict[str, Channel], Array, Array]:
    """Return the channels of the clearance joints, their stored and their dissipated energy, J."""
    channels: dict[str, Channel] = {}
    stored, dissipated = np.zeros_like(time), np.zeros_like(time)
    balls = {joint.name for joint in model.mechanism.joints if joint.spherical}
    for name, states in histories.items():
        elastic, lost = stored_and_lost(states, time)
        stored += elastic
        dissipated += lost
        for quantity, values in (
            ("{loose}_eccentricity", vectors(states.eccentricity, name in balls)),
            ("{loose}_force", vectors(states.force, name in balls)),
            ("{loose}_moment", states.moments_in_plane),
            ("{loose}_power", states.dissipated_power),
            ("{loose}_loss", lost),
        ):
            channels |= channel(quantity, values, name)
        if name in model.warm:
            channels |= _record_heat(model.warm[name], states, time, name)
        if len(states.rubbing):
            channels |= channel("{wearing}_normal_force", states.rubbing[:, 0], name)
            channels |= channel("{wearing}_sliding", states.rubbing[:, 1], name)
        if model.scene.joints[name].worn is not None:
            channels |= channel("{worn}_gap", states.gap, name)
    return channels, stored, dissipated
