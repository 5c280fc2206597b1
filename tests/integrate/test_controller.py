"""What changes steps for their errors, and that another one may take its place."""

import math

import pytest
from stand_in_system import mass_on_spring, settings

from exu_press.integrate import SolverStatus, solve_dynamic
from exu_press.integrate.controller import LimitedGrowth
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
