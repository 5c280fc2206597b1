"""Minima, intervals and what is not determined, of models with closed forms."""

import numpy as np
import pytest

from exu_press.studies.fit.identifiability import identifiability
from exu_press.studies.fit.jacobian import LARGEST, STEP, jacobian, steps
from exu_press.studies.fit.minimum import Minimum, evolve, search_minima, select_starts
from exu_press.studies.fit.profile import BRACKET, NOT_CONVERGED, OPEN, End, profile

AT = np.linspace(0.0, 3.0, 8)
UNCERTAINTY = 0.02
TRUE = np.array([0.7, 0.3])


def decay(x):
    """Amplitude and rate of an exponential, both from 0 to 2."""
    return 2.0 * x[0] * np.exp(-2.0 * x[1] * AT)


def against(measured, model=decay):
    def evaluate(points):
        return np.array([(model(x) - measured) / UNCERTAINTY for x in points])

    return evaluate


def fitted(evaluate, keys=2):
    step = np.full(keys, STEP)
    found, lost = search_minima(evaluate, select_starts(evaluate, keys, 3, 0), step)
    assert lost == 0
    return found, jacobian(evaluate, found[0].x, found[0].residuals, step)


def test_exact_numbers_give_the_true_keys():
    found, derivative = fitted(against(decay(TRUE)))
    assert found[0].x == pytest.approx(TRUE, abs=1e-3)
    assert found[0].times == 3
    told = identifiability(derivative, 0.95)
    exact = np.column_stack([decay(TRUE) / TRUE[0], -2.0 * AT * decay(TRUE)]) / UNCERTAINTY
    assert derivative == pytest.approx(exact, rel=5e-3, abs=0.1)
    assert told.deviation == pytest.approx(
        np.sqrt(np.diag(np.linalg.inv(exact.T @ exact))), rel=0.01
    )
    assert told.open == []


def test_intervals_hold_the_true_keys_as_often_as_they_say():
    rng = np.random.default_rng(3)
    held = np.zeros(2)
    number = 80
    for _ in range(number):
        evaluate = against(decay(TRUE) + UNCERTAINTY * rng.standard_normal(len(AT)))
        found, derivative = fitted(evaluate)
        for key in range(2):
            one = profile(evaluate, found[0], derivative, key, 0.95)
            held[key] += one.low.value <= TRUE[key] <= one.high.value
    assert held / number == pytest.approx([0.95, 0.95], abs=3.5 * np.sqrt(0.95 * 0.05 / number))


@pytest.mark.parametrize("power", [1, 2, 3, 4, 6, 8])
def test_an_end_is_where_chi_square_has_risen_however_late_it_rises(power):
    def evaluate(points):
        return 12.0 * np.abs(2.0 * points - 1.0) ** power * np.sign(points - 0.5)

    best = Minimum(np.array([0.5]), np.zeros(1))
    one = profile(evaluate, best, np.array([[24.0 * (power == 1)]]), 0, 0.95)
    half = 0.5 * (1.959964 / 12.0) ** (1.0 / power)
    assert (one.low.value, one.high.value) == pytest.approx((0.5 - half, 0.5 + half), abs=1e-3)
    assert one.low.remark == one.high.remark == ""


def test_an_end_that_was_not_bracketed_says_so_and_holds_all_that_is_allowed():
    """Chi-square rises within a millionth of the range at the far end of a plateau."""

    def evaluate(points):
        return np.where(np.abs(points - 0.3) > 0.123456, 1e4, 0.0)

    one = profile(evaluate, Minimum(np.array([0.3]), np.zeros(1)), np.array([[1e9]]), 0, 0.95)
    assert one.low.value <= 0.3 - 0.123456
    assert one.high.value >= 0.3 + 0.123456
    assert one.low.remark == one.high.remark == NOT_CONVERGED


def test_a_key_without_effect_and_two_that_act_as_one_are_named():
    def model(x):
        return decay([x[0] * (0.5 + x[2]), x[1]])

    measured = model([0.5, 0.3, 0.5, 0.5])
    found, derivative = fitted(against(measured, model), 4)
    told = identifiability(derivative, 0.95)
    assert told.rank == 2
    assert sorted(tuple(sorted(one.keys)) for one in told.open) == [(0, 2), (3,)]
    assert np.isfinite(told.deviation).tolist() == [False, True, False, False]
    one = profile(against(measured, model), found[0], derivative, 3, 0.95)
    assert (one.low, one.high) == (End(0.0, OPEN), End(1.0, OPEN))


def test_failed_runs_are_never_numbers():
    good = against(decay(TRUE))

    def evaluate(points):
        values = good(points)
        values[points[:, 0] > 0.75] = np.nan
        return values

    found, derivative = fitted(evaluate)
    assert found[0].x == pytest.approx(TRUE, abs=2e-3)
    assert np.isfinite(derivative).all()
    one = profile(evaluate, found[0], derivative, 0, 0.999999999)
    assert 0.75 < one.high.value <= 0.75 + BRACKET * (one.high.value - TRUE[0])
    assert one.high.remark == NOT_CONVERGED


def test_differential_evolution_finds_the_least_of_many_minima():
    def evaluate(points):
        ripple = np.sin(40.0 * points)
        return np.column_stack([10.0 * (points - 0.62) + 2.0 * ripple, 3.0 * ripple])

    best = evolve(evaluate, 1, 30, 0)
    grid = np.linspace(0.0, 1.0, 20001)[:, None]
    least = (evaluate(grid) ** 2).sum(axis=1).min()
    assert best.chi_square == pytest.approx(least, abs=0.02)
    assert evolve(lambda points: np.full((len(points), 2), np.nan), 1, 2, 0) is None


def test_steps_grow_until_they_are_seen_beyond_the_errors():
    evaluate = against(decay(TRUE))
    x = TRUE
    small = steps(evaluate, x, evaluate(x[None])[0], np.full(len(AT), 1e-6))
    assert small == pytest.approx([STEP, STEP])
    large = steps(evaluate, x, evaluate(x[None])[0], np.full(len(AT), 0.5))
    assert (large > STEP).all()
    assert (large <= LARGEST).all()

    def evaluate_in_range(points):
        assert points.max() <= 1.0
        return evaluate(points)

    edge = np.ones(2)
    steps(evaluate_in_range, edge, evaluate(edge[None])[0], np.full(len(AT), 0.5))


def test_a_point_that_is_better_than_the_minimum_is_reported():
    evaluate = against(decay(TRUE))
    off = np.array([0.72, 0.3])
    start = Minimum(off, evaluate(off[None])[0])
    derivative = jacobian(evaluate, off, start.residuals, np.full(2, STEP))
    one = profile(evaluate, start, derivative, 1, 0.95)
    assert one.better is not None
    assert one.better.chi_square < start.chi_square
