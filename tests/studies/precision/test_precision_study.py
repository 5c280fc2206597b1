"""The study of a user's scene."""

import dataclasses
import itertools

import numpy as np
import pytest

from exu_press import Scene
from exu_press.studies.precision import case_of, precision
from exu_press.studies.precision.cases import QUICK
from exu_press.studies.precision.errors import Trajectory
from exu_press.studies.precision.references import divergence
from exu_press.studies.precision.table import horizon_text


@pytest.fixture(scope="module")
def report():
    """A lubricated slider-crank, against the package's own references."""
    scene = Scene(mechanism="slider_crank", revolutions=0.05)
    return precision(
        (case_of("mine", scene.replace({"joints.crank_pin": "lubricated"})),), quick=True
    )


def test_errors_follow_the_tolerance_and_the_reference_knows_how_good_it_is(report):
    errors = [row.error_position for row in report.rows if row.solver == "tolerance"]
    assert all(b < 1.01 * a for a, b in itertools.pairwise(errors))
    assert errors[-1] < 0.5 * errors[0]  # the last ones are the reference's own
    (stated,) = report.stated
    assert stated.covered >= 0.8 * stated.figures > 16
    reference = report.cases["mine"]["reference"]
    assert "extrapolated" in reference["method"]
    assert 0.0 < reference["difference"]["position"] < 1e-6


def test_a_horizon_is_measured_where_neighbours_part(report):
    """Two sliders part tenfold in 20 ms, from 1e-7 of a clearance on."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"})
    clearance = scene.joints["crank_pin"].clearance
    time = np.linspace(0.0, 0.2, 2001)
    one = Trajectory(time, np.zeros_like(time), np.zeros_like(time), np.zeros_like(time))
    apart = 1e-7 * clearance * 10.0 ** (time / 0.02)
    found = divergence(scene, one, dataclasses.replace(one, position=apart))
    assert found.horizon == pytest.approx(0.08, abs=2e-4)
    assert found.rate == pytest.approx(np.log(10.0) / 0.02, rel=1e-2)
    assert divergence(scene, one, one).horizon is None
    text = "\n".join(report.lines())
    assert "no horizon: trajectories " in text
    case = {"duration": 0.2, "horizon": 0.08, "lyapunov_exponent": found.rate}
    assert horizon_text(case) == "horizon 0.08 s: trajectories diverge tenfold in 0.02 s"


@pytest.mark.parametrize(
    ("changes", "closed_form"),
    [
        ({"mechanism": "slider_crank", "joints": {}}, True),
        ({"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}}, False),
        ({"joints": {}}, True),
        ({"joints": {"balls": "dry"}}, False),
        ({"joints": {"crank_pin": "lubricated", "balls": "dry"}}, False),
        ({"joints": {}, "guide": {"lateral_stiffness": 1e9}}, False),
        ({"joints": {}, "drive": {"rated_torque": 100.0, "inertia": 1.0}}, False),
    ],
)
def test_a_users_scene_gets_the_best_reference_there_is(changes, closed_form):
    """Kinematics where nothing gives, else the package's own tightest run."""
    case = case_of("mine", Scene(revolutions=0.01, **changes)).limit_to(QUICK)
    assert ("closed-form" in case.reference(QUICK).method) == closed_form
