"""Runs that stop early, or whose steps do not resolve their impacts, say so with what to try."""

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
    from exu_press.cli import main

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
REASON = re.compile(
    r"under-resolved at t = (\S+) s, crank angle (\S+) deg: (\d+)% of the largest inertia force "
    r"\((slider|rod)\) within a step of (\S+) s; peaks are the step's; "
    r"try solver\.(step|tolerance) = (\S+)"
)


def run(**changes):
    return simulate(Scene.from_dict(DRY).replace(changes))


def peak(result):
    return np.abs(result["slider_acceleration"]).max()


@pytest.fixture(scope="module")
def reference():
    return run(**{"solver.tolerance": 1e-5})


@pytest.mark.parametrize("step", [1e-3, 2e-4])
def test_a_step_that_leaps_over_impacts_names_one_that_does_not(step, reference):
    coarse = run(**{"solver.step": step})
    assert coarse.completed, "it reached its end"
    assert coarse.info["status"] == "under-resolved"
    match = REASON.fullmatch(coarse.info["reason"])
    assert match, coarse.info["reason"]
    assert peak(coarse) < 0.6 * peak(reference), "and its peak is the step's"
    assert match[6] == "step"
    fine = run(**{"solver.step": float(match[7])})
    assert fine.info["status"] == "completed", fine.info["reason"]
    assert peak(fine) == pytest.approx(peak(reference), rel=0.03)


@pytest.mark.parametrize(
    "changes",
    [
        {"solver.tolerance": 1e-3},
        {"solver.step": 2e-5},
        {"solver.step": 1e-3, "contact.damping_max": 0.0},  # soft: the impact lasts many steps
        {"solver.step": 1e-3, "joints": {}},
    ],
    ids=str,
)
def test_resolved_runs_are_completed(changes):
    assert run(**changes).info["status"] == "completed"


def test_an_impact_on_the_frame_says_which_step_resolves_it():
    coarse = run(**{"joints": {"shaft": "dry"}, "solver.step": 1e-3})
    assert coarse.info["status"] == "under-resolved"
    assert re.search(r"try solver\.step = \d", coarse.info["reason"])


@pytest.mark.parametrize("changes", [{}, {"film.viscosity": 1.0}], ids=str)
def test_a_film_that_starts_from_rest_is_no_impact(changes):
    """Its accelerations ring for some steps."""
    result = run(**{"joints": {"crank_pin": "lubricated"}, "solver.step": 1e-4, **changes})
    assert result.info["status"] == "completed", result.info["reason"]


@pytest.mark.parametrize("rise", [1e-4, 1e-5])
def test_a_pulse_shorter_than_the_step_is_not_resolved_either(rise):
    load = {
        "load.blanking.kind": "blanking",
        "load.blanking.force": 1e6,
        "load.blanking.rise": rise,
        "load.blanking.fall": 2.0 * rise,
    }
    changes = {"joints": {}, "load.blanking.end_angle_deg": 20.0, **load}
    leapt = run(**changes, **{"solver.step": 1e-3})
    assert leapt.info["status"] == "under-resolved"
    assert leapt["load_blanking_force"].max() < 0.9e6, "the pulse's peak was missed"
    advice = re.search(r"load\.blanking .* try solver\.step = (\S+)", leapt.info["reason"])
    fine = run(**changes, **{"solver.step": float(advice[1])})
    assert fine.info["status"] == "completed"
    assert fine["load_blanking_force"].max() > 0.9e6
    assert run(**changes).info["status"] == "completed", "a tolerance steps on its corners"


def test_the_command_exits_with_3_and_does_not_speak_of_a_stop(tmp_path, capsys):
    out = tmp_path / "out"
    arguments = [
        "--set",
        "joints.crank_pin=dry",
        "--set",
        "revolutions=0.05",
        "--set",
        "solver.step=2e-4",
    ]
    assert main(["run", "slider_crank", *arguments, "--no-pictures", "--out", str(out)]) == 3
    error = capsys.readouterr().err
    assert error.startswith("exu-press: under-resolved at t = ")
    summary = json.loads((out / "summary.json").read_text())
    assert summary["status"] == "under-resolved"
    assert Result.load(out / "run.nc").completed


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
