"""A slow slider-crank without weight under a constant force against its closing."""

from exu_press import Scene, simulate


def pressed_slider_crank(force, offset=(0.0, 0.0), **scene):
    load = {"kind": "table", "time": [0.0, 1.0], "force": [force, force], "offset": offset}
    slow = {"mechanism": "slider_crank", "joints": {}, "gravity": 0.0, "speed_rpm": 5.0}
    result = simulate(Scene(**slow, load={"die": load}, **scene))
    assert result.completed, result.info["reason"]
    return result
