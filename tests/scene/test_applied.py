"""Loads where they act on their bodies, by hand."""

import math

import numpy as np
import pytest

from exu_press import Scene
from exu_press.scene.applied import applied_loads

FORCE = np.array([100.0])


@pytest.mark.parametrize(
    ("offset", "direction", "turned", "moment"),
    [
        ((0.0, 0.2), (1.0, 0.0), 0.0, -20.0),  # to the right, above the centre: clockwise
        ((0.0, 0.2), (1.0, 0.0), math.pi / 2.0, 0.0),  # the point lies to the left then
        ((0.0, 0.2), (0.0, 1.0), math.pi / 2.0, -20.0),
        ((0.3, 0.0), (0.0, 1.0), 0.0, 30.0),
        ((0.3, 0.0), (1.0, 0.0), math.pi / 2.0, -30.0),
        ((0.3, 0.2), (3.0, 4.0), 0.0, 0.3 * 80.0 - 0.2 * 60.0),
    ],
)
def test_the_moment_of_a_load_beside_the_centre_of_mass(offset, direction, turned, moment):
    pulse = {"kind": "table", "time": [0.0, 1.0], "force": [1.0, 1.0], "body": "slider"}
    load = {**pulse, "offset": list(offset), "direction": list(direction)}
    scene = Scene(mechanism="slider_crank", joints={}, load={"a": load})
    applied = applied_loads(scene)["a"]
    assert applied.moment(FORCE, np.array([turned]))[0] == pytest.approx(moment, abs=1e-12)
