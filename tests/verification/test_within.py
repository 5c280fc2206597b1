"""A wanted error finds its tolerance; where none does, the distribution is told."""

import dataclasses
import functools
import math

import pytest

from exu_press import InputError, Scene, simulate
from exu_press.cli import main
from exu_press.verification import within
from exu_press.verification.distribution import distributions
from exu_press.verification.within import (
    COARSE,
    AchievedAccuracy,
    accuracy_lines,
    find_tolerance,
)

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
    few = functools.partial(distributions, minimum=14, maximum=14)
    monkeypatch.setattr(within, "distributions", few)
    monkeypatch.setattr(within, "FINEST", 1e-2)

    def chaotic(scene, **_):
        run = simulate(scene, errors=True)
        return dataclasses.replace(run, info={**run.info, "horizon": 0.01})

    monkeypatch.setattr(within, "simulate_with_errors", chaotic)
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.05)
    found = find_tolerance(scene.replace({"solver.tolerance": 2e-2}), 1e-5)
    assert found.tolerance == 1e-2
    assert found.unmet[NAME].revolutions == 14
    assert found.unmet["energy.dissipated"] is None


def test_what_no_tolerance_makes_smaller_is_named_at_once(monkeypatch):
    """The table of a film's law leaves half a percent of the film, of which 0.6 are left here."""
    scene = Scene(
        mechanism="slider_crank",
        joints={"crank_pin": "lubricated"},
        film={"law": "finite", "viscosity": 0.1, "length": 0.05},
        revolutions=0.02,
    )
    run = simulate(scene, errors=True)
    monkeypatch.setattr(within, "simulate_with_errors", lambda *_, **__: run)
    found = find_tolerance(scene, 1e-3, name := "joints.crank_pin.max_eccentricity_ratio")
    ratio = run.quantity(name).value
    assert found.tolerance == 1e-3 and found.unmet == {name: None}
    assert found.fixed[name].relative == pytest.approx(0.005 * (1.0 - ratio) / ratio)
    (line,) = accuracy_lines(found, 1e-3)
    assert "the table of its film law alone leaves" in line


def test_a_motion_that_is_not_chaotic_has_no_distribution(calm, monkeypatch):
    run = dataclasses.replace(calm, info={**calm.info, "errors": {}})
    monkeypatch.setattr(within, "simulate_with_errors", lambda *_, **__: run)
    monkeypatch.setattr(within, "distributions", lambda *_, **__: pytest.fail("it was computed"))
    found = find_tolerance(calm.scene, 0.01, NAME)
    assert found.unmet == {NAME: None}
    assert accuracy_lines(found, 0.01)[-1] == "  no distribution: motion is not chaotic"


def test_a_run_that_stops_early_ends_the_search():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.1)
    found = find_tolerance(scene.replace({"solver.max_steps": 20}), 1e-6, NAME)
    assert not found.result.completed
    assert found.unmet == {NAME: None}


def test_what_cannot_be_asked(tmp_path, capsys):
    fixed = Scene(mechanism="slider_crank", revolutions=0.01, solver={"step": 1e-5})
    with pytest.raises(InputError, match="fixed steps"):
        find_tolerance(fixed, 0.01)
    for arguments, message in (
        (["--figure", NAME], "only together with --within"),
        (["--within", "1%", "--once"], "--once: not together with --within"),
        (["--within", "1%", "--no-error"], "--no-error: not together with --within"),
        (["--within", "1%", "--from", "run.nc"], "--from: not together with --within"),
    ):
        assert main(["run", "slider_crank", *arguments, "--out", str(tmp_path / "out")]) == 2
        assert message in capsys.readouterr().err
    for share in ("1%%", "nan", "100%"):
        with pytest.raises(SystemExit, match="2"):
            main(["run", "slider_crank", "--within", share])
        assert f"'{share}': allowed is 0.001% or more" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_figure_that_is_not_there_is_refused_before_the_runs(monkeypatch):
    scene = Scene(mechanism="slider_crank", revolutions=0.01)
    monkeypatch.setattr(within, "simulate_with_errors", lambda *_, **__: pytest.fail("it ran"))
    with pytest.raises(InputError, match="colour"):
        find_tolerance(scene, 0.9, "colour")


@pytest.fixture(scope="module")
def calm():
    """Return a run that knows no horizon."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.2)
    run = simulate(scene)
    return dataclasses.replace(run, info={**run.info, "horizon": None, "lyapunov_exponent": None})


def test_where_the_motion_is_chaotic_the_horizon_is_told(calm):
    """240 rpm: 1.44 deg a millisecond; exp(1000 t) is tenfold in 2.3 ms. A pressed pin has no
    impacts, one that starts in the middle of its bearing has some."""
    hitting = simulate(calm.scene.replace({"start": "centred", "revolutions": 0.05}))
    impacts = hitting.quantity("joints.crank_pin.impacts").value
    for run, ending in (
        (calm, "2.3 ms"),
        (hitting, f"{math.exp(1000.0 * hitting.time[-1] / impacts):.2g}-fold an impact"),
    ):
        info = {**run.info, "horizon": 0.004, "lyapunov_exponent": 1000.0}
        chaotic = dataclasses.replace(run, info=info)
        line, _, _ = accuracy_lines(AchievedAccuracy(chaotic, 1e-6, {NAME: None}), 0.01)
        assert "from t = 4 ms on, 6 deg of the crank after the start" in line
        assert "grow tenfold in 2.3 ms" in line and line.endswith(ending)
