"""Period windows of the slider-crank's diagram at a tenth of the tolerance."""

import numpy as np
import pytest

from exu_press import Scene
from exu_press.studies.attractor import period_of
from exu_press.studies.attractor.orbit import Orbit

DRY = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 1e-4, "radius": 0.07}},
    contact={"length": 0.1},
)


def section(scene, revolutions):
    orbit = Orbit(scene)
    points = []
    for _ in range(revolutions):
        orbit.advance()
        points.append(orbit.point())
    orbit.close()
    return np.array(points)


@pytest.mark.long
@pytest.mark.parametrize(("clearance", "error"), [(4e-5, 1.2e-3), (7e-5, 4.7e-3)])
def test_the_period_and_the_point_stay(clearance, error):
    """The error that the diagram states at its own tolerance is what its point may be off."""
    scene = DRY.replace({"joints.crank_pin.clearance": clearance})
    coarse, fine = (section(scene.replace({"solver.tolerance": one}), 9) for one in (1e-3, 1e-4))
    for each in (coarse, fine):
        assert period_of(each[-3:], error, 1).revolutions == 1
    assert np.linalg.norm(coarse[-1] - fine[-1]) < error
