"""After how many revolutions points come back, judged against their error."""

import numpy as np
import pytest

from exu_press import InputError
from exu_press.studies.attractor import period_of
from exu_press.studies.attractor.period import APART

ERROR = 1e-4
RANDOM = np.random.default_rng(5)


def repeated(pattern, count=60, noise=0.0):
    """Return points that repeat a pattern, with noise."""
    points = np.resize(np.array(pattern, dtype=float), (count,))[:, None]
    return np.hstack([points, -points]) + noise * RANDOM.standard_normal((count, 2))


@pytest.mark.parametrize("period", [1, 2, 3, 8])
def test_a_pattern_has_its_period(period):
    found = period_of(repeated(RANDOM.uniform(size=period), noise=0.2 * ERROR), ERROR, 16)
    assert (found.revolutions, found.is_decided) == (period, True)


def test_chaos_has_none():
    x = [0.3]
    for _ in range(80):
        x.append(4.0 * x[-1] * (1.0 - x[-1]))
    found = period_of(np.array(x)[:, None], ERROR, 16)
    assert (found.revolutions, found.is_decided) == (None, True)
    assert str(found) == "none up to 16 revolutions"


def test_what_the_error_hides_is_not_told_apart():
    """Points that alternate by five times their error may be one point or two."""
    found = period_of(repeated([0.0, 5.0 * ERROR / np.sqrt(2.0)], noise=1.5 * ERROR), ERROR, 8)
    assert not found.is_decided
    assert 0.1 < found.finer < 1.0
    assert "undecided (points lie" in str(found)
    finer = period_of(repeated([0.0, 5.0 * ERROR / np.sqrt(2.0)]), ERROR / 100.0, 8)
    assert finer.revolutions == 2


def test_a_motion_that_still_settles_is_not_told():
    points = repeated([1.0]) + np.exp(-0.05 * np.arange(60))[:, None]
    found = period_of(points, 1e-6, 8)
    assert not found.is_decided
    assert "skip more revolutions" in str(found)


def test_too_few_revolutions_are_refused():
    with pytest.raises(InputError, match="47 revolutions in the section: allowed are at least 48"):
        period_of(repeated([1.0], 47), ERROR, 16)


def test_what_diverges_has_no_period_within_a_large_error():
    points = 1e-3 * np.random.default_rng(1).normal(size=(40, 2))
    assert str(period_of(points, error=0.005, most=4)) == "1 revolution"
    told = period_of(points, error=0.005, most=4, diverging=True)
    assert not told.is_decided and told.revolutions is None
    assert "neighbours part" in str(told) and told.finer < 1.0
    assert told.finer * 0.005 * APART == pytest.approx(told.distances.min())


@pytest.mark.parametrize(("scatter", "error"), [(0.03, 0.04), (0.003, 0.04), (0.03, 0.009)])
def test_points_that_scatter_within_a_large_error_are_not_the_same(scatter, error):
    """A dry press with 20 um scatters by a tenth of that: "1 revolution" for an error of 4 %."""
    points = scatter / 3.0 * np.random.default_rng(1).uniform(-1.0, 1.0, size=(40, 2))
    told = period_of(points, error=error, most=4)
    assert not told.is_decided and told.revolutions is None
    assert 0.0 < told.finer * error <= 0.01
