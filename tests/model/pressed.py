"""What presses press against."""

import numpy as np

from exu_press import Scene, simulate
from exu_press.model.start import quasi_static_motion
from exu_press.scene import mechanism_of

FORMING = {
    "kind": "table",
    "height": [0.0, 0.001, 0.01, 0.03, 0.045],
    "force": [240e3, 240e3, 260e3, 180e3, 0.0],
}


def static_modes(model, body):
    """Return the modal coordinates of a flexible body in its quasi-static motion."""
    mbs, scene = model.mbs, model.scene
    turned = mbs.GetNodeODE2Index(model.nodes["crank"])
    q, _ = quasi_static_motion(mbs, model.forces["drive", "force"], turned, scene.angular_speed)
    return q[mbs.systemData.GetNodeLTGODE2(model.nodes[f"{body}_modes"])]


def pressed_slider_crank(force, offset=(0.0, 0.0), **scene):
    """Run a slow slider-crank without weight under a constant force against its closing."""
    load = {"kind": "table", "time": [0.0, 1.0], "force": [force, force], "offset": offset}
    slow = {"mechanism": "slider_crank", "joints": {}, "gravity": 0.0, "speed_rpm": 5.0}
    result = simulate(Scene(**slow, load={"die": load}, **scene))
    assert result.completed, result.info["reason"]
    return result


def by_statics(result, force, mu):
    """Return side force, speed and drive torque of such a run, for where the slider slides.

    With S along the rod, N across: N = S sin, F + mu N = S cos on the way down, F - mu N on the way
    up.
    """
    size, speed = result.scene.slider_crank, result.scene.angular_speed
    angle = result["crank_angle"]
    sine = size.crank_radius * np.sin(angle) / size.rod_length
    tangent = sine / np.sqrt(1 - sine**2)
    velocity = mechanism_of(result.scene).ideal_slider(angle, speed)[1]
    side = force * tangent / (1 + mu * np.abs(tangent) * np.sign(velocity))
    torque = (-force * velocity + mu * np.abs(side * velocity)) / speed
    return side, velocity, torque
