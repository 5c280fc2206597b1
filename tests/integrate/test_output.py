"""Rows of sensors lie on the settings' grid; a run can go on where another one ended."""

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import SolverStatus, solve_dynamic
from exu_press.integrate.output import within
from exudyn_examples.other import mass_1d

OMEGA = 7.0  # 1/s


def spring():
    """A mass on a spring at a metre, x = cos(omega t), and its sensor."""
    mbs = exu.SystemContainer().AddSystem()
    ends = mass_1d(mbs, 1.0, place=1.0)
    mbs.AddObject(
        items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, stiffness=OMEGA**2)
    )
    sensors = [
        mbs.AddSensor(items.SensorNode(nodeNumber=0, storeInternal=True, outputVariableType=kind))
        for kind in (exu.OutputVariableType.Coordinates, exu.OutputVariableType.Coordinates_t)
    ]
    mbs.Assemble()
    return mbs, sensors


def settings(end=1.0, period=0.01):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime, chosen.solution.file.write = end, False
    chosen.timeIntegration.numberOfSteps = 20
    chosen.solution.sensors.writePeriod = period
    return chosen


@pytest.mark.parametrize("period", [0.01, 1e-3, 0.3])
def test_rows_lie_on_the_grid_and_on_the_motion(period):
    mbs, (position, velocity) = spring()
    called = []
    mbs.SetPostStepUserFunction(lambda mbs, time: called.append(time) or True)
    outcome = solve_dynamic(mbs, settings(period=period), tolerance=1e-4)
    assert outcome.check() is outcome
    places, speeds = mbs.GetSensorStoredData(position), mbs.GetSensorStoredData(velocity)
    grid = np.append(np.arange(0.0, 1.0 - 1e-9, period), 1.0)
    assert places[:, 0] == pytest.approx(grid, abs=1e-9)
    assert places[:, 1] == pytest.approx(np.cos(OMEGA * grid), abs=5e-4)
    assert speeds[:, 1] == pytest.approx(-OMEGA * np.sin(OMEGA * grid), abs=5e-4 * OMEGA)
    assert len(called) == outcome.steps + 1


def test_every_step_is_written_with_a_period_of_zero():
    mbs, (position, _) = spring()
    outcome = solve_dynamic(mbs, settings(period=0.0))
    assert len(mbs.GetSensorStoredData(position)) == outcome.steps + 1


def test_the_grid_does_not_change_the_run():
    runs = []
    for period in (0.0, 1e-3):
        mbs, _ = spring()
        outcome = solve_dynamic(mbs, settings(period=period))
        runs.append((outcome.steps, mbs.systemData.GetODE2Coordinates().tolist()))
    assert runs[0] == runs[1]


def test_a_period_below_the_smallest_step_writes_every_step():
    """As with Exudyn's own steps, which take it for that; a billion rows would never end."""
    mbs, sensors = spring()
    chosen = settings()
    chosen.solution.sensors.writePeriod = 1e-10
    outcome = solve_dynamic(mbs, chosen, tolerance=1e-3)
    assert len(mbs.GetSensorStoredData(sensors[0])) == outcome.steps + 1


@pytest.mark.parametrize("part", [0.3, 0.8])
def test_within_a_step_a_polynomial_of_fourth_degree_is_met(part):
    """x = t^4, whose acceleration's line is the only thing that misses."""

    def state(t):
        return (
            np.array([[t**4], [4.0 * t**3], [12.0 * t**2]]),
            np.array([[2.0 * t]]),
            np.array([[t**3], [3.0 * t**2]]),
        )

    exact, left_out = state(1.0 + 0.5 * part), {0: 2, 2: 1}
    for i, weights in enumerate(within(part, 0.5)):
        ends = np.vstack([state(1.0)[i], state(1.5)[i]])
        found = np.reshape(weights, (-1, len(ends))) @ ends
        kept = np.arange(len(found)) != left_out.get(i)
        assert found[kept] == pytest.approx(exact[i][kept], rel=1e-12)


def test_a_run_goes_on_where_another_one_ended():
    mbs, _ = spring()
    for start in (0.0, 0.5):
        chosen = settings(start + 0.5)
        chosen.timeIntegration.startTime = start
        solve_dynamic(mbs, chosen, tolerance=1e-4, update_initial_values=True).check()
    assert mbs.systemData.GetODE2Coordinates()[0] == pytest.approx(np.cos(OMEGA), abs=1e-3)


def test_an_early_stop_raises_where_it_is_checked():
    mbs, _ = spring()
    outcome = solve_dynamic(mbs, settings(), max_steps=10)
    assert outcome.status is SolverStatus.TOO_MANY_STEPS
    with pytest.raises(RuntimeError, match="too many steps: 10 steps were used up"):
        outcome.check()
