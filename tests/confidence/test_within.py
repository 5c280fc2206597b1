"""A wanted error finds its tolerance; where none does, the distribution is told."""

import dataclasses

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.cli import main
from exu_press.confidence import deliver
from exu_press.confidence.distribution import distribution, percentiles
from exu_press.confidence.told import delivered_lines
from exu_press.confidence.within import COARSE, Delivered, headline

NAME = "peak_acceleration.resolved"


def test_the_tolerance_delivers_and_is_no_finer():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.03)
    fine = scene.replace("solver.tolerance", 1e-5)
    found = deliver(fine, 1e-2, NAME)
    told = found.result.info["errors"][NAME]
    value = found.result.summary()["peak_acceleration"]["resolved"]
    assert not found.missed
    assert told["error"] <= 1e-2 * value
    assert found.tolerance > COARSE * 1e-5
    assert "tolerance" in delivered_lines(found, 1e-2)[0]


def test_distribution_of_revolutions():
    """The dry slider-crank's peaks scatter from revolution to revolution."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, solver={"tolerance": 2e-2})
    found = distribution(scene, NAME, within=1e-9, most=7)
    assert found.revolutions == 7
    (low, *_), (median, *bounds), (high, *_) = found.percentiles.values()
    assert low <= median <= high
    assert bounds[0] <= median <= bounds[1]


def test_percentiles_of_normal_samples():
    random = np.random.default_rng(3)
    found = percentiles(random.normal(100.0, 10.0, 400).tolist())
    assert found[5.0][1] < 100.0 - 16.45 < found[5.0][2]
    assert found[95.0][1] < 100.0 + 16.45 < found[95.0][2]


def test_what_is_not_determined_is_told(monkeypatch):
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02)
    result = deliver(scene, 0.5, NAME).result
    info = {**result.info, "errors_from": 0.004, "amplification": 1000.0}
    chaotic = dataclasses.replace(result, info=info)
    lines = delivered_lines(Delivered(chaotic, 1e-6, {NAME: None}), 0.01)
    assert "from t = 4 ms on" in lines[0]
    assert "tenfold in 2.3 ms" in lines[0]
    assert NAME in lines[1]


def test_what_cannot_be_asked(tmp_path, capsys):
    fixed = Scene(mechanism="slider_crank", revolutions=0.01, solver={"step": 1e-5})
    with pytest.raises(InputError, match="fixed steps"):
        deliver(fixed, 0.01)
    with pytest.raises(InputError, match="adds up"):
        distribution(fixed, "energy.input", 0.01)
    arguments = ["run", "slider_crank", "--figure", NAME, "--out", str(tmp_path)]
    assert main(arguments) == 2
    assert "only together with --within" in capsys.readouterr().err


def test_a_figure_that_is_not_there_is_refused():
    scene = Scene(mechanism="slider_crank", revolutions=0.01)
    with pytest.raises(InputError, match="--figure colour"):
        headline(deliver(scene, 0.9).result, "colour")
