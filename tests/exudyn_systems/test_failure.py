"""What is said where a refinement does not converge."""

import math
import os
import re
from time import sleep

import pytest
from exudyn_systems.models import double_pendulum, settings
from stand_in_system import oscillator

from exu_press import SolverStatus
from exu_press.exudyn_systems import solve_dynamic


def refused_result(system, chosen, **options):
    """Return the outcome of a run that misses its tolerance, of which a warning tells."""
    with pytest.warns(UserWarning, match="solve_dynamic: not converged: "):
        outcome = solve_dynamic(system, chosen, **options)
    assert outcome.status is SolverStatus.NOT_CONVERGED and not outcome.status.reached_end
    with pytest.raises(RuntimeError, match="not converged"):
        outcome.check()
    return outcome


def test_chaos_is_told_with_its_doubling_time():
    """Two bars upside down: errors grow e-fold in some tenths of a second."""
    outcome = refused_result(double_pendulum(0.1), settings(8.0, 300))
    doubling = float(re.search(r"double every (\S+) s \(chaos\)", outcome.reason)[1])
    assert 0.05 < doubling < 0.6
    until = float(re.search(r"agree within the tolerance up to (\S+) s", outcome.reason)[1])
    assert 1.5 < until < 7.5
    assert outcome.error is None or outcome.error.since == pytest.approx(until, rel=1e-3)
    assert outcome.end_time == pytest.approx(8.0)  # the system holds the finest level


def test_differences_that_do_not_fall_are_told():
    """A push whose side is decided by the last digits of the time at which a step ends."""
    mbs, spring, _ = oscillator()
    pushes = []

    def sample(mbs, time):
        if time > 1.0 and not pushes:
            pushes.append(math.sin(1e7 * time))
        return mbs.SetObjectParameter(spring, "offset", sum(pushes)) or True

    mbs.SetPreStepUserFunction(sample)
    outcome = refused_result(mbs, settings(2.0, 10))
    assert "differences do not fall: a right-hand side jumps" in outcome.reason
    until = float(re.search(r"agree within the tolerance up to (\S+) s", outcome.reason)[1])
    assert until == pytest.approx(1.0, abs=0.1)


def test_a_run_that_is_another_one_in_each_process_is_named():
    """Numbers that are drawn have each run differ; here earlier levels agree, and the last not."""
    mbs, spring, _ = oscillator()
    own = os.getpid()

    def sample(mbs, time):
        return mbs.SetObjectParameter(spring, "offset", 1.0 + (os.getpid() == own)) or True

    mbs.SetPreStepUserFunction(sample)
    outcome = refused_result(mbs, settings(2.0, 10), max_steps=50_000)
    assert "a user function gives other results in each run" in outcome.reason


def test_a_small_budget_says_which_one_would_do():
    outcome = refused_result(oscillator()[0], settings(20.0, 100), max_steps=2000)
    assert "the largest difference over its scale is that of the " in outcome.reason
    needed = int(re.search(r"max_steps = (\d+) would do", outcome.reason)[1])
    again = solve_dynamic(oscillator()[0], settings(20.0, 100), max_steps=needed)
    assert again.status is SolverStatus.COMPLETED
    assert sum(steps for steps, _ in outcome.levels) <= 2000


def test_levels_that_scatter_at_a_hard_wall_are_not_called_chaos():
    """The error of a bounce depends on where its first step begins; a larger budget resolves it."""

    def force(mbs, t, item, u, v, k, d, offset):
        return 100.0 * u + (1e7 * (u + 0.05) if u < -0.05 else 0.0)

    mbs = oscillator(force=force, start=0.1)[0]
    outcome = refused_result(mbs, settings(2.0, 400), tolerance=1e-4)
    needed = int(re.search(r"order is plausible; max_steps = (\d+) would do", outcome.reason)[1])
    assert 4e6 < needed < 1e7  # some 5e6: completed, with an error of 4e-7


def test_periods_that_no_level_resolves_are_told():
    outcome = refused_result(oscillator(stiffness=1e8)[0], settings(1.0, 16), max_steps=1000)
    needed = int(re.search(r"in steps of which (\d+) make the run", outcome.reason)[1])
    assert 1e4 < needed < 3e4  # ten steps in a period of 2 pi / 1e4 s


def test_a_budget_that_takes_days_is_no_cure():
    outcome = refused_result(oscillator(stiffness=1e18)[0], settings(1.0, 16), max_steps=1000)
    assert "max_steps" not in outcome.reason
    days = float(re.search(r"would do takes about (\S+) days; try a larger", outcome.reason)[1])
    assert days > 1.0


def slow_oscillator():
    """An oscillator whose spring takes a millisecond to say its force."""

    def force(mbs, t, item, u, v, k, d, offset):
        sleep(1e-3)
        return k * u

    return oscillator(force=force)[0]


@pytest.mark.parametrize("system", [slow_oscillator(), slow_oscillator], ids=["copies", "built"])
def test_a_run_that_is_out_of_time_in_its_first_levels_blames_the_budget(system):
    outcome = refused_result(system, settings(20.0, 1000), max_time=0.02)
    assert outcome.wall_time < 5.0
    assert "Newton" not in outcome.reason
    needed = re.search(
        r"the budget was too small for three levels .*; max_time = (\S+) would do", outcome.reason
    )
    assert float(needed[1]) > 0.02


def test_newton_fails_at_every_level_before_the_time_is_used_up():
    """A force that has no number from half of the time on."""

    def force(mbs, t, item, u, v, k, d, offset):
        return k * u if t < 1.0 else float("nan")

    outcome = refused_result(oscillator(force=force)[0], settings(2.0, 50), max_time=60.0)
    assert "Newton's method fails at every level (" in outcome.reason
    latest = float(re.search(r"at the latest at (\S+) s", outcome.reason)[1])
    assert latest == pytest.approx(1.0, abs=0.05)
    assert outcome.error is None
