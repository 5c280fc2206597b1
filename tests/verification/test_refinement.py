"""Processes of refinement runs and of several scenes: how they start, fail and end."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from exu_press import InputError, Scene
from exu_press.verification import refinement
from exu_press.verification.refinement import RefinementRuns, plan
from exu_press.verification.run import simulate_with_errors
from exu_press.verification.side_by_side import simulate_side_by_side
from fe_models.processes import Child

SHORT = Scene(mechanism="slider_crank", revolutions=0.02)
LONG = Scene(joints={"crank_pin": "dry", "balls": "dry"}, revolutions=100.0)

posix = pytest.mark.skipif(sys.platform == "win32", reason="processes are asked otherwise there")
linux = pytest.mark.skipif(sys.platform != "linux", reason="no process is copied there")
way = pytest.mark.parametrize(
    "forks", [pytest.param(True, marks=linux, id="copied"), pytest.param(False, id="new")]
)


@pytest.fixture
def by(monkeypatch):
    """Set how the process is started."""
    monkeypatch.setattr(refinement, "Child", Child)
    return lambda forks: monkeypatch.setattr(refinement, "may_copy", lambda: forks)


@way
def test_results_are_those_of_the_plan(by, forks, capfd):
    by(forks)
    with RefinementRuns(SHORT) as refinements:
        found = dict(refinements.results())
    assert {ratio: run.scene for ratio, run in found.items()} == plan(SHORT)
    assert capfd.readouterr() == ("", "")


def test_results_are_there_as_soon_as_they_are_done(monkeypatch):
    monkeypatch.setattr(refinement, "plan", lambda _: {4.0: SHORT, 8.0: LONG})
    with RefinementRuns(SHORT) as refinements:
        ratio, run = next(refinements.results())
    assert (ratio, run.scene) == (4.0, SHORT)


@posix
@way
def test_no_process_and_no_file_is_left_behind(by, forks, monkeypatch, tmp_path):
    by(forks)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(refinement, "plan", lambda _: {0.5: LONG, 8.0: LONG})
    begun = time.monotonic()
    with RefinementRuns(LONG) as refinements:
        processes = [child.pid for child, _ in refinements._children]
    assert time.monotonic() - begun < 10.0
    assert not list(tmp_path.iterdir())
    assert len(processes) == 2
    for process in processes:
        with pytest.raises(ProcessLookupError):
            os.kill(process, 0)


@linux
def test_a_process_that_is_killed_says_so(by, monkeypatch):
    """While the others go on; tests/parts kills new processes too."""
    by(True)
    monkeypatch.setattr(refinement, "plan", lambda _: {0.5: LONG, 4.0: SHORT, 8.0: SHORT})
    with RefinementRuns(LONG) as refinements:
        os.kill(refinements._children[0][0].pid, signal.SIGTERM)
        with pytest.raises(RuntimeError, match=r"refinement run failed \(killed by SIGTERM\)"):
            list(refinements.results())


@linux
def test_ctrl_c_ends_both_at_once(tmp_path):
    """As a terminal does it: to the whole group of processes."""
    changes = ["--set", "joints.crank_pin=dry", "--set", "revolutions=100", "--no-pictures"]
    run = subprocess.Popen(
        [sys.executable, "-m", "exu_press", "run", "press", *changes, "--out", str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    children = Path(f"/proc/{run.pid}/task/{run.pid}/children")
    while run.poll() is None and not children.read_text():
        time.sleep(0.02)
    refinements = [int(number) for number in children.read_text().split()]
    time.sleep(0.3)
    os.killpg(run.pid, signal.SIGINT)
    _, said = run.communicate(timeout=30)
    assert "Traceback" not in said
    # Python ends by the signal itself where it caught that one inside exec, as of a dataclass
    assert run.returncode in (3, 130, -signal.SIGINT)
    assert refinements
    for number in refinements:
        with pytest.raises(ProcessLookupError):
            os.kill(number, 0)


@pytest.mark.parametrize(
    ("tolerance", "ratios"), [(1e-3, [0.5, 4.0]), (0.04, [0.5, 2.0]), (0.1, [0.25, 0.5])]
)
def test_the_plan_has_a_finer_tolerance_and_a_coarser_one_where_that_is_allowed(tolerance, ratios):
    """Largest steps go with the tolerance: where they set the steps of all runs, their agreement
    says nothing. A finer run may take more steps: one that a limit stopped made a stated error 3.7
    times too small.
    """
    scene = SHORT.replace({"solver.tolerance": tolerance, "solver.max_steps": 20_000})
    refinements = plan(scene)
    assert list(refinements) == ratios
    for ratio, other in refinements.items():
        assert other.solver.tolerance == pytest.approx(ratio * tolerance)
        assert other.solver.max_step_deg == pytest.approx(ratio**0.5 * scene.solver.max_step_deg)
        assert other.solver.max_steps == 20_000 * max(1.0, 1.0 / ratio)


def test_fixed_steps_go_with_the_ratio():
    steps = {
        ratio: run.solver.step for ratio, run in plan(SHORT.replace({"solver.step": 1e-5})).items()
    }
    assert steps == pytest.approx({2.0: 2e-5, 3.0: 3e-5, 4.0: 4e-5})


SCENES = {
    kind: Scene(mechanism="slider_crank", joints={"crank_pin": kind}, revolutions=0.01)
    for kind in ("dry", "lubricated")
}


def test_results_are_those_of_one_run_after_the_other():
    """In all digits, with their errors."""
    results = dict(simulate_side_by_side(SCENES))
    assert results.keys() == SCENES.keys()
    for label, scene in SCENES.items():
        alone = simulate_with_errors(scene, beside=False)
        assert results[label].info["errors"] == alone.info["errors"] != {}
        assert (results[label]["slider_velocity"] == alone["slider_velocity"]).all()


def test_a_scene_that_cannot_be_run_is_refused():
    off = SCENES["dry"].replace({"output.channels": ["no_such_channel"]})
    with pytest.raises(InputError, match="no_such_channel"):
        dict(simulate_side_by_side({"a": off}, errors=False))
