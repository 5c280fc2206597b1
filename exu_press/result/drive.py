"""Channels of drive, flywheel, clutch and brake."""

from typing import TYPE_CHECKING

import numpy as np

from exu_press.mechanism.parts import DRIVE, FLYWHEEL
from exu_press.numerics.arrays import Array
from exu_press.result.channel import NO_BRAKE, NO_CLUTCH, Declaration, Declarations
from exu_press.result.energy import work
from exu_press.result.motion import sensor
from exu_press.result.recording import Record, Recording

if TYPE_CHECKING:
    from exu_press.model import Model
    from exu_press.model.start_stop import StartStop

__all__ = ["CHANNELS", "record"]

CHANNELS = Declarations(
    Declaration("crank_speed", "rad/s", "angular velocity of the drive"),
    Declaration("drive_torque", "N m", "torque of the drive; a motor's turns flywheel and crank"),
    Declaration("drive_power", "W", "power of the drive"),
    Declaration("flywheel_speed", "rad/s", "angular velocity of the flywheel", unless=NO_CLUTCH),
    Declaration("clutch_torque", "N m", "torque of the clutch on the crank", unless=NO_CLUTCH),
    Declaration("clutch_loss", "J", "clutch: energy dissipated since the start", unless=NO_CLUTCH),
    Declaration("brake_torque", "N m", "torque of the brake, against the crank", unless=NO_BRAKE),
    Declaration("brake_loss", "J", "brake: energy dissipated since the start", unless=NO_BRAKE),
    Declaration("crank_torque", "N m", "torque that turns the crank, behind the flywheel"),
)


def record(run: Recording) -> Record:
    """Return torque, power and work of the drive, and the energy of its flywheel."""
    model, speed = run.model, run.turned.velocity[:, 2]
    flywheel = 0.0 if model.scene.drive is None else model.scene.drive.on_crank
    torque = -sensor(model, "drive", "force")[:, 0]
    on_crank = torque - flywheel * run.turned.acceleration[:, 2]
    energy = 0.5 * flywheel * speed**2 if DRIVE in model.nodes else 0.0  # it is on no body
    drive = Record(CHANNELS.record(crank_speed=speed, drive_torque=torque), energy)
    if model.start_stop is not None:
        drive += _start_stop(model, model.start_stop, run.time, speed)
        on_crank = drive.channels["clutch_torque"].values
        speed = drive.channels["flywheel_speed"].values
    channels = CHANNELS.record(drive_power=torque * speed, crank_torque=on_crank)
    return drive + Record(channels, supplied=work(run.time, torque, speed))


def _start_stop(model: "Model", start_stop: "StartStop", time: Array, crank_speed: Array) -> Record:
    """Return flywheel, clutch and brake.

    The work on a clutch or brake is dissipated, but for the twist of its shafts.
    """
    motor = model.scene.drive
    assert motor is not None
    wheel = sensor(model, FLYWHEEL, "velocity")[:, 0]
    channels = CHANNELS.record(flywheel_speed=wheel)
    stored, dissipated = 0.5 * motor.inertia * wheel**2, np.zeros_like(time)
    for name, disc, rate in (
        ("clutch", start_stop.clutch, wheel - crank_speed),
        ("brake", start_stop.brake, crank_speed),
    ):
        if disc is None:
            continue
        torque = sensor(model, name, "torque")[:, 0]
        twist_energy = 0.5 * torque**2 / disc.coupling.stiffness
        loss = work(time, torque, rate) - (twist_energy - twist_energy[0])
        channels |= CHANNELS.record(**{f"{name}_torque": torque, f"{name}_loss": loss})
        stored = stored + twist_energy
        dissipated += loss
    return Record(channels, stored, dissipated)
