"""Steps follow a tolerance or keep to a grid; another controller may change them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from patched import PATCHED
from stand_in_system import mass_on_spring, settings

from exu_press.integrate import SolverStatus, solve_dynamic
from exu_press.integrate.controller import LimitedGrowth
from exu_press.integrate.stepping import FixedSteps, StepControl
from exu_press.integrate.task import SolverTuning

FREQUENCY = 10.0  # rad/s


class ProportionalIntegral:
    """G. Soederlind, ACM Transactions on Mathematical Software 29 (2003), PI.4.2 of order 3."""

    def __init__(self):
        self.before, self.accepted, self.repeats = 0.4, 0, 0

    def repeat_factor(self, error):
        self.repeats += 1
        return max(0.1, (0.4 / error) ** (1.0 / 3.0)) if error == error else 0.1

    def growth_factor(self, error):
        self.accepted += 1
        error = max(error, 1e-6)
        factor = (0.4 / error) ** (0.6 / 3.0) * (self.before / 0.4) ** (0.2 / 3.0)
        self.before = error
        return min(max(factor, 0.2), 2.0)


def oscillator(**keys):
    """Velocity at the end of a mass on a spring that starts displaced by 1 m, and the outcome."""
    mbs = mass_on_spring(FREQUENCY)
    outcome = solve_dynamic(mbs, settings(1.0), tolerance=1e-3, **keys)
    return float(mbs.systemData.GetODE2Coordinates_t()[0]), outcome


def test_a_controller_is_exchanged():
    """Its steps are others, and the run follows the tolerance as with ours."""
    controller = ProportionalIntegral()
    expected = -FREQUENCY * math.sin(FREQUENCY)
    ours, usual = oscillator()
    theirs, outcome = oscillator(controller=controller)
    assert outcome.status is SolverStatus.COMPLETED
    assert controller.accepted == outcome.steps != usual.steps
    assert controller.repeats == outcome.rejected_steps
    for velocity in (ours, theirs):
        assert velocity == pytest.approx(expected, abs=3e-3 * FREQUENCY)


def test_steps_stay_until_they_may_grow_by_the_whole_factor():
    tuning = SolverTuning()
    control = LimitedGrowth(tuning)
    edge = tuning.safety / tuning.factor_max**3
    assert control.growth_factor(1.01 * edge) == 1.0
    assert control.growth_factor(0.99 * edge) == tuning.factor_max
    assert control.repeat_factor(8.0 * tuning.safety) == pytest.approx(0.5)
    assert control.repeat_factor(math.nan) == tuning.factor_min
    assert control.repeat_factor(math.inf) == tuning.factor_min


def task(**changes):
    usual = {"largest": 1e-3, "smallest": 1e-9, "first": 1e-3, "start": 0.0, "end": 1.0}
    usual["no_shorter"] = 1.001e-9
    return SimpleNamespace(**{**usual, "tuning": SolverTuning(), **changes})


def test_fixed_steps_return_to_their_grid_after_a_halved_one():
    control, times = FixedSteps(task()), [0.0]
    for i in range(20):
        step = control.next_step(times[-1]) * (0.25 if i == 5 else 1.0)
        control.accept_step(step)
        times.append(times[-1] + step)
    off_grid = [abs(time / 1e-3 - round(time / 1e-3)) > 1e-9 for time in times]
    assert [i for i, off in enumerate(off_grid) if off] == [6, 7]
    assert np.diff(times)[-12:] == pytest.approx(1e-3)


class Estimate:
    """Errors that go with the cube of the step; 1 at a step (s)."""

    def __init__(self, good):
        self.good = good

    def __call__(self, step):
        return (step / self.good) ** 3

    def accept_step(self):
        pass

    def of_discontinuity(self, step):
        return self(step)


def steps(good, corner=math.inf, **changes):
    """Sizes of accepted steps to the end, and the number of repeated ones."""
    asked = task(**changes)

    def next_corner(time):
        return corner if time < corner else math.inf

    control = StepControl(asked, Estimate(good), next_corner)
    time, sizes, repeated = 0.0, [], 0
    while asked.end - time > 1e-12:
        step = control.next_step(time)
        while shorter := control.shorter(step):
            step, repeated = shorter, repeated + 1
        control.accept_step(step)
        sizes.append(step)
        time += step
    return sizes, repeated


@PATCHED
def test_steps_grow_slowly_to_what_their_errors_allow():
    sizes, repeated = steps(good=1e-3, first=1e-5, end=0.1)
    growth = np.array(sizes[1:-2]) / sizes[:-3]
    assert growth.max() == pytest.approx(SolverTuning().factor_max)
    aim = SolverTuning().safety ** (1.0 / 3.0) * 1e-3
    assert aim / SolverTuning().factor_max <= sizes[-5] <= aim
    assert repeated == 0


@PATCHED
def test_steps_end_on_corners_and_the_end():
    sizes, _ = steps(good=1.0, corner=2.3e-3, end=5.1e-3)
    times = np.cumsum(sizes)
    assert np.abs(times - 2.3e-3).min() < 1e-15 and times[-1] == pytest.approx(5.1e-3)
    assert min(sizes) > 0.5e-3, "nothing little is left before one"


@PATCHED
@pytest.mark.parametrize("apart", [0.0, 1e-16, 5e-13, 8e-10])
@pytest.mark.parametrize("number", range(1, 40, 13))
def test_a_corner_at_the_end_of_a_block_cuts_no_step_to_pieces(number, apart):
    """Both are multiples of a revolution, worked out differently: rounding tells them apart."""
    end = 0.1 * number / 7.0
    for corner in (end * (1.0 - apart), end * (1.0 + apart)):
        sizes, _ = steps(good=3e-4, first=1e-4, corner=corner, end=end)
        assert sum(sizes) == pytest.approx(end, rel=1e-14)
        assert min(sizes) > 0.9e-4


@PATCHED
def test_a_discontinuity_is_passed_by_a_step_that_cannot_be_shorter():
    """Its error is then that of the jump, which is held against the tolerance itself."""
    estimate = Estimate(1e-12)
    control = StepControl(task(), estimate, lambda time: math.inf)
    estimate.of_discontinuity = lambda step: 0.5
    assert control.shorter(1e-8) > 0.0
    assert control.shorter(1e-9) == 0.0


@PATCHED
def test_a_step_that_an_event_shortens_leaves_the_size_of_those_to_come():
    control = StepControl(task(), Estimate(1.1e-3), lambda time: math.inf)
    step = control.next_step(0.0)
    assert control.shorter(0.6 * step) == 0.0
    control.accept_step(0.6 * step, at_event=True)
    assert control.next_step(0.1) == pytest.approx(step)
