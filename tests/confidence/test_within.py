"""A wanted error finds its tolerance; where none does, the distribution is told."""

import dataclasses
import functools

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.cli import main
from exu_press.confidence import deliver, within
from exu_press.confidence.distribution import LEAST_REVOLUTIONS, distributions, percentiles
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
    """The dry slider-crank's peaks scatter from revolution to revolution; what adds up has none."""
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, solver={"tolerance": 2e-2})
    names = [NAME, "peak_velocity", "energy.dissipated", "strokes.range"]
    found = distributions(scene, names, within=1e-9, least=7, most=14)
    assert found.keys() == {NAME, "peak_velocity"}
    assert found[NAME].revolutions == 14
    (low, *_), (median, *bounds), (high, *_) = found[NAME].percentiles.values()
    assert low <= median <= high
    assert bounds[0] <= median <= bounds[1]


@pytest.mark.parametrize("count", [LEAST_REVOLUTIONS, 100])
@pytest.mark.parametrize("draw", ["normal", "exponential"])
def test_bounds_of_percentiles_have_their_confidence(count, draw):
    """Of any distribution; nine in ten, or a few more, as samples are counted."""
    random = np.random.default_rng(3)
    true = np.percentile(getattr(random, draw)(size=1_000_000), [5.0, 50.0, 95.0])
    inside = np.zeros(3)
    for _ in range(400):
        found = percentiles(getattr(random, draw)(size=count).tolist())
        inside += [low <= x <= high for x, (_, low, high) in zip(true, found.values(), strict=True)]
    assert (inside / 400 > 0.87).all()
    assert (inside / 400 < 0.98).all()


def test_of_fewer_samples_the_largest_may_be_below_the_percentile():
    assert 0.95**LEAST_REVOLUTIONS <= 0.05 < 0.95 ** (LEAST_REVOLUTIONS - 1)


def test_where_no_tolerance_delivers_the_distribution_is_told(monkeypatch):
    few = functools.partial(distributions, least=7, most=7)
    monkeypatch.setattr(within, "distributions", few)
    monkeypatch.setattr(within, "FINEST", 1e-2)
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.05)
    found = deliver(scene.replace("solver.tolerance", 2e-2), 1e-5)
    assert found.tolerance == 1e-2
    assert found.missed[NAME].revolutions == 7
    assert found.missed["energy.dissipated"] is None
    lines = "\n".join(delivered_lines(found, 1e-5))
    assert f"{NAME}: not within 0.001 %, down to a tolerance of 0.01" in lines
    assert "over 7 revolutions: 5 % below" in lines
    assert "no distribution" in lines


def test_a_run_that_stops_early_ends_the_search():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.1)
    found = deliver(scene.replace("solver.max_steps", 20), 1e-6, NAME)
    assert not found.result.completed
    assert found.missed == {NAME: None}


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
    arguments = ["run", "slider_crank", "--figure", NAME, "--out", str(tmp_path)]
    assert main(arguments) == 2
    assert "only together with --within" in capsys.readouterr().err


def test_a_figure_that_is_not_there_is_refused():
    scene = Scene(mechanism="slider_crank", revolutions=0.01)
    with pytest.raises(InputError, match="--figure colour"):
        headline(deliver(scene, 0.9).result, "colour")
