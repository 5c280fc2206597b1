"""exu-press sensitivity: what it prints and draws, and what it refuses in one line."""

import pytest

from exu_press.cli import main
from exu_press.schema.csv_table import read_csv

STUDY = """
[scene]
mechanism = "slider_crank"
joints.crank_pin = "ideal"
revolutions = 0.02
[keys]
slider_crank.crank_radius = {mean = 0.03, deviation = 1e-5}
slider_crank.slider_mass = {low = 1300.0, high = 1400.0}
[sensitivity]
quantities = ["peak_velocity", "joints.wrist_pin.peak_force"]
samples = 8
"""


def run(tmp_path, text=STUDY, *more):
    (tmp_path / "study.toml").write_text(text)
    out = ["--out", str(tmp_path / "out"), "--workers", "1"]
    return main(["sensitivity", str(tmp_path / "study.toml"), *out, *more])


def test_lines_and_picture(tmp_path, capsys):
    assert run(tmp_path) == 0
    printed = capsys.readouterr().out
    assert "of the presses built no more than" in printed
    assert "slider_crank.slider_mass" in printed
    assert printed.splitlines()[-1].startswith(
        "written: sensitivity.json, samples.csv, sensitivity.png in"
    )
    assert (tmp_path / "out" / "sensitivity.png").stat().st_size > 10_000
    samples = read_csv(tmp_path / "out" / "samples.csv")
    assert set(map(len, samples.values())) == {16}
    assert main(["report", str(tmp_path / "out"), "--quiet"]) == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Shares: peak_velocity" in page and "Presses of the sample" in page


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("samples = 8", "samples = 9", "a power of two"),
        ('[sensitivity]\nquantities = ["peak_velocity", "joints.wrist_pin.peak_force"]\n', "",
         "sensitivity.quantities = (): allowed is a list of names"),
    ],
)  # fmt: skip
def test_what_is_refused(tmp_path, capsys, old, new, said):
    assert run(tmp_path, STUDY.replace(old, new)) == 2
    shown = capsys.readouterr().err
    assert said in shown
    assert len(shown.splitlines()) == 1


@pytest.mark.long
def test_too_many_failed_runs(tmp_path, capsys, processes):
    text = STUDY.replace("[scene]", "time_limit = 1e-3\n[scene]", 1)
    assert run(tmp_path, text) == 2
    shown = capsys.readouterr().err
    assert "gave numbers, " in shown
    assert "too few for 8 samples" in shown
