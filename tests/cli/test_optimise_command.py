"""exu-press optimise: a mechanism whose optimum is known, what it writes, what it refuses."""

import json

import pytest

from exu_press.cli import main
from exu_press.scene import Scene

STUDY = """
[scene]
mechanism = "slider_crank"
joints.crank_pin = "ideal"
revolutions = 0.3
[keys]
slider_crank.rod_length = {low = 0.2, high = 0.6}
slider_crank.slider_mass = {low = 800.0, high = 2000.0, log = true}
[[objective]]
quantity = "joints.wrist_pin.peak_force"
[[objective]]
quantity = "energy.stored"
sense = "largest"
[[limit]]
quantity = "peak_acceleration.resolved"
below = 20.0
[optimise]
trials = 16
"""
ONE = STUDY.replace('[[objective]]\nquantity = "energy.stored"\nsense = "largest"\n', "")
WRIST = "joints.wrist_pin.peak_force"


def run(tmp_path, text=STUDY, *more):
    (tmp_path / "study.toml").write_text(text)
    out = ["--out", str(tmp_path / "out"), "--workers", "1"]
    return main(["optimise", str(tmp_path / "study.toml"), *out, *more])


@pytest.mark.long
def test_several_objectives(tmp_path, capsys):
    assert run(tmp_path) == 0
    printed = capsys.readouterr().out
    assert "method: tpe (advised for 16 trials)" in printed
    assert "chosen, at a tenth of the tolerance: joints.wrist_pin.peak_force" in printed
    out = tmp_path / "out"
    told = json.loads((out / "optimise.json").read_text())
    assert len(told["front"]) == len(list((out / "front").glob("*.toml")))
    keys = told["front"][told["chosen"]]["keys"]
    scene = Scene.load(out / "chosen.toml")
    assert scene.slider_crank.rod_length == keys["slider_crank.rod_length"]
    assert (out / "front.png").stat().st_size > 10_000
    assert len((out / "trials.csv").read_text().splitlines()) == 17


def test_one_objective_that_a_solver_of_scipy_finds(tmp_path, capsys):
    """The lightest slider loads the wrist pin least; the limit keeps the rod from its shortest."""
    assert run(tmp_path, ONE.replace("trials = 16", "trials = 40"), "--no-pictures") == 0
    said = capsys.readouterr().out
    assert "method: nelder_mead (a run's error is" in said
    assert "chosen: slider_crank.slider_mass lies on the end of its range" in said
    keys = Scene.load(tmp_path / "out" / "chosen.toml").slider_crank
    assert keys.slider_mass == pytest.approx(800.0, rel=0.02)


def test_runs_too_short_for_the_objective_end_the_search(tmp_path, capsys):
    short = ONE.replace("trials = 16", "trials = 60").replace(WRIST, "drive.mean_power")
    assert run(tmp_path, short) == 2
    said = capsys.readouterr().err.splitlines()
    assert not any("warning" in line for line in said)
    assert said[-1].endswith("9 x too short to have drive.mean_power: nothing to choose from")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        pytest.param(
            "below = 20.0", "below = 1.0", "no run keeps the limits", marks=pytest.mark.long
        ),
        ("below = 20.0", "", "allowed are one of them, or above < below"),
        ("energy.stored", "joints.wrist_pin.peak_force", "two are of one quantity"),
        ("trials = 16", 'method = "nelder_mead"', "with 2 objectives allowed are"),
        ("low = 0.2, high = 0.6", "mean = 0.4, deviation = 0.01", "file for exu-press optimise"),
        pytest.param(
            "energy.stored", "energy.dissipated", "in each of 16 runs", marks=pytest.mark.long
        ),
    ],
)
def test_what_is_refused(tmp_path, capsys, old, new, said):
    assert run(tmp_path, STUDY.replace(old, new)) == 2
    shown = capsys.readouterr().err
    assert said in shown.splitlines()[-1]
