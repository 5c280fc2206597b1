"""Runs that stop early say when, where and what to try."""

import itertools
import json
import os
import re
import subprocess
import sys

import exudyn as exu
import numpy as np
import pytest
from patched import PATCHED

from exu_press import Result, Scene, simulate
from exu_press.cli import main

THIN_OIL = {
    "mechanism": "slider_crank",
    "joints": {"crank_pin": "lubricated"},
    "revolutions": 1.0,
    "film": {"viscosity": 1e-7},
    "solver": {"step": 1e-4},
}
BREAKDOWN = re.compile(
    r"film broke down at t = (\S+) s, crank angle (\S+) deg, eccentricity ratio (\S+) "
    r"\(crank_pin\); try what was meant instead of this: film\.viscosity = 1e-07 Pa s is below .*"
)


@pytest.fixture(scope="module", params=["slider_crank", "press"])
def broken(request):
    return simulate(Scene.from_dict({**THIN_OIL, "mechanism": request.param}))


def test_film_that_breaks_down_says_when_and_where(broken):
    assert broken.info["status"] == "film broke down"
    match = BREAKDOWN.fullmatch(broken.info["reason"])
    assert match, broken.info["reason"]
    when, angle, ratio = map(float, match.groups())
    assert when == pytest.approx(broken.info["end_time"], rel=1e-4)
    assert angle == pytest.approx(360.0 * 4.0 * when, abs=0.02)
    assert ratio >= 1.0


def test_what_was_computed_before_the_breakdown_is_kept(broken):
    assert not broken.completed
    assert 0.0 < broken.time[-1] < 0.25
    assert broken.time[-1] == pytest.approx(broken.info["end_time"], rel=1e-9)
    assert broken.info["steps"] == len(broken.time) - 1 > 10
    ratio = np.linalg.norm(broken["crank_pin_eccentricity"], axis=1) / 1e-4
    assert ratio.max() < 1.0, "no accepted state lies outside the film"
    assert ratio[-1] > 0.9, "and the last one is close to its end"
    for name in broken:
        assert np.all(np.isfinite(broken[name])), name


def test_summary_of_a_breakdown_is_complete(broken):
    summary = broken.summary()
    assert summary["status"] == "film broke down"
    assert summary["reason"] == broken.info["reason"]
    assert summary["rejected_steps"] > 0, "the step was halved before giving up"
    assert 0.9 < summary["joints"]["crank_pin"]["max_eccentricity_ratio"] < 1.0
    json.dumps(summary, allow_nan=False)


def test_film_that_holds_completes():
    result = simulate(Scene.from_dict({**THIN_OIL, "film": {"viscosity": 0.4}}))
    assert result.info["status"] == "completed"
    assert result.info["reason"] == ""


def test_command_that_stops_early_exits_with_3_and_keeps_everything(tmp_path):

    path = tmp_path / "scene.toml"
    path.write_text(
        'mechanism = "slider_crank"\n[film]\nviscosity = 1e-7\n[solver]\nstep = 1e-4\n',
        encoding="utf-8",
    )
    out = tmp_path / "out"
    assert main(["run", str(path), "--out", str(out), "--quiet", "--no-pictures"]) == 3
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "film broke down"
    assert Result.load(out / "run.nc").info["reason"] == summary["reason"]


CTRL_C = """
import os, signal, sys, threading, time

def press_ctrl_c():
    while signal.getsignal(signal.SIGINT) in (signal.default_int_handler, signal.SIG_DFL):
        time.sleep(0.01)  # until the run listens
    time.sleep(0.3)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=press_ctrl_c, daemon=True).start()
"""
LONG_RUN = """
from exu_press import Scene, simulate
simulate(Scene.from_dict({
    "mechanism": "slider_crank", "revolutions": 100.0, "solver": {"step": 1e-5}})).save(sys.argv[1])
assert signal.getsignal(signal.SIGINT) is signal.default_int_handler, "as before the run"
"""
LONG_COMMAND = """
from exu_press.cli import main
raise SystemExit(main(["run", "slider_crank", "--set", "revolutions=100", "--set",
                       "solver.step=1e-5", "--no-pictures", "--out", sys.argv[1]]))
"""
POSIX = pytest.mark.skipif(os.name != "posix", reason="SIGINT to a process")


def interrupted(code, argument):
    command = [sys.executable, "-c", CTRL_C + code, str(argument)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


@POSIX
def test_interrupt_keeps_what_was_computed(tmp_path):
    done = interrupted(LONG_RUN, tmp_path / "run.nc")
    assert done.returncode == 0, done.stderr
    result = Result.load(tmp_path / "run.nc")
    assert result.info["status"] == "interrupted"
    where = r"interrupted at t = \S+ s, crank angle \S+ deg"
    assert re.fullmatch(where, result.info["reason"]), result.info["reason"]
    assert 10 < result.info["steps"] == len(result.time) - 1 < 2_500_000
    assert result.time[-1] == pytest.approx(result.info["end_time"], rel=1e-9)
    assert np.all(np.isfinite(result["slider_position"]))
    assert result.info["rejected_steps"] <= 1  # a film's first step is taken twice


@POSIX
def test_interrupted_command_exits_with_3(tmp_path):
    """Summary and run.nc are written, the reason is told in one line, no traceback."""
    done = interrupted(LONG_COMMAND, tmp_path)
    assert done.returncode == 3, done.stderr
    assert "Traceback" not in done.stderr
    assert "stopped early: interrupted at t = " in done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "interrupted"
    assert summary["steps"] > 10
    assert Result.load(tmp_path / "run.nc").info["steps"] == summary["steps"]


DRY = {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}, "revolutions": 0.1}


def run(**changes):
    return simulate(Scene.from_dict(DRY).replace(changes))


@pytest.mark.parametrize("setting", [{"solver.tolerance": 1e-4}, {"solver.step": 1e-5}], ids=str)
def test_a_budget_of_steps_ends_the_run_and_keeps_it(setting):
    result = run(**{"solver.max_steps": 100, **setting})
    assert result.info["status"] == "too many steps"
    assert re.fullmatch(
        r"100 steps were used up at t = \S+ s, crank angle \S+ deg, \S+% of the run; try fewer "
        r"revolutions, a larger solver\.(step|tolerance) or solver\.max_steps",
        result.info["reason"],
    ), result.info["reason"]
    assert not result.completed
    tries = result.info["steps"] + result.info["rejected_steps"]
    assert 100 <= tries < 110  # the step under way is finished, however often it is repeated
    assert len(result.time) == result.info["steps"] + 1
    json.dumps(result.summary(), allow_nan=False)


@PATCHED
def test_an_error_in_a_law_is_not_told_as_one_of_newton():
    model = Scene.from_dict(DRY).build()
    joint = model.clearance_joints["crank_pin"]
    right, calls = joint.add_force, itertools.count()

    def breaks(*state):
        if next(calls) > 50:
            raise ZeroDivisionError("in a law")
        right(*state)

    joint.add_force = breaks
    with pytest.raises(exu.ExudynError, match="USER FUNCTION"):
        model.solve()
