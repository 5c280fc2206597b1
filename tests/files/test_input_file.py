"""Files that a user names: what is no text on a disk is refused in one line."""

import os
import re
from pathlib import Path

import pytest

from exu_press import InputError, Scene
from exu_press.cli import main
from exu_press.files.input_file import read_bytes, read_text


@pytest.mark.parametrize("path", ["/dev/zero", "/proc"])
def test_devices_and_directories_are_refused(path):
    with pytest.raises(InputError, match=r"allowed is a file"):
        read_bytes(Path(path))


def test_a_pipe_is_refused_and_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.toml")
    with pytest.raises(InputError, match="no regular file"):
        Scene.load(tmp_path / "pipe.toml")


def test_a_file_of_gigabytes_is_refused_unread(tmp_path):
    path = tmp_path / "large.toml"
    with path.open("wb") as file:
        file.truncate(5_000_000_000)
    with pytest.raises(InputError, match=r"has 5000 MB; allowed are 100 MB"):
        read_text(path)


def test_a_mark_of_byte_order_is_no_part_of_the_text(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text("\ufeffrevolutions = 0.5\n", encoding="utf-8")
    assert Scene.load(path).revolutions == 0.5


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
        ('mechanism = "' + 1_000_000 * "x" + '"', "unknown|allowed"),
    ],
)
def test_hostile_scenes_are_one_short_line(tmp_path, capsys, text, message):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1 and len(told) < 2_000
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


def test_a_message_shows_names_that_no_terminal_can():
    assert str(InputError("joints.t\x1f\u2028\n is µm")) == r"joints.t\x1f\u2028\n is µm"


def test_a_key_with_control_characters_is_named_in_one_line(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    scene.write_text('[joints]\n"pin\\u001b[31m" = {kind = "dry"}\n', encoding="utf-8")
    assert main(["run", str(scene)]) == 2
    told = capsys.readouterr().err
    assert told.strip().isprintable() and r"pin\x1b[31m" in told


def test_of_a_long_word_the_ends_are_shown():
    told = str(InputError(f"mechanism = '{'x' * 5000}y': allowed is one of a, b"))
    assert told.startswith("mechanism = 'xxx") and told.endswith("xy': allowed is one of a, b")
    assert len(told) < 500
