"""Runs so short that rounding is felt: steps of microseconds to nanoseconds."""

import exudyn as exu
import numpy as np
import pytest

from exu_press import SolverStatus, solve_dynamic
from exudyn_examples.planar import four_bar, rods, slider_crank, truss


def solved(mbs, end, tolerance):
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = end, 200
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    settings.solution.file.write = False
    outcome = solve_dynamic(mbs, settings, tolerance=tolerance, max_steps=1000)
    assert outcome.status is SolverStatus.COMPLETED
    return np.array(mbs.systemData.GetODE2Coordinates_t())


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
@pytest.mark.parametrize("rise", [0.1, 0.01, 1e-3])
def test_a_truss_nearly_in_a_line_leaves_short_steps_alone(rise, tolerance):
    """Its last digits, a hundred times those of its length, were taken for errors of steps."""
    mbs = exu.SystemContainer().AddSystem()
    rods(mbs, [1.0])
    truss(mbs, rise)
    end = 1e-3
    found = solved(mbs, end, tolerance)
    assert found[2] == pytest.approx(-1.5 * 9.81 * end, rel=10.0 * tolerance)
    assert np.abs(found[3:]).max() < 1e-3 * abs(found[2])


def setting_out(mechanism, end, tolerance):
    """Return the velocities at the end over its time, the accelerations of the start."""
    mbs = exu.SystemContainer().AddSystem()
    mechanism(mbs)
    return solved(mbs, end, tolerance) / end


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
@pytest.mark.parametrize("end", [1e-4, 1e-5])
@pytest.mark.parametrize("mechanism", [four_bar, slider_crank])
def test_a_mechanism_sets_out_in_a_run_of_any_length(mechanism, end, tolerance):
    """Differences of constraints over nanoseconds are rounding, and no rate of accelerations."""
    expected = setting_out(mechanism, 1e-3, tolerance)
    allowed = 3e-3 * np.abs(expected).max()
    assert setting_out(mechanism, end, tolerance) == pytest.approx(expected, abs=allowed)


@pytest.mark.parametrize("mechanism", [four_bar, slider_crank])
def test_steps_that_only_rounding_moves_by_are_named(mechanism):
    """At speeds of 1e-5 m/s in steps of 5 ns accelerations were 3 % off, in silence."""
    with pytest.warns(UserWarning, match="errors were not judged; longer steps"):
        setting_out(mechanism, 1e-6, 1e-3)
