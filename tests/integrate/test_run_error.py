"""The error of a run, by a finer one in a copy of the process."""

import os
import signal
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest

from exu_press import InputError, SolverStatus, solve_dynamic
from exu_press.integrate.motion import velocities_of
from exu_press.integrate.problem import Problem
from exudyn_examples.other import first_order, mass_1d

VELOCITY = exu.OutputVariableType.Coordinates_t

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="copies its process")


def settings(end):
    chosen = exu.SimulationSettings()
    chosen.timeIntegration.endTime = end
    chosen.solution.file.write = False
    return chosen


def vibrating(file="", force=None):
    """A mass on a spring of 20 rad/s, let go 1 m off; a sensor of its velocity."""
    mbs = exu.SystemContainer().AddSystem()
    spring = items.CoordinateSpringDamper(markerNumbers=mass_1d(mbs, 1.0, 1.0), stiffness=400.0)
    if force is not None:
        spring.springForceUserFunction = force
    mbs.AddObject(spring)
    sensor = items.SensorNode(
        nodeNumber=0,
        outputVariableType=VELOCITY,
        storeInternal=True,
        fileName=file,
        writeToFile=bool(file),
    )
    mbs.AddSensor(sensor)
    mbs.Assemble()
    return mbs


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_the_stated_error_covers_the_true_one_and_is_of_its_size(tolerance):
    mbs = vibrating()
    outcome = solve_dynamic(mbs, settings(2.0), tolerance=tolerance, errors=True)
    rows = np.array(mbs.GetSensorStoredData(0))
    exact = -20.0 * np.sin(20.0 * rows[:, 0])
    true = np.abs(rows[:, 1] - exact).max()
    (stated,) = outcome.error.sensors[0]
    assert true <= stated <= 10.0 * true
    of_peak = abs(np.abs(rows[:, 1]).max() - np.abs(exact).max())
    (stated_of_peak,) = outcome.error.peaks[0]  # what is late by a phase is no less high
    assert of_peak <= stated_of_peak <= min(10.0 * of_peak, 0.1 * stated)
    assert true / 20.0 <= 1.05 * outcome.error.motion  # of 100 instants, not of 200 rows
    assert outcome.error.motion <= 10.0 * true / 20.0
    assert outcome.error.since == np.inf and not outcome.error.reason


def test_first_order_coordinates_have_an_error_too():
    """A coordinate that decays, y' = -y: exact to the figures of generalized-alpha's rule."""
    mbs = exu.SystemContainer().AddSystem()
    mbs.AddObject(
        items.ObjectGenericODE1(
            nodeNumbers=[first_order(mbs, [1.0])], systemMatrix=[[-1.0]], rhsVector=[0.0]
        )
    )
    mbs.Assemble()
    outcome = solve_dynamic(mbs, settings(3.0), tolerance=1e-4, errors=True)
    true = abs(mbs.systemData.GetODE1Coordinates()[0] - np.exp(-3.0))
    assert 0.0 < true <= outcome.error.motion < 1e-3


def test_a_motion_that_amplifies_errors_is_told():
    """A body that turns about its middle axis, a millionth off."""
    mbs = exu.SystemContainer().AddSystem()
    spin = [1e-6, 5.0, 0.0]
    mbs.CreateRigidBody(
        inertia=items.RigidBodyInertia(1.0, np.diag([1.0, 2.0, 3.0])), initialAngularVelocity=spin
    )
    mbs.Assemble()
    with pytest.warns(UserWarning, match="amplifies what steps miss") as told:
        outcome = solve_dynamic(mbs, settings(20.0), errors=True)
    assert told[0].filename == __file__
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.error.motion > 0.1 and 1.0 < outcome.error.since < 20.0


def files_of(folder, errors):
    """Run with a sensor's file and the solution file; return outcome, rows and files."""
    folder.mkdir()
    mbs = vibrating(file=str(folder / "velocity.txt"))
    chosen = settings(1.0)
    chosen.solution.file.write, chosen.solution.file.name = True, str(folder / "solution")
    outcome = solve_dynamic(mbs, chosen, errors=errors)
    kept = {
        path.name: [line for line in path.read_text().splitlines() if line[0] != "#"]
        for path in folder.iterdir()
    }
    assert chosen.timeIntegration.numberOfSteps == 100
    assert mbs.GetSensor(0)["writeToFile"]
    return outcome, np.array(mbs.GetSensorStoredData(0)), kept


def test_the_run_itself_and_its_files_are_as_without(tmp_path):
    alone, rows, files = files_of(tmp_path / "alone", False)
    beside, rows_beside, files_beside = files_of(tmp_path / "beside", True)
    assert alone.error is None
    assert (alone.steps, alone.newton_iterations) == (beside.steps, beside.newton_iterations)
    assert np.array_equal(rows, rows_beside)
    assert len(files) == 2 and files == files_beside


def test_a_controller_has_its_period_in_both_runs():
    """One that brakes by the speed at the beginning of each of its periods of 20 ms."""
    mbs = vibrating()
    marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=0, coordinate=0))
    brake = mbs.AddLoad(items.LoadCoordinate(markerNumber=marker))
    mbs.Assemble()

    def control(mbs, time):
        mbs.SetLoadParameter(brake, "load", -10.0 * mbs.GetNodeOutput(0, VELOCITY))
        return True

    mbs.SetPreStepUserFunction(control)
    outcome = solve_dynamic(mbs, settings(2.0), errors=True)
    assert outcome.error.motion < 1e-2


