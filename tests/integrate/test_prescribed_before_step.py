"""Motions that a pre-step function prescribes, as an offset's own function would."""

import math

import exudyn as exu
import numpy as np
import pytest

from exu_press import SolverStatus, solve_dynamic
from exudyn_examples.flexible import hold
from exudyn_examples.planar import rods

LAWS = {
    "turns": lambda time: 5.0 * time,
    "sways": lambda time: math.sin(6.0 * time),
    "sets in": lambda time: 5.0 * time * time / (time + 0.1),
    "stops at once": lambda time: 5.0 * min(time, 0.4137),
    "begins later": lambda time: 10.0 * max(time - 0.3, 0.0) ** 2,
}
"""Angles over time, rad."""


def settings(steps=100):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.timeIntegration.numberOfSteps = 1.0, steps
    chosen.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    chosen.solution.file.write = False
    return chosen


def driven(angle, by):
    """Two bars that hang on each other; the first one is turned."""
    mbs = exu.SystemContainer().AddSystem()
    _, _, nodes, _ = rods(mbs, (1.0, 1.0))
    own = {} if by == "step" else {"offsetUserFunction": lambda mbs, time, *_: angle(time)}
    (drive,) = hold(mbs, nodes[0], (2,), **own)
    if by == "step":

        def turn(mbs, time):
            mbs.SetObjectParameter(drive, "offset", angle(time))
            return True

        mbs.SetPreStepUserFunction(turn)
    mbs.Assemble()
    return mbs


def speeds(angle, by, tolerance, **how):
    """Velocities at the end, and the steps tried."""
    mbs = driven(angle, by)
    outcome = solve_dynamic(mbs, settings(), tolerance=tolerance, **how)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return mbs.systemData.GetODE2Coordinates_t(), outcome.steps + outcome.rejected_steps


@pytest.mark.filterwarnings("error::UserWarning")
@pytest.mark.parametrize("sample", [None, 0.0])
@pytest.mark.parametrize("law", LAWS)
def test_its_velocities_are_known_as_those_of_an_offset_are(law, sample):
    true, _ = speeds(LAWS[law], "offset", 1e-6)
    _, tries = speeds(LAWS[law], "offset", 1e-3)
    found, as_many = speeds(LAWS[law], "step", 1e-3, sample=sample)
    assert found == pytest.approx(true, abs=2e-3 * np.abs(true).max())
    assert as_many < 1.1 * tries


def test_what_is_set_once_goes_over():
    """An offset that is no function of time: Exudyn's fixed steps take one to change it."""
    mbs = driven(lambda time: 0.1, "step")
    outcome = solve_dynamic(mbs, settings())
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    assert mbs.systemData.GetODE2Coordinates()[2] == pytest.approx(0.1, abs=1e-9)


@pytest.mark.parametrize("how", [{"sample": 0.0}, {"hold": True}])
def test_what_is_held_at_another_place_is_named(how):
    mbs = driven(lambda time: 0.1, "step")
    with pytest.warns(UserWarning, match="its first step changes a speed by"):
        outcome = solve_dynamic(mbs, settings(), **how)
    assert outcome.status is SolverStatus.STEP_TOO_SMALL and outcome.steps == 0


def test_a_place_that_jumps_later_is_named():
    mbs = driven(lambda time: 0.2 * (time > 0.45), "step")
    with pytest.warns(UserWarning, match="or no offset that jumps"):
        outcome = solve_dynamic(mbs, settings())
    assert outcome.status is SolverStatus.STEP_TOO_SMALL
    assert outcome.end_time == pytest.approx(0.45, abs=1e-6)
