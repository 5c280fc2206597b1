"""Exudyn's own examples, to a tolerance: their errors follow it."""

from functools import cache

import pytest

from exu_press import SolverStatus
from exudyn_examples import EXAMPLES
from exudyn_examples.measure import error, run

ENDED = SolverStatus.COMPLETED, SolverStatus.UNDER_RESOLVED


@cache
def fine(name, tolerance, end):
    done = run(EXAMPLES[EXAMPLES[name].twin or name], tolerance=tolerance, end=end)
    assert done.outcome.status in ENDED, done.outcome.reason
    return done


def follows(name, tolerance, finest, end, most=10.0):
    example = EXAMPLES[name]
    done = run(example, tolerance=tolerance, end=end)
    # impacts of hard balls are found, but their peaks are not to be trusted at loose tolerances
    assert done.outcome.status in ENDED[: 1 + example.positions], done.outcome.reason
    reference = fine(name, 0.1 * max(finest, example.finest), end)
    assert 0.01 < error(done, reference, example.positions) / tolerance < most


def cases(*tolerances):
    return [(name, t) for name in EXAMPLES for t in tolerances if t >= EXAMPLES[name].finest]


SLOW = ("FFRF pendulum", "cantilever")


@pytest.mark.parametrize(
    ("name", "tolerance"),
    [pytest.param(*c, marks=[pytest.mark.long] * (c[0] in SLOW)) for c in cases(1e-3)],
)
def test_the_error_follows_the_tolerance(name, tolerance):
    follows(name, tolerance, 1e-3, EXAMPLES[name].short)


@pytest.mark.long
def test_a_wheel_at_the_origin_is_no_metre_large():
    """Its rounding was, so that its steps at 1e-6 were those of 1e-5."""
    example = EXAMPLES["balance wheel"]
    done = run(example, tolerance=1e-6, end=example.short)
    assert error(done, fine("balance wheel", 1e-7, example.short)) < 4e-6


@pytest.mark.long
@pytest.mark.parametrize(("name", "tolerance"), cases(1e-2, 1e-3, 1e-4, 1e-5, 1e-6))
def test_the_error_follows_the_tolerance_over_the_whole_run(name, tolerance):
    follows(name, tolerance, 1e-6, EXAMPLES[name].end, EXAMPLES[name].most)


@pytest.mark.parametrize(
    "name", ["heavy top", pytest.param("rotor run-up", marks=pytest.mark.long)]
)
def test_what_turns_many_times_is_no_phase_ahead(name):
    """9 and 38 tolerances off, while errors along the circle of Euler parameters were not seen."""
    end = 0.5 * EXAMPLES[name].end
    done = run(EXAMPLES[name], tolerance=1e-4, end=end)
    assert error(done, fine(name, 1e-5, end)) < 1e-3


def test_redundant_constraints_are_no_error():
    """The filter's last digits made errors of 1e12, and the run stopped at 1.24 s."""
    done = run(EXAMPLES["four-bar, redundant"], tolerance=1e-5, end=1.3)
    assert done.outcome.status is SolverStatus.COMPLETED, done.outcome.reason
    assert done.rejected < 10
