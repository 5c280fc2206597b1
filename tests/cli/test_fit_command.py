"""exu-press fit: what it prints and draws, and what it refuses in one line."""

import pytest

from exu_press.cli import main

STUDY = """
[scene]
mechanism = "slider_crank"
joints.crank_pin = "ideal"
revolutions = 0.05
[keys]
slider_crank.slider_mass = {low = 800.0, high = 2000.0, log = true}
slider_crank.rod_inertia = {low = 2.0, high = 3.0}
[[measured]]
quantity = "joints.wrist_pin.peak_force"
value = 27000.0
uncertainty = 300.0
[[measured]]
quantity = "joints.shaft.peak_force"
value = 31300.0
uncertainty = 3000.0
[fit]
starts = 1
"""


def run(tmp_path, text=STUDY, *more):
    tmp_path.mkdir(exist_ok=True)
    (tmp_path / "study.toml").write_text(text)
    out = ["--out", str(tmp_path / "out"), "--workers", "1"]
    return main(["fit", str(tmp_path / "study.toml"), *out, *more])


def test_lines_and_pictures(tmp_path, capsys):
    assert run(tmp_path) == 0
    printed = capsys.readouterr().out
    assert "slider_crank.slider_mass, kg" in printed
    assert "not determined: slider_crank.rod_inertia" in printed
    assert "nothing is left to judge" not in printed
    last = printed.splitlines()[-1]
    assert last.startswith("written: fit.json, fitted.toml, fit.png, profiles.png in")
    for name in ("fit.png", "profiles.png"):
        assert (tmp_path / "out" / name).stat().st_size > 10_000


@pytest.mark.long
def test_a_number_that_no_values_give_is_told(tmp_path, capsys):
    """As many keys as numbers: chi-square has no degree of freedom, and is not small."""
    of_rod, of_shaft = STUDY.index("slider_crank.rod_inertia"), STUDY.rindex("[[measured]]")
    text = STUDY[:of_rod] + STUDY[STUDY.index("[[measured]]") : of_shaft]
    reached = text.replace("27000.0", "12000.0") + "[fit]\nstarts = 1\n"
    assert run(tmp_path / "reached", reached, "--no-pictures") == 0
    assert "no values of the keys" not in capsys.readouterr().out
    missed = reached.replace("value = 12000.0", "value = 90000.0")
    assert run(tmp_path / "missed", missed, "--no-pictures") == 0
    said = capsys.readouterr().out
    assert "nothing is left to judge the scene by" in said
    assert "no values of the keys within their ranges give the measured numbers" in said


def test_no_run_gives_a_number(tmp_path, capsys):
    assert run(tmp_path, STUDY.replace("[scene]", "[scene]\nsolver.max_steps = 2", 1)) == 2
    assert "0 gave numbers" in capsys.readouterr().err
