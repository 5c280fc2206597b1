"""Parts of scripts/paper: readings, figures between bounds, verdicts, and the published results."""

import math

import numpy as np
import pytest

from paper.published import published
from paper.readings import MODELS, permanent_contact
from paper.runs import DAMPINGS, paper_runs
from paper.table import UNITS
from paper.value import Value, distance, product
from paper.verdicts import TRENDS, agreement, followed


def around(value, error=0.0):
    return Value(value, value - error, value + error)


def test_a_product_is_between_the_products_of_the_bounds():
    found = product(around(2.0, 0.1), Value(3.0, 2.0, 5.0, False), power=2.0)
    assert (found.value, found.low, found.high) == pytest.approx((18.0, 1.9 * 4.0, 2.1 * 25.0))
    assert not found.determined


def test_distances():
    aims = [10.0, 10.0]
    twice = [around(20.0, 1.0), Value(5.0, 5.0, 5.0)]
    found = distance(twice, aims)
    assert found.value == pytest.approx(math.log(2.0))
    # d sqrt((x^2 + y^2) / 2) / dx = x / (2 d), and here x = d
    assert found.error == pytest.approx(0.5 * 0.05)
    assert distance([around(10.0, 1.0), None], aims) is None
    assert not distance([around(10.0, 1.0), Value(9.0, 8.0, 11.0, False)], aims).determined


@pytest.mark.parametrize(
    ("value", "error", "verdict"),
    [
        (29.4, 0.1, "agrees"),
        (36.7, 0.01, "agrees"),
        (36.7, 1.0, "open"),
        (36.8, 0.01, "differs"),
        (36.8, 1.0, "open"),
        (22.1, 0.01, "agrees"),
        (20.0, 100.0, "open"),
        (0.2, 0.1, "differs"),
    ],
)
def test_agreement_is_within_a_quarter_whatever_the_error(value, error, verdict):
    assert agreement(around(value, error), 29.4) == verdict


KNOWN = [
    ("rises", [1.0, 1.2, 1.5], True),
    ("rises", [1.0, 1.01, 1.015], False),  # less than the least change
    ("rises", [1.0, 1.6, 1.3], False),  # falls in between
    ("rises", [1.0, 0.99, 1.3], True),  # by less than the least change
    ("falls", [3.0, 2.0], True),
    ("falls", [2.0, 3.0], False),
    ("rises, then falls", [1.0, 2.0, 3.0, 2.5], True),
    ("rises, then falls", [1.0, 2.0, 3.0, 3.0], False),
    ("falls, then rises", [3.0, 2.0, 2.0, 3.0], True),
    ("falls, then rises", [3.0, 2.0, 1.0, 0.5], False),
    ("negligible", [0.02, 0.0], True),
    ("negligible", [0.02, 0.5], False),
]


@pytest.mark.parametrize(("stated", "values", "holds"), KNOWN)
def test_trends(stated, values, holds):
    """Errors may leave each of them open; a run that stopped early has no verdict."""
    assert followed(stated, [around(v) for v in values]) == ("trend" if holds else "differs")
    assert followed(stated, [around(value, 10.0) for value in values]) == "open"
    assert followed(stated, [around(1.0), None]) == "no run" == agreement(None, 29.4)


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


def test_every_number_and_trend_has_its_runs():
    runs, literal = map(paper_runs, DAMPINGS)
    paper, name = published(), "clearance 0.2 mm"
    assert runs[name].contact["damping_max"] == 2.5545e8
    assert literal[name] == runs[name].replace({"contact.damping_max": 0.01})
    assert {number.run for number in paper.numbers} <= runs.keys()
    assert {run for trend in paper.trends for run in trend.runs} <= runs.keys()
    assert {trend.stated for trend in paper.trends} <= TRENDS.keys()
    measures = {entry.measure for entry in (*paper.numbers, *paper.trends)}
    assert measures <= UNITS.keys() and MODELS[1] == "mean_1ms"


@pytest.mark.parametrize(("length", "lasting"), [(0.9e-3, False), (1.1e-3, True)])
def test_a_touch_of_more_than_a_millisecond_is_permanent_contact(length, lasting):
    time = np.linspace(0.0, 0.1, 10001)
    depth = np.where((time > 0.05) & (time < 0.05 + length), 1e-6, -1e-6)
    assert permanent_contact(time, depth) == pytest.approx(length / 0.1 * lasting, rel=0.05)
