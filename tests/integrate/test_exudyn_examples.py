"""Exudyn's own examples, to a tolerance: their errors follow it."""

from functools import cache

import pytest

from exu_press import Status
from exudyn_examples import EXAMPLES
from exudyn_examples.measure import error, run

TOLERANCES = (1e-2, 1e-3, 1e-4)


@cache
def fine(name):
    return run(EXAMPLES[name], tolerance=0.1 * TOLERANCES[-1], end=EXAMPLES[name].short)


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("name", EXAMPLES)
def test_the_error_follows_the_tolerance(name, tolerance):
    done = run(EXAMPLES[name], tolerance=tolerance, end=EXAMPLES[name].short)
    assert done.outcome.status is Status.COMPLETED, done.outcome.reason
    assert 0.01 < error(done, fine(name)) / tolerance < 10.0
