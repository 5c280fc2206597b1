"""Runs with a tolerance, in systems of any size; those that stop early say when, where and why."""

import itertools
import json
import os
import re
import subprocess
import sys

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from patched import PATCHED
from stand_in_system import mass_on_spring, planar_body, settings

from exu_press import (
    InputError,
    Result,
    Scene,
    SolverStatus,
    add_dry_revolute,
    add_lubricated_revolute,
    simulate,
)
from exu_press.integrate import solve_dynamic
from exu_press.laws.contact import hertz, hunt_crossley, hysteretic
from exu_press.laws.film import pinkus
from exu_press.laws.friction import no_friction


def pendulum(length=1.0, mass=1.0, joint="ideal", gravity=9.81, force=1.0):
    """A rod let go while horizontal, its centre of mass a length from the joint."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    rod, node = planar_body(mbs, mass, mass * length**2 / 12.0, [length, 0.0, 0.0])
    ends = (rod, (-length, 0.0)), (ground, (0.0, 0.0))
    size = {"radius": 0.02 * length, "clearance": 2e-4 * length}
    if joint == "ideal":
        markers = [
            mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[*point, 0.0]))
            for body, point in reversed(ends)
        ]
        mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=markers))
    elif joint == "dry":
        slowest = 1e-3 * (length * gravity / 9.81) ** 0.5
        stiffness = hertz(1e10 * force / length**1.5)
        contact = hysteretic(stiffness, 0.5, lambda e: 1.5 * (1.0 - e), slowest_impact=slowest)
        add_dry_revolute(mbs, *ends, **size, contact=contact, friction=no_friction())
    else:
        viscosity = 1.0 * force * (9.81 * length / gravity) ** 0.5 / length**2
        width = {"length": size["radius"], "law": pinkus()}
        add_lubricated_revolute(mbs, *ends, **size, **width, viscosity=viscosity)
    at = mbs.AddMarker(items.MarkerBodyMass(bodyNumber=rod))
    mbs.AddLoad(items.LoadMassProportional(markerNumber=at, loadVector=[0.0, -gravity, 0.0]))
    mbs.Assemble()
    return mbs, node


SIZES = [(1e-6, 1e-18, 1e-3), (1e3, 1e9, 30.0)]
"""In length, mass and time: a watch and a crane."""


def steps_of(joint, length, mass, time):
    unit = length / time**2
    mbs, _ = pendulum(length, mass, joint, gravity=9.81 * unit, force=mass * unit)
    chosen = settings((1.0 if joint == "ideal" else 0.1) * time)
    chosen.timeIntegration.minimumStepSize *= time
    outcome = solve_dynamic(mbs, chosen)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
    return outcome.steps


@pytest.mark.parametrize("joint", ["ideal", "dry", "lubricated"])
def test_a_watch_and_a_crane_behave_alike(joint):
    """Scaled in length, mass and time: the same steps, but for rounding."""
    usual = steps_of(joint, 1.0, 1.0, 1.0)
    assert [steps_of(joint, *size) for size in SIZES] == pytest.approx([usual] * 2, rel=0.02, abs=2)


def triangle(mbs):
    """A bar between two pins on the ground, which hold its length twice."""
    ground = mbs.AddObject(items.ObjectGround())
    rod, _ = planar_body(mbs, 1.0, 0.1, [0.5, 0.0, 0.0])
    for side in (0.0, 1.0):
        ends = [
            mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[x, 0.0, 0.0]))
            for body, x in ((ground, side), (rod, side - 0.5))
        ]
        mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=ends))


def test_redundant_constraints_that_keep_newtons_method_from_converging_are_named():
    mbs = exu.SystemContainer().AddSystem()
    triangle(mbs)
    mbs.Assemble()
    with pytest.warns(UserWarning, match="1 constraint says the same as others"):
        outcome = solve_dynamic(mbs, settings(0.3))
    assert outcome.status in (SolverStatus.NOT_CONVERGED, SolverStatus.STEP_TOO_SMALL)


def unassembled():
    mbs = exu.SystemContainer().AddSystem()
    mbs.AddNode(items.NodePoint())
    return mbs


def dry_journal(eccentricity):
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(items.ObjectGround())
    rod, _ = planar_body(mbs, 1.0, 0.1, [1.0 + eccentricity, 0.0, 0.0])
    laws = {"contact": hunt_crossley(hertz(1e10), restitution=0.5), "friction": no_friction()}
    ends = (rod, (-1.0, 0.0)), (ground, (0.0, 0.0))
    add_dry_revolute(mbs, *ends, radius=0.02, clearance=1e-4, **laws)
    mbs.Assemble()
    return mbs


def state_of(mbs):
    """All coordinates, the user functions and what the solver leaves behind."""
    if not mbs.systemIsConsistent:
        return None
    data, where = mbs.systemData, exu.ConfigurationType.Current
    of = data.GetODE2Coordinates, data.GetODE2Coordinates_t, data.GetODE2Coordinates_tt
    functions = mbs.GetPreStepUserFunction(), mbs.GetPostNewtonUserFunction()
    return [part(where).tolist() for part in of], functions, dict(mbs.sys)


@pytest.mark.parametrize(
    ("system", "chosen", "tolerance", "message"),
    [
        (unassembled, settings(1.0), 1e-3, "not assembled"),
        (mass_on_spring, settings(endTime=0.0), 1e-3, "endTime = 0.0"),
        (mass_on_spring, settings(1.0), 0.5, "tolerance = 0.5: allowed is"),
        (mass_on_spring, settings(solverType=exu.DynamicSolverType.RK44), 1e-3, "RK44"),
        (mass_on_spring, settings(generalizedAlpha__useNewmark=True), 1e-3, "useNewmark"),
        (
            mass_on_spring,
            settings(generalizedAlpha__spectralRadius=1.0),
            1e-3,
            r"spectralRadius = 1.0: allowed is a number above 0.0, up to 0.95",
        ),
        (mass_on_spring, settings(generalizedAlpha__spectralRadius=0.0), 1e-3, "Radius = 0.0"),
        (mass_on_spring, settings(endTime=1e-8), 1e-3, "a run of 1e-07 s or more"),
        (mass_on_spring, settings(1.0), "1e-3", "tolerance = '1e-3': allowed is"),
        (lambda: dry_journal(0.01), settings(1.0), 1e-3, "eccentricity of 0.01 m"),
    ],
)
def test_what_cannot_be_solved_is_refused_by_name(system, chosen, tolerance, message):
    mbs = system()
    before = state_of(mbs)
    with pytest.raises(InputError, match=message):
        solve_dynamic(mbs, chosen, tolerance=tolerance)
    assert state_of(mbs) == before


THIN_OIL = {
    "mechanism": "slider_crank",
    "joints": {"crank_pin": "lubricated"},
    "revolutions": 1.0,
    "film": {"viscosity": 1e-7},
    "solver": {"step": 1e-4},
}
BREAKDOWN = re.compile(
    r"film broke down at t = (\S+) s, crank angle (\S+) deg, eccentricity ratio (\S+) "
    r"\(crank_pin\); try another value.*: film\.viscosity = 1e-07 Pa s is below .*"
)


def test_a_film_that_breaks_down_says_when_and_where_and_keeps_the_run():
    broken = simulate(Scene.from_dict(THIN_OIL))
    assert broken.info["status"] == "film broke down" and not broken.completed
    match = BREAKDOWN.fullmatch(broken.info["reason"])
    assert match, broken.info["reason"]
    when, angle, ratio = map(float, match.groups())
    assert when == pytest.approx(broken.info["end_time"], rel=1e-4)
    assert angle == pytest.approx(360.0 * 4.0 * when, abs=0.02)
    assert ratio >= 1.0
    assert broken.time[-1] == pytest.approx(broken.info["end_time"], rel=1e-9)
    assert 0.0 < broken.time[-1] < 0.25
    assert broken.info["steps"] == len(broken.time) - 1 > 10
    ratio = np.linalg.norm(broken["crank_pin_eccentricity"], axis=1) / 1e-4
    assert ratio.max() < 1.0, "no accepted state lies outside the film"
    assert ratio[-1] > 0.9, "and the last one is close to its end"
    assert all(np.all(np.isfinite(broken[name])) for name in broken)


CTRL_C = """
import os, signal, sys, threading, time

