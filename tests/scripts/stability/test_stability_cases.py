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


def test_the_table_reaches_from_end_to_end(table):
    scenes = [case.scene for case in table]
    speeds = [scene.speed_rpm for scene in scenes]
    viscosities = [
        film["viscosity"] for film in (s.film or {} for s in scenes) if "viscosity" in film
    ]
    assert (min(speeds), max(speeds)) == (1.0, 3000.0)
    assert min(viscosities) <= 1e-5 and max(viscosities) >= 10.0


def test_the_quick_sample_holds_every_axis(table):
    sample = quick_cases()
    assert {case.axis for case in sample} == {case.axis for case in table}
    assert set(sample) <= set(table)
    assert sum(case.axis == PAIRS for case in sample) >= 15
