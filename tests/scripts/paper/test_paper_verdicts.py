"""Verdicts, and what errors leave of them."""

import pytest

from paper.value import Value
from paper.verdicts import agreement, followed


def around(value, error=0.0):
    return Value(value, value - error, value + error)


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


def test_a_run_that_stopped_early_has_no_verdict():
    assert agreement(None, 29.4) == "no run"
    assert followed("rises", [around(1.0), None]) == "no run"


TRENDS = [
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


@pytest.mark.parametrize(("stated", "values", "holds"), TRENDS)
def test_trends(stated, values, holds):
    assert followed(stated, [around(v) for v in values]) == ("trend" if holds else "differs")


@pytest.mark.parametrize(("stated", "values", "_"), TRENDS)
def test_errors_may_leave_a_trend_open(stated, values, _):
    assert followed(stated, [around(value, 10.0) for value in values]) == "open"
