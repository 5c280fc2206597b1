"""The study of a user's scene."""

import itertools

import pytest

from exu_press import Scene
from exu_press.studies.precision import case_of, precision
from exu_press.studies.precision.table import report_lines


@pytest.fixture(scope="module")
def report():
    """A lubricated slider-crank, against the package's own references."""
    scene = Scene(mechanism="slider_crank", revolutions=0.1)
    return precision(
        (case_of("mine", scene.replace("joints.crank_pin", "lubricated")),), quick=True
    )


def test_the_error_follows_the_tolerance(report):
    errors = [row.error_position for row in report.rows if row.solver == "tolerance"]
    assert all(b < 1.01 * a for a, b in itertools.pairwise(errors))
    assert errors[-1] < 0.5 * errors[0]  # the last ones are the reference's own


def test_the_reference_knows_how_good_it_is(report):
    reference = report.cases["mine"]["reference"]
    assert "extrapolated" in reference["method"]
    assert 0.0 < reference["difference"]["position"] < 1e-6


def test_the_table_holds_every_run(report):
    text = "\n".join(report_lines(report))
    assert text.count("completed") + text.count("failed") >= len(report.rows)
    assert report.machine["processor"] in text and not report.goals


@pytest.mark.parametrize(
    ("changes", "reference"),
    [
        ({"mechanism": "slider_crank", "joints": {}}, "closed form"),
        ({"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}}, "own"),
        ({"joints": {}}, "closed form"),
        ({"joints": {"balls": "dry"}}, "own"),
        ({"joints": {"crank_pin": "lubricated", "balls": "dry"}}, "own"),
    ],
)
def test_a_users_scene_gets_the_best_reference_there_is(changes, reference):
    assert case_of("mine", Scene(**changes)).reference == reference
