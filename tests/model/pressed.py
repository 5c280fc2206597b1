"""What presses press against."""

from exu_press import Scene, simulate

FORMING = {
    "kind": "table",
    "height": [0.0, 0.001, 0.01, 0.03, 0.045],
    "force": [240e3, 240e3, 260e3, 180e3, 0.0],
}


def pressed_slider_crank(force, offset=(0.0, 0.0), **scene):
    """Run a slow slider-crank without weight under a constant force against its closing."""
    load = {"kind": "table", "time": [0.0, 1.0], "force": [force, force], "offset": offset}
    slow = {"mechanism": "slider_crank", "joints": {}, "gravity": 0.0, "speed_rpm": 5.0}
    result = simulate(Scene(**slow, load={"die": load}, **scene))
    assert result.completed, result.info["reason"]
    return result
