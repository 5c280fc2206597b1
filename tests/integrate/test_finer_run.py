"""The error of a run, by a finer one in a copy of the process."""

import os
import signal
import sys
import threading
import time
from pathlib import Path

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from stand_in_system import mass_on_spring, settings

from exu_press import InputError
from exu_press.integrate import SolverStatus, solve_dynamic

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="copies its process")


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_the_stated_error_covers_the_true_one_and_is_of_its_size(tolerance):
    mbs, chosen = mass_on_spring(), settings(0.5)
    chosen.solution.sensors.writePeriod = 0.0
    outcome = solve_dynamic(mbs, chosen, tolerance=tolerance, errors=True)
    rows = np.array(mbs.GetSensorStoredData(0))
    exact = -20.0 * np.sin(20.0 * rows[:, 0])
    true = np.abs(rows[:, 1] - exact).max()
    (stated,) = outcome.error.sensors[0]
    assert true <= stated <= 10.0 * true
    of_peak = abs(np.abs(rows[:, 1]).max() - np.abs(exact).max())
    (stated_of_peak,) = outcome.error.peaks[0]
    assert of_peak <= stated_of_peak
    assert true / 20.0 <= 1.05 * outcome.error.motion  # of 100 instants, not of 200 rows
    assert outcome.error.motion <= 10.0 * true / 20.0
    assert outcome.error.since == np.inf and not outcome.error.reason


def files_of(folder, errors):
    """Run with a sensor's file and the solution file; return outcome, rows and files."""
    folder.mkdir()
    mbs = mass_on_spring()
    mbs.SetSensorParameter(0, "fileName", str(folder / "velocity.txt"))
    mbs.SetSensorParameter(0, "writeToFile", True)
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


def children():
    """Return the numbers of this process's children."""
    return Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text().split()


def test_an_early_stop_has_no_error_and_leaves_no_process():
    mbs = mass_on_spring()
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
    mbs = mass_on_spring(force=only_in_copies(harm))
    with pytest.warns(UserWarning, match="the finer run stopped early"):
        outcome = solve_dynamic(mbs, settings(1.0), errors=True)
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.error.motion == np.inf and outcome.error.sensors == outcome.error.peaks == []
    assert said in outcome.error.reason
    assert not children()


def test_an_interrupt_ends_the_finer_run_alone():
    """It waits for a minute, and the run itself is done by then."""
    mbs = mass_on_spring(force=only_in_copies(lambda: time.sleep(60.0)))
    interrupt = threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT))
    interrupt.start()
    with pytest.warns(UserWarning, match="the finer run stopped early, interrupted"):
        outcome = solve_dynamic(mbs, settings(1.0), errors=True)
    assert outcome.status is SolverStatus.COMPLETED
    assert not children()


def test_a_motion_that_amplifies_errors_is_reported():
    """A body that turns about its middle axis, a millionth off."""
    mbs = exu.SystemContainer().AddSystem()
    spin = [1e-6, 5.0, 0.0]
    mbs.CreateRigidBody(
        inertia=items.RigidBodyInertia(1.0, np.diag([1.0, 2.0, 3.0])), initialAngularVelocity=spin
    )
    mbs.Assemble()
    with pytest.warns(UserWarning, match="amplifies what steps miss") as caught:
        outcome = solve_dynamic(mbs, settings(20.0), errors=True)
    assert caught[0].filename == __file__
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.error.motion > 0.1 and 1.0 < outcome.error.since < 20.0


def test_fixed_steps_are_refused():
    with pytest.raises(InputError, match="half the size"):
        solve_dynamic(mass_on_spring(), settings(1.0), tolerance=None, errors=True)
