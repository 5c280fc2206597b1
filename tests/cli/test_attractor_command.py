"""exu-press attractor: what it refuses before anything runs."""

import pytest

from exu_press.cli import main


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--set", "revolutions=200"], "--set revolutions: attractor has its own; allowed is --"),
        (["--set", "settle=2"], "--set settle: attractor has its own; allowed is --skip N"),
        (["--skip", "0"], "--skip 0: allowed is a whole number >= 1"),
        (
            ["--revolutions", "30"],
            "--revolutions 30: allowed are at least 48, for periods up to 16",
        ),
        (["--set", "joints.crank_pin=ideal"], "joints: none has clearance"),
        (["--format", ".bmp"], "--format .bmp: allowed are .png"),
    ],
)
def test_one_line_for_what_cannot_be(arguments, words, tmp_path, capsys):
    assert main(["attractor", "slider_crank", *arguments, "--out", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1
    assert {file.name for file in tmp_path.iterdir()} <= {".lock"}
