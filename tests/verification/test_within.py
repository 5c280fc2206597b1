"""A wanted error finds its tolerance; where none does, the distribution is told."""

import functools

import pytest

from exu_press import InputError, Scene
from exu_press.cli import main
from exu_press.verification import within
from exu_press.verification.distribution import distributions
from exu_press.verification.within import COARSE, find_tolerance

NAME = "peak_acceleration.resolved"


@pytest.mark.long
def test_the_tolerance_delivers_and_is_no_finer():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.03)
    fine = scene.replace({"solver.tolerance": 1e-5})
    found = find_tolerance(fine, 1e-2, NAME)
    told = found.result.info["errors"][NAME]
    value = found.result.quantity("peak_acceleration.resolved").value
    assert not found.unmet
    assert told["error"] <= 1e-2 * value
    assert found.tolerance > COARSE * 1e-5


@pytest.mark.long
def test_where_no_tolerance_delivers_the_distribution_is_told(monkeypatch):
    few = functools.partial(distributions, minimum=7, maximum=7)
    monkeypatch.setattr(within, "distributions", few)
    monkeypatch.setattr(within, "FINEST", 1e-2)
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.05)
    found = find_tolerance(scene.replace({"solver.tolerance": 2e-2}), 1e-5)
    assert found.tolerance == 1e-2
    assert found.unmet[NAME].revolutions == 7
    assert found.unmet["energy.dissipated"] is None


def test_a_run_that_stops_early_ends_the_search():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.1)
    found = find_tolerance(scene.replace({"solver.max_steps": 20}), 1e-6, NAME)
    assert not found.result.completed
    assert found.unmet == {NAME: None}


def test_what_cannot_be_asked(tmp_path, capsys):
    fixed = Scene(mechanism="slider_crank", revolutions=0.01, solver={"step": 1e-5})
    with pytest.raises(InputError, match="fixed steps"):
        find_tolerance(fixed, 0.01)
    arguments = ["run", "slider_crank", "--figure", NAME, "--out", str(tmp_path)]
    assert main(arguments) == 2
    assert "only together with --within" in capsys.readouterr().err


def test_a_figure_that_is_not_there_is_refused_before_the_runs(monkeypatch):
    scene = Scene(mechanism="slider_crank", revolutions=0.01)
    monkeypatch.setattr(within, "simulate_with_errors", lambda *_, **__: pytest.fail("it ran"))
    with pytest.raises(InputError, match="colour"):
        find_tolerance(scene, 0.9, "colour")
