"""Smooth motion is as good as its tolerance says."""

import numpy as np
import pytest

from exu_press import Scene, simulate

TOLERANCES = (1e-4, 1e-5, 2e-6)


@pytest.mark.parametrize("mechanism", ["slider_crank", "press"])
def test_velocities_of_an_ideal_mechanism_follow_the_tolerance(mechanism):
    errors = []
    for tolerance in TOLERANCES:
        scene = Scene(
            mechanism=mechanism, joints={}, revolutions=0.5, solver={"tolerance": tolerance}
        )
        run = simulate(scene)
        assert run.completed
        motion = scene.build().mechanism.ideal_slider(run["crank_angle"], scene.angular_speed)
        errors.append(np.abs(run["slider_velocity"] - motion[1]).max() / scene.pin_speed)
    for error, tolerance in zip(errors, TOLERANCES, strict=True):
        assert 0.1 * tolerance < error < 2.0 * tolerance