def press_ctrl_c():
    while not os.path.exists(sys.argv[1] + "/run.nc.unfinished"):
        time.sleep(0.01)  # until the model is built
    time.sleep(0.3)
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=press_ctrl_c, daemon=True).start()
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
def test_interrupted_command_exits_with_3(tmp_path):
    """Summary and run.nc are written, the reason is told in one line, no traceback."""
    done = interrupted(LONG_COMMAND, tmp_path)
    assert done.returncode == 3, done.stderr
    assert "Traceback" not in done.stderr
    assert "stopped early: interrupted at t = " in done.stderr
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "interrupted"
    assert summary["cost"]["steps"] > 10
    assert Result.load(tmp_path / "run.nc").info["steps"] == summary["cost"]["steps"]


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


def test_a_run_ends_where_what_watches_it_says_why():
    """What was computed until then is kept."""
    mbs, _ = pendulum()

    def late(time):
        return "late" if time >= 0.3 else ""

    outcome = solve_dynamic(mbs, settings(1.0), watch=late)
    assert (outcome.status, outcome.reason) == (SolverStatus.STALLED, "late")
    assert 0.3 <= outcome.end_time < 0.35


def test_a_long_run_says_how_long_and_why_and_a_short_one_nothing(monkeypatch, capsys):
    guide = {"clearance": 2e-5, "width": 0.1, "friction": "lugre"}
    scene = Scene(
        mechanism="slider_crank", speed_rpm=60.0, joints={}, revolutions=0.01, guide=guide
    )
    simulate(scene, quiet=False)
    assert "s left: steps of" not in capsys.readouterr().err
    for number, seconds in (("SOON", 0.0), ("LONG", 0.0), ("SECONDS_BETWEEN_UPDATES", 0.02)):
        monkeypatch.setattr(f"exu_press.integrate.monitor.{number}", seconds)
    simulate(scene.replace({"revolutions": 0.1, "solver.tolerance": 1e-4}), quiet=False)
    (said,) = [line for line in capsys.readouterr().err.splitlines() if "s left: steps of" in line]
    for part in ("run: about ", "slider's guide", "guide.friction = 'lugre'", "solver.tolerance"):
        assert part in said
