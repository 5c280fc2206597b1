"""Points of diagrams: against an independent model of the press, and at a finer tolerance."""

import numpy as np
import pytest
from independent.reduced_slider_crank import Numbers
from independent.symmetric_press import SymmetricPress
from slider_cranks import section_points

from exu_press import Scene
from exu_press.studies.attractor import period_of

BALLS = 1e-4
REVOLUTIONS = 14
PRESS = Scene(joints={"crank_pin": "dry", "balls": {"kind": "dry", "clearance": BALLS}})
DRY = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", "clearance": 1e-4, "radius": 0.07}},
    contact={"length": 0.1},
)


def by_the_press(clearance):
    """Eccentricities of crank pin and ball in the section, (REVOLUTIONS, 3), over clearances."""
    scene = PRESS.replace({"joints.crank_pin.clearance": clearance})
    pin_x, pin_y, _, _, _, ball = np.array(section_points(scene, REVOLUTIONS))[:, :6].T
    return np.stack([pin_x, pin_y, ball], axis=1)


def by_the_reduced_press(clearance):
    """Those of the model that knows neither Exudyn nor this package."""
    model = SymmetricPress("lugre_steady", Numbers(clearance=clearance), BALLS)
    times = 0.25 * np.arange(1, REVOLUTIONS + 1)
    states = model.run(times, 1e-8)
    found = [model.eccentricities(t, q.tolist()) for t, q in zip(times, states[:3].T, strict=True)]
    return np.array([[e.real / clearance, e.imag / clearance, ball / BALLS] for e, ball in found])


@pytest.mark.validation(
    "independent",
    "dry press after 14 revolutions, period one",
    "reduced coordinates, own laws, SciPy's LSODA (`tests/independent/symmetric_press.py`)",
    "this package's",
)
@pytest.mark.long
@pytest.mark.parametrize(("clearance", "error"), [(2e-4, 6.7e-4), (2.5e-4, 2.0e-4), (3e-4, 1.0e-4)])
def test_both_have_the_same_period_and_points(clearance, error, compare):
    """Within the error that the diagram states, or what is left of the transient."""
    points, expected = by_the_press(clearance), by_the_reduced_press(clearance)
    name = f"eccentricity ratios at top dead centre, clearance {1e6 * clearance:g} um"
    compare(name, expected[-1], points[-1], error=error, abs=error)
    for each in (points, expected):
        assert period_of(each[-6:], error, 2).revolutions == 1


@pytest.mark.long
@pytest.mark.parametrize(("clearance", "error"), [(4e-5, 1.2e-3), (7e-5, 4.7e-3)])
def test_at_a_tenth_of_the_tolerance_the_period_and_the_point_stay(clearance, error):
    """The error that the diagram states at its own tolerance is what its point may be off."""
    scene = DRY.replace({"joints.crank_pin.clearance": clearance})
    coarse, fine = (
        np.array(section_points(scene.replace({"solver.tolerance": one}), 9))
        for one in (1e-3, 1e-4)
    )
    for each in (coarse, fine):
        assert period_of(each[-3:], error, 1).revolutions == 1
    assert np.linalg.norm(coarse[-1] - fine[-1]) < error
