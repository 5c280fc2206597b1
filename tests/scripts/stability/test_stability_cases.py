"""The table of stiff and extreme cases."""

import json

import pytest

from exu_press.studies.stability.cases import PAIRS
from stability.cases import cases, quick_cases


@pytest.fixture(scope="module")
def table():
    return cases()


def test_at_least_200_cases_with_names_of_their_own(table):
    assert len(table) >= 200
    assert len({case.name for case in table}) == len(table)
    assert len({json.dumps(case.scene.to_dict()) for case in table}) > 0.9 * len(table)


def reached(table, key):
    """Return the smallest and the largest value of a key in the table."""
    *names, inner = key.split(".")
    tables = [case.scene.to_dict() for case in table]
    for name in names:
        tables = [data[name] for data in tables if name in data]
    values = [data[inner] for data in tables if inner in data]
    return min(values), max(values)


@pytest.mark.parametrize(
    ("key", "low", "high"),
    [
        ("contact.stiffness", 2.5545e7, 2.5545e13),
        ("contact.damping_max", 0.0, 2.55e10),
        ("joints.crank_pin.clearance", 1e-7, 1e-3),
        ("speed_rpm", 1.0, 3000.0),
        ("film.viscosity", 1e-5, 10.0),
        ("film.length", 0.0141, 0.56),
        ("friction.mu_static", 0.01, 1.0),
        ("load.blanking.force", 0.0, 2e6),
        ("load.blanking.rise", 1e-5, 1e-3),
        ("press.slider_mass", 13.47, 134700.0),
        ("bodies.crank.modes", 0, 60),
        ("solver.tolerance", 1e-7, 0.1),
        ("solver.step", 1e-6, 1e-3),
        ("gravity", 0.0, 9.81),
        ("revolutions", 0.0, 20.0),
    ],
)
def test_the_table_reaches_from_end_to_end(table, key, low, high):
    lowest, highest = reached(table, key)
    assert lowest <= low * 1.001 + 1e-3 * (key == "revolutions")
    assert highest >= high * 0.999


def test_the_quick_sample_holds_every_axis(table):
    sample = quick_cases()
    assert {case.axis for case in sample} == {case.axis for case in table}
    assert set(sample) <= set(table)
    assert sum(case.axis == PAIRS for case in sample) >= 15
