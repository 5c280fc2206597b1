"""Channels of clearance joints: eccentricity, force, moments, losses."""

from typing import TYPE_CHECKING

import numpy as np

from exu_press.joints.history import JointHistory, history
from exu_press.numerics.arrays import Array
from exu_press.numerics.piecewise import integral
from exu_press.result.channel import VECTOR, Channel, Declaration, Declarations
from exu_press.result.ideal_joints import vectors
from exu_press.result.recording import Record, Recording
from exu_press.scene.joint import has_even_gap, is_fed

if TYPE_CHECKING:
    from exu_press.model import Model
    from exu_press.model.warm_film import WarmFilm

__all__ = ["CHANNELS", "joint_histories", "record", "stored_and_lost"]

CHANNELS = Declarations(
    Declaration("{loose}_force", "N", "{loose}: force on journal", VECTOR),
    Declaration("{loose}_eccentricity", "m", "{loose}: journal minus bearing centre", VECTOR),
    Declaration("{loose}_moment", "N m", "{loose}: moment on journal and on bearing", "ends"),
    Declaration("{loose}_power", "W", "{loose}: dissipated power"),
    Declaration("{loose}_pump_power", "W", "{loose}: power of its supply pump", always=False),
    Declaration("{uneven}_gap", "m", "{uneven}: least gap of the surfaces, or -penetration"),
    Declaration(
        "{wearing}_normal_force", "N", "{wearing}: normal force of the contact", always=False
    ),
    Declaration("{wearing}_sliding", "m/s", "{wearing}: sliding velocity", always=False),
    Declaration("{loose}_loss", "J", "{loose}: energy dissipated since the start"),
    Declaration("{warm}_temperature", "deg C", "{warm}: temperature of the film"),
    Declaration("{warm}_viscosity", "Pa s", "{warm}: viscosity of the film"),
    Declaration("{warm}_side_flow", "m^3/s", "{warm}: oil that leaves the bearing's ends"),
    Declaration("{warm}_carried_off", "J", "{warm}: heat given to oil and frame since the start"),
)


def joint_histories(model: "Model", time: Array) -> dict[str, JointHistory]:
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


def record(run: Recording) -> Record:
    """Return the channels of the clearance joints, their energies, and the work of pumps."""
    model, time = run.model, run.time
    channels: dict[str, Channel] = {}
    all_stored, all_losses, pumped = (np.zeros_like(time) for _ in range(3))
    balls = {joint.name for joint in model.mechanism.joints if joint.spherical}
    for name, states in run.histories.items():
        stored, loss = stored_and_lost(states, time)
        all_stored += stored
        all_losses += loss
        channels |= CHANNELS.record(
            name,
            eccentricity=vectors(states.eccentricity, name in balls),
            force=vectors(states.force, name in balls),
            moment=states.moments_in_plane,
            power=states.dissipated_power,
            loss=loss,
        )
        if is_fed(model.scene.joints[name]):
            pumped += integral(time, states.pump_power)
            channels |= CHANNELS.record(name, pump_power=states.pump_power)
        if name in model.warm:
            channels |= _heat(model.warm[name], states, time, name)
        if len(states.rubbing):
            normal_force, sliding = states.rubbing.T
            channels |= CHANNELS.record(name, normal_force=normal_force, sliding=sliding)
        if not has_even_gap(model.scene.joints[name]):
            channels |= CHANNELS.record(name, gap=states.gap)
    return Record(channels, all_stored, all_losses, pumped)


def _heat(film: "WarmFilm", states: JointHistory, time: Array, name: str) -> dict[str, Channel]:
    """Return the channels of a film whose oil warms."""
    flow = film.side_flow(states)
    return CHANNELS.record(
        name,
        temperature=np.full_like(time, film.temperature),
        viscosity=np.full_like(time, film.viscosity),
        side_flow=flow,
        carried_off=integral(time, film.cooling(flow)),
    )
