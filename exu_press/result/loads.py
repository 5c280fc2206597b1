"""Channels of loads: force, moment and work."""

import numpy as np

from exu_press.result.channel import Channel, Declaration, Declarations
from exu_press.result.energy import work
from exu_press.result.recording import Record, Recording

__all__ = ["CHANNELS", "record"]

CHANNELS = Declarations(
    Declaration("load_{load}_force", "N", "load {load}: force"),
    Declaration("load_{load}_work", "J", "load {load}: work since the start"),
    Declaration(
        "load_{load}_moment",
        "N m",
        "load {load}: moment about its body's centre of mass, counter-clockwise",
        always=False,
        unless="where a load acts on the centre of mass",
    ),
)


def record(run: Recording) -> Record:
    """Return force, work and, beside the centre of mass, moment of every load."""
    model, time, scene = run.model, run.time, run.model.scene
    channels: dict[str, Channel] = {}
    all_work = np.zeros_like(time)
    loads = {name: acting.applied for name, acting in model.loads.items()}
    with_memory = [name for name, load in loads.items() if load.clock or load.sheet]
    memory = dict(zip(with_memory, model.remembered, strict=False))  # empty in a run of its own
    angle = scene.start_angle + scene.angular_speed * time + model.ahead[0]
    if scene.drive is not None:
        drawn_angle = model.mechanism.body(model.mechanism.crank).angle
        angle = run.turned.position[:, 2] - drawn_angle
    crank = angle, run.turned.velocity[:, 2]
    height = run["slider_position"] - model.mechanism.bottom, run["slider_velocity"]
    for name, load in loads.items():
        force = load.force(time, crank, height, memory.get(name))
        if load.body in model.parts:
            from exu_press.result.flexible import carried_motion

            placed = model.parts[load.body]
            velocity = carried_motion(model, load.body, placed.loads[name], load.point)[1]
        else:
            velocity = run.motions[load.body].point_motion(load.point).velocity
        load_work = work(time, force, velocity[:, :2] @ np.array(load.direction))
        all_work += load_work
        label = f"{name} on the {load.body.replace('_', ' ')}"
        channels |= CHANNELS.record(name, label=label, force=force, work=load_work)
        if load.point != (0.0, 0.0):
            moment = load.moment(force, run.motions[load.body].position[:, 2])
            channels |= CHANNELS.record(name, label=label, moment=moment)
    return Record(channels, supplied=all_work)
