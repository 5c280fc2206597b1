"""A run goes on at a finer tolerance where that is needed, and as long as it is worth it."""

import re
import time
from dataclasses import replace

import numpy as np
import pytest

from exu_press import Result, Scene, simulate
from exu_press.cli import main
from exu_press.verification import refine

SCENE = Scene(mechanism="slider_crank", joints={}, revolutions=0.02)


@pytest.fixture(scope="module")
def bare():
    return simulate(SCENE)


def stated(result, part):
    """Return a run whose stroke is known to a part of it."""
    stroke = result.quantity("stroke").value
    error = {"error": part * stroke, "determined": True, "low": 0.0, "high": 2.0 * stroke}
    return replace(result, info={**result.info, "errors": {"stroke": error}})


def fake(monkeypatch, bare, part, seconds=0.0):
    """Let runs take some time and be off by a part at a tolerance; return the tolerances asked."""
    asked = []

    def run(scene, **_):
        asked.append(scene.solver.tolerance)
        time.sleep(seconds)
        return replace(stated(bare, part(scene.solver.tolerance)), scene=scene)

    monkeypatch.setattr(refine, "simulate_with_errors", run)
    return asked


def test_doubtful_is_what_is_off_by_more_than_a_twentieth_or_not_determined(bare):
    assert refine.doubtful(stated(bare, 0.04)) == []
    assert refine.doubtful(stated(bare, 0.06)) == ["stroke"]
    open_ = stated(bare, 0.04)
    open_.info["errors"]["stroke"]["determined"] = False
    assert refine.doubtful(open_) == ["stroke"]
    name = "peak_acceleration.differentiated_1khz"  # a reading that nobody asked for
    unknown = {**open_.info["errors"]["stroke"], "error": 1e3}
    assert refine.doubtful(replace(bare, info={**bare.info, "errors": {name: unknown}})) == []


def test_what_ideal_joints_dissipate_is_rounding_beside_what_is_exchanged(bare):
    balance = {"energy_input": -1e3, "energy_dissipated": 1e-6}
    run = bare.with_values(
        {name: np.full(len(bare.time), value) for name, value in balance.items()}
    )
    for error, names in ((0.9, []), (1.1, ["energy.dissipated"])):
        stated = {"error": error, "determined": True, "low": 0.0, "high": error}
        run.info["errors"] = {"energy.dissipated": stated}
        assert refine.doubtful(run) == names


def test_it_goes_on_until_it_is_known(bare, monkeypatch):
    asked, said = fake(monkeypatch, bare, lambda tolerance: 100.0 * tolerance, 0.2), []
    *_, (result, remark) = refine.refinements(SCENE, announce=lambda text: said.append(len(asked)))
    assert asked == [1e-3, 2.5e-4]
    assert result.scene.solver.tolerance == 2.5e-4
    assert said == [1]  # before the second one
    assert remark == ""


def test_it_ends_when_the_time_is_spent_and_says_what_is_left(bare, monkeypatch):
    asked, said = fake(monkeypatch, bare, lambda tolerance: 1.0, seconds=0.2), []
    *_, (_, remark) = refine.refinements(SCENE, announce=said.append)
    assert 2 <= len(asked) <= 4
    assert "--set solver.tolerance=" in remark and " s," in remark
    assert re.search(r"stroke: not known within 5%; goes on .* may take 0\.\d+ s; Ctrl-C", said[0])


def test_a_finer_run_that_stops_does_not_replace_the_finished_one(bare, monkeypatch):
    def run(scene, **_):
        if scene.solver.tolerance < 1e-3:
            return replace(bare, info={**bare.info, "status": "not converged", "reason": "why"})
        return stated(bare, 1.0)

    monkeypatch.setattr(refine, "simulate_with_errors", run)
    *_, (result, remark) = refine.refinements(SCENE)
    assert result.completed
    assert remark == "stroke: not known within 5%; at a tolerance of 0.00025 the run stops: why"


def test_ctrl_c_in_a_finer_run_keeps_the_finished_one(bare, monkeypatch, tmp_path, capsys):
    def run(scene, **_):
        if scene.solver.tolerance < 1e-3:
            raise KeyboardInterrupt
        return stated(bare, 1.0)

    monkeypatch.setattr(refine, "simulate_with_errors", run)
    SCENE.save(tmp_path / "scene.toml")
    out = tmp_path / "out"
    assert main(["run", str(tmp_path / "scene.toml"), "--no-pictures", "--out", str(out)]) == 130
    assert Result.load(out / "run.nc").completed
    said = capsys.readouterr()
    assert said.err.endswith("exu-press: interrupted\n")
    assert "written: run.nc, summary.json in" in said.out
    assert "peak acceleration" in said.out
