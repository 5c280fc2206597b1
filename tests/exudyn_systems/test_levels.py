"""What levels leave behind: memory, files, settings; and where they run."""

import sys
import threading

import exudyn as exu
import numpy as np
import pytest
from exudyn_systems.models import settings
from stand_in_system import oscillator

from exu_press import InputError, SolverStatus
from exu_press.exudyn_systems import solve_dynamic
from exu_press.exudyn_systems.level import Levels
from fe_models.processes import why_not_copied


class Integral:
    """A controller in a pre-step function, which remembers the integral of what it sees."""

    def __init__(self, mbs, spring):
        self.spring, self.sum, self.last, self.calls = spring, 0.0, 0.0, 0
        mbs.SetPreStepUserFunction(self)

    def __call__(self, mbs, time):
        self.calls += 1
        self.sum += (time - self.last) * mbs.GetNodeOutput(0, exu.OutputVariableType.Coordinates)
        self.last = time
        mbs.SetObjectParameter(self.spring, "offset", -2.0 * float(self.sum))
        return True


def controlled():
    mbs, spring, sensor = oscillator(damping=2.0)
    return mbs, Integral(mbs, spring), sensor


def test_functions_that_remember_begin_afresh():
    mbs, function, sensor = controlled()
    outcome = solve_dynamic(mbs, settings(1.0, 50))
    assert outcome.status is SolverStatus.COMPLETED
    assert function.calls == outcome.steps  # those of other levels are in copies
    once, _, _ = controlled()
    constant = settings(1.0, outcome.steps)
    constant.timeIntegration.adaptiveStep = False
    once.SolveDynamic(constant)
    ours, theirs = (np.array(one.GetSensorStoredData(sensor)) for one in (mbs, once))
    assert np.array_equal(ours, theirs)


def test_a_function_that_builds_the_system_does_without_copies(monkeypatch):
    built = []

    def build():
        built.append(controlled())
        return built[-1][0]

    copied = solve_dynamic(controlled()[0], settings(1.0, 50))
    monkeypatch.setattr(
        "exu_press.exudyn_systems.level.why_not_copied", lambda: "NGSolve is loaded"
    )
    outcome = solve_dynamic(build, settings(1.0, 50))
    assert [steps for steps, _ in outcome.levels] == [steps for steps, _ in copied.levels]
    assert outcome.mbs is built[-1][0] and built[-1][1].calls == outcome.steps
    assert outcome.error.motion == pytest.approx(copied.error.motion, rel=1e-9)


def test_a_built_system_of_the_last_level_stays_where_it_misses():
    built = []

    def build():
        built.append(controlled()[0])
        return built[-1]

    runs = Levels(build(), settings(1.0, 50), 10, 60.0, build)
    runs.run_beside([10, 20])
    runs.run_beside([40, 80], last=True)
    runs.run_beside([160, 320])
    assert runs.mbs is built[3]


def test_files_are_written_once_and_settings_and_functions_are_put_back(tmp_path):
    file = tmp_path / "place.txt"
    mbs, _, sensor = oscillator(fileName=str(file), writeToFile=True)
    asked = settings(2.0, 100)
    asked.solution.file.write = True
    asked.solution.file.name = str(tmp_path / "solution.txt")
    before, calls = str(asked), []
    mbs.SetPostStepUserFunction(lambda mbs, time: calls.append(time) or True)
    outcome = solve_dynamic(mbs, asked)
    rows = np.loadtxt(file, delimiter=",", comments="#")
    assert len(rows) == min(outcome.steps, 200) + 1
    assert rows == pytest.approx(np.array(mbs.GetSensorStoredData(sensor)), abs=1e-9)
    solution = np.loadtxt(tmp_path / "solution.txt", delimiter=",", comments="#")
    assert len(solution) == len(rows)
    assert {path.name for path in tmp_path.iterdir()} == {"place.txt", "solution.txt"}
    assert str(asked) == before
    assert len(calls) == outcome.steps + 1  # Exudyn calls it for the start too
    mbs.GetPostStepUserFunction()["function"](mbs, 7.0)
    assert calls[-1] == 7.0


def test_an_error_in_a_function_is_raised():
    mbs, _, _ = oscillator()
    mbs.SetPreStepUserFunction(lambda mbs, time: 1 / 0)
    with pytest.raises(exu.ExudynError, match="ZeroDivisionError"):
        solve_dynamic(mbs, settings(2.0, 100))


def refusal(monkeypatch, reason):
    """Let a reason apply for which the process is not copied."""
    monkeypatch.setattr("exu_press.exudyn_systems.level.why_not_copied", why_not_copied)
    monkeypatch.delitem(sys.modules, "ngsolve", raising=False)
    if reason == "NGSolve is loaded":
        monkeypatch.setitem(sys.modules, "ngsolve", None)
    elif reason == "there are 2 threads":
        monkeypatch.setattr(threading, "enumerate", lambda: [threading.main_thread()] * 2)
    else:
        monkeypatch.setattr(threading, "enumerate", lambda: [threading.main_thread()])
        monkeypatch.setattr(sys, "platform", "win32")


@pytest.mark.parametrize("reason", ["NGSolve is loaded", "there are 2 threads", "this is win32"])
def test_where_no_copy_is_safe_a_function_is_asked_for(reason, monkeypatch):
    refusal(monkeypatch, reason)
    with pytest.raises(InputError, match=rf"{reason}; pass a function that builds"):
        solve_dynamic(oscillator()[0], settings(2.0, 100))
    assert solve_dynamic(lambda: oscillator()[0], settings(2.0, 100)).status.reached_end
