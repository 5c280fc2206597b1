"""exu-press rerun: the same figures from the same inputs, and what it refuses."""

import signal

import pytest

from exu_press.cli import main
from exu_press.model import Model
from exu_press.result import Result
from exu_press.verification.agreement import agreement
from exu_press.verification.simulate import simulate

SCENE = """
mechanism = "slider_crank"
revolutions = 0.05
solver.tolerance = 1e-2
[joints.crank_pin]
kind = "dry"
clearance = 1e-4
"""

RUN = ["run", "scene.toml", "--once", "--no-pictures", "--quiet", "--out", "o"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    (tmp_path / "scene.toml").write_text(SCENE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_same_inputs_give_the_same_digits_with_errors_and_from_another_run(capsys):
    assert main(RUN) == 0
    assert main(["rerun", "o"]) == 0
    assert "figures are identical in all digits" in capsys.readouterr().out
    assert main([*RUN[:-1], "p", "--from", "o", "--no-error"]) == 0
    assert Result.load("p/run.nc").info["provenance"]["start"] == "o/run.nc"
    assert main(["rerun", "p", "--out", "again.nc"]) == 0
    assert "identical in all digits" in capsys.readouterr().out
    first, again = Result.load("p/run.nc"), Result.load("again.nc")
    assert (first["slider_position"] == again["slider_position"]).all()


@pytest.mark.parametrize("errors", [[], ["--no-error"]])
def test_ctrl_c_keeps_nothing_and_says_no_more_than_that(errors, folder, monkeypatch, capsys):
    assert main([*RUN, *errors]) == 0
    watch = Model.watch
    pressed = lambda *step: signal.raise_signal(signal.SIGINT) or watch(*step)  # noqa: E731
    monkeypatch.setattr(Model, "watch", pressed)
    assert main(["rerun", "o", "--out", "again.nc"]) == 130
    said = capsys.readouterr()
    assert said.err.endswith("exu-press: interrupted\n") and not said.out
    assert not (folder / "again.nc").exists()


def test_a_run_with_a_motor_is_repeated_with_the_revolutions_that_its_oil_adds(folder, capsys):
    oil = "viscosity_cst = [68.0, 8.7], density = 870.0, supply_celsius = 40.0, conductance = 5.0"
    motor = "rated_torque = 1e3, slip = 0.05, no_load_speed_rpm = 250.0, inertia = 1.0"
    (folder / "scene.toml").write_text(
        'mechanism = "slider_crank"\nrevolutions = 3.3\nsettle = 1.1\nsolver.tolerance = 0.1\n'
        f'joints.crank_pin = "lubricated"\nfilm.oil = {{{oil}}}\ndrive = {{{motor}}}\n'
    )
    assert main([*RUN, "--no-error"]) == 0
    assert Result.load("o/run.nc").info["added_revolutions"] == 1
    assert main(["rerun", "o"]) == 0
    assert "figures are identical in all digits" in capsys.readouterr().out


def test_a_changed_input_is_refused_unless_it_is_allowed(folder, capsys):
    assert main([*RUN, "--no-error"]) == 0
    (folder / "scene.toml").write_text(SCENE.replace("0.05", "0.04"))
    assert main(["rerun", "o"]) == 2
    assert "scene.toml (changed); allowed is --changed" in capsys.readouterr().err
    assert main(["rerun", "o", "--changed", "--out", "o/run.nc"]) == 2
    assert "is the run itself; allowed is another file" in capsys.readouterr().err
    assert main(["rerun", "o", "--changed"]) == 1, "a shorter run"
    said = capsys.readouterr().out
    assert "scene.toml (changed)" in said and "do not agree" in said


def test_figures_of_a_finer_run_agree_within_both_errors():
    assert main([*RUN, "--set", "solver.tolerance=1e-2"]) == 0
    coarse = Result.load("o/run.nc")
    fine = simulate(coarse.scene.replace({"solver.tolerance": 3e-3}), errors=True)
    compared = agreement(coarse, fine)
    assert compared.agrees and compared.within and compared.identical
    without = simulate(fine.scene)
    assert set(agreement(coarse, without).different) >= {"peak_acceleration.resolved"}


@pytest.mark.parametrize(
    ("name", "foreign", "words", "text"),
    [
        ("files", {"/dev/zero": "0"}, [], "/dev/zero (missing)"),
        ("files", {"a\0b": "0"}, [], "(missing)"),
        ("command", "exu-press run 'scene", ["--changed"], "none of this version: No closing"),
        ("command", "exu-press run s --help", ["--changed"], "unrecognized arguments: --help"),
    ],
)
def test_what_a_foreign_result_says_is_refused(folder, capsys, name, foreign, words, text):
    """A device that never ends, and commands that are none."""
    assert main([*RUN, "--no-error"]) == 0
    run = Result.load("o/run.nc")
    run.info["provenance"] = {**run.info["provenance"], name: foreign}
    run.save("foreign.nc")
    (folder / "scene.toml").write_text(SCENE + "\n")
    assert main(["rerun", "foreign.nc", *words]) == 2
    assert text in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["."], ".: has none of run.nc; allowed is a directory that has one"),
        (["o", "--out", "a.txt"], "--out a.txt: allowed is a name that ends in .nc"),
    ],
)
def test_what_is_no_run_or_no_file_of_one_is_refused(arguments, message, folder, capsys):
    (folder / "o").mkdir()
    (folder / "o" / "run.nc").touch()
    assert main(["rerun", *arguments]) == 2
    assert message in capsys.readouterr().err
