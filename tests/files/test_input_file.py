"""Files that a user names: what is no text on a disk is refused in one line."""

import os
import re
from pathlib import Path

import pytest

from exu_press import InputError
from exu_press.cli import main
from exu_press.files.input_file import read_bytes, read_text


def test_devices_directories_and_pipes_are_refused_and_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (Path("/dev/zero"), Path("/proc"), tmp_path / "pipe"):
        with pytest.raises(InputError, match=r"allowed is a file"):
            read_bytes(path)


def test_a_file_of_gigabytes_is_refused_unread(tmp_path):
    path = tmp_path / "large.toml"
    with path.open("wb") as file:
        file.truncate(5_000_000_000)
    with pytest.raises(InputError, match=r"has 5000 MB; allowed are 100 MB"):
        read_text(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("revolutions = " + "1" * 5000, "too many digits"),
        ("joints = " + "[" * 3000 + "]" * 3000, "nests too deep"),
        ("revolutions = 0,5", "decimal comma"),
        ('mechanism = "a\\u0000b.toml"', "cannot be read"),
        ("revolutions = 1e308", "allowed is a number"),
        ("speed_rpm = 1e-320", r"its magnitude is within 1e-30 and 1e\+30"),
        ("joints.crank_pin = {kind = 'dry', clearance = 1e-320}", "its magnitude is within"),
        ("guide.lateral_stiffness = 1e308", "its magnitude is within"),
        ("output.samples = [0.0, 1e300]", "its magnitude is within"),
        ("[" + "a." * 2000 + "a]", "nests too deep"),
        ('[load.a]\nkind = "table"\nfile = "/dev/zero"', "no regular file"),
        ('mechanism = "' + 1_000_000 * "x" + '"', r"mechanism = 'xxx.*: allowed is one of 'press'"),
        ('[joints]\n"µ\\u001b[31m\\u2028" = "dry"', r"joints\.µ\\x1b\[31m\\u2028"),
    ],
)
def test_hostile_scenes_are_one_short_line(tmp_path, capsys, text, message):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and len(told) < 2_000 and told.strip().isprintable()
    assert re.search(message, told), told


@pytest.mark.parametrize("value", ["1" * 5000, "[" * 3000 + "]" * 3000])
def test_hostile_assignments_are_one_line(capsys, value, tmp_path):
    arguments = ["run", "press", "--set", f"revolutions={value}", "--out", str(tmp_path)]
    assert main(arguments) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_field_of_a_table_may_not_be_endless(tmp_path, capsys):
    (tmp_path / "force.csv").write_text(f"time,force\n0,{'1' * 200_000}\n1,2\n")
    scene = tmp_path / "scene.toml"
    scene.write_text('[load.a]\nkind = "table"\nfile = "force.csv"\n')
    assert main(["run", str(scene), "--out", str(tmp_path / "out")]) == 2
    assert "allowed are" in capsys.readouterr().err
