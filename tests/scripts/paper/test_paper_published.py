"""The paper's results as data: complete, and beside runs that exist."""

import pytest

from paper.published import published
from paper.readings import MODELS
from paper.runs import DAMPINGS, paper_runs
from paper.table import UNITS
from paper.verdicts import TRENDS


def test_every_published_number_is_there():
    paper = published()
    numbers = [number.published for number in paper.numbers]
    assert sorted(numbers) == sorted(
        [4e-3, 4e-3, 1.2e-3, 3e-3, 17.8, 29.4, 57.44, 40.4, 70.2, 105.0, 0.438, 0.904, 34.0, 445.0,
         23.5, 69.1]
    )  # fmt: skip
    assert len(paper.peaks) == 9 and 17.8 not in [number.published for number in paper.peaks]
    assert len({(t.quantity, t.figure) for t in paper.trends}) == len(paper.trends) == 20
    assert [len(entry.hz) for entry in paper.frequencies] == [5, 5]


@pytest.mark.parametrize("damping", DAMPINGS)
def test_every_number_and_trend_has_its_runs(damping):
    runs, paper = paper_runs(damping), published()
    assert {number.run for number in paper.numbers} <= runs.keys()
    assert {run for trend in paper.trends for run in trend.runs} <= runs.keys()
    assert {trend.stated for trend in paper.trends} <= TRENDS.keys()
    measures = {entry.measure for entry in (*paper.numbers, *paper.trends)}
    assert measures <= UNITS.keys() and MODELS[1] == "mean_1ms"


def test_the_readings_of_the_damping_differ_in_it_alone():
    default, literal = (paper_runs(damping)["clearance 0.2 mm"] for damping in DAMPINGS)
    assert default.contact["damping_max"] == 2.5545e8
    assert literal == default.replace({"contact.damping_max": 0.01})