def test_steps_that_the_grid_alone_bounds_are_halved_too():
    """At 0.1 both runs take steps of a period; their difference was next to nothing."""
    mbs = vibrating()
    mbs.SetPreStepUserFunction(lambda mbs, time: True)
    outcome = solve_dynamic(mbs, settings(1.0), tolerance=0.1, sample=1e-3, errors=True)
    assert 1000 <= outcome.steps < 1010
    true = abs(mbs.GetNodeOutput(0, VELOCITY) + 20.0 * np.sin(20.0)) / 20.0
    assert 1e-5 < true <= outcome.error.motion <= 10.0 * true


def children():
    """Return the numbers of this process's children."""
    return Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text().split()


def test_an_early_stop_has_no_error_and_leaves_no_process():
    mbs = vibrating()
    with pytest.warns(UserWarning, match="too many steps"):
        outcome = solve_dynamic(mbs, settings(20.0), max_steps=50, errors=True)
    assert outcome.error is None
    assert not children()


def only_in_copies(harm):
    parent = os.getpid()

    def force(mbs, now, item, place, velocity, stiffness, damping, offset):
        if os.getpid() != parent and now > 0.5:
            harm()
        return stiffness * place

    return force


def fail():
    raise ValueError("no force")


@pytest.mark.parametrize(
    ("harm", "said"),
    [(fail, "no force"), (lambda: os._exit(7), "its process ended: exit status 7")],
)
def test_a_finer_run_that_stops_early_says_why(harm, said):
    mbs = vibrating(force=only_in_copies(harm))
    with pytest.warns(UserWarning, match="the finer run stopped early"):
        outcome = solve_dynamic(mbs, settings(1.0), errors=True)
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.error.motion == np.inf and outcome.error.sensors == outcome.error.peaks == []
    assert said in outcome.error.reason
    assert not children()


def test_an_interrupt_ends_the_finer_run_alone():
    """It waits for a minute, and the run itself is done by then."""
    mbs = vibrating(force=only_in_copies(lambda: time.sleep(60.0)))
    interrupt = threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT))
    interrupt.start()
    with pytest.warns(UserWarning, match="the finer run stopped early, interrupted"):
        outcome = solve_dynamic(mbs, settings(1.0), errors=True)
    assert outcome.status is SolverStatus.COMPLETED
    assert not children()


def test_rows_of_every_step_have_an_error_too():
    """Those of the finer run are of other instants."""
    mbs = vibrating()
    chosen = settings(1.0)
    chosen.solution.sensors.writePeriod = 0.0
    outcome = solve_dynamic(mbs, chosen, errors=True)
    rows = np.array(mbs.GetSensorStoredData(0))
    true = np.abs(rows[:, 1] + 20.0 * np.sin(20.0 * rows[:, 0])).max()
    (stated,) = outcome.error.sensors[0]
    assert true <= stated <= 10.0 * true


def test_a_sensor_that_keeps_nothing_has_no_error():
    mbs = vibrating()
    mbs.SetSensorParameter(0, "storeInternal", False)
    error = solve_dynamic(mbs, settings(1.0), errors=True).error
    assert [found.shape for found in (*error.sensors, *error.peaks)] == [(0,), (0,)]


NO_COPIES = {
    "on Linux": (sys, "platform", "win32"),
    "without a window": (
        exu.MainSystem,
        "GetSystemContainer",
        lambda mbs: SimpleNamespace(renderer=SimpleNamespace(IsActive=lambda: True)),
    ),
}


@pytest.mark.parametrize("said", NO_COPIES)
def test_where_no_copy_will_do_it_is_refused(monkeypatch, said):
    mbs = vibrating()
    monkeypatch.setattr(*NO_COPIES[said])
    with pytest.raises(InputError, match=said):
        solve_dynamic(mbs, settings(1.0), errors=True)


def test_fixed_steps_are_refused():
    with pytest.raises(InputError, match="half the size"):
        solve_dynamic(vibrating(), settings(1.0), tolerance=None, errors=True)


def test_three_angles_count_by_the_angular_velocity_of_the_body():
    """As Exudyn has it; near 90 degrees two rates are fast, and all but cancel."""
    angles, rates = [0.3, 1.57, 0.4], [1000.0, 0.2, -1000.5]
    mbs = exu.SystemContainer().AddSystem()
    body = mbs.CreateRigidBody(
        inertia=items.RigidBodyInertia(1.0, np.eye(3)), nodeType=exu.NodeType.RotationRxyz
    )
    mbs.Assemble()
    problem = Problem.of(mbs)
    data = mbs.systemData
    data.SetODE2Coordinates([0.0] * 3 + angles)
    data.SetODE2Coordinates_t([1.0, 2.0, 3.0, *rates])
    kind = exu.OutputVariableType.AngularVelocityLocal
    expected = mbs.GetObjectOutputBody(body, kind, [0.0] * 3, exu.ConfigurationType.Current)
    rows = np.array([[0.0] * 3 + angles + [1.0, 2.0, 3.0, *rates]])
    (found,) = velocities_of(problem, rows)
    assert found[:3] == pytest.approx([1.0, 2.0, 3.0])
    assert found[3:] == pytest.approx(expected, rel=1e-6)
    assert rows[0, 9:].tolist() == rates  # as they were
