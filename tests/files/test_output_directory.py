"""What is written below --out: whole or not at all, never through a link, one command at a time."""

import os

import pytest

from exu_press import InputError
from exu_press.cli import main
from exu_press.files.lock import lock_directory
from exu_press.files.output_directory import output_directory, replacing, subdirectory

SECRET = '{"token": "secret"}'

RUN = ["run", "slider_crank", "--set", "revolutions=0.01", "--no-error", "--no-pictures", "--quiet"]

STUDY = """
save_runs = true
[scene]
mechanism = "slider_crank"
revolutions = 0.01
[keys]
speed_rpm = [100.0]
"""


@pytest.fixture
def victim(tmp_path):
    """A file outside the output directory, which must stay as it is."""
    file = tmp_path / "victim.json"
    file.write_text(SECRET)
    yield file
    assert file.read_text() == SECRET


@pytest.fixture
def out(tmp_path):
    (tmp_path / "out").mkdir()
    return tmp_path / "out"


def test_a_temporary_name_is_not_known_beforehand_and_no_link_there_followed(
    victim, out, monkeypatch
):
    names = set()
    for _ in range(3):
        with replacing(out / ("n" * 250)) as partial:
            partial.write_text("new")
            names.add(partial.name)
    assert len(names) == 3
    (out / "usual").touch()
    assert (out / ("n" * 250)).stat().st_mode == (out / "usual").stat().st_mode
    monkeypatch.setattr("secrets.token_hex", lambda count: "0" * count)
    (out / ".run.nc.00000000.part").symlink_to(victim)
    with pytest.raises(InputError, match="cannot be written"), replacing(out / "run.nc"):
        pass


def test_a_link_in_the_place_of_a_result_is_replaced(victim, out, tmp_path):
    """The output directory itself may be a link."""
    for name in ("run.nc", "summary.json"):
        (out / name).symlink_to(victim)
    (tmp_path / "link").symlink_to(out)
    assert main([*RUN, "--out", str(tmp_path / "link")]) == 0
    assert (out / "run.nc").is_file()
    assert not any((out / name).is_symlink() for name in ("run.nc", "summary.json"))
    with pytest.raises(InputError, match="is a link"):
        subdirectory(tmp_path, "link")


@pytest.mark.parametrize("name", ["runs.jsonl", ".lock", "runs"])
@pytest.mark.parametrize("target", ["victim.json", "nothing", "directory"])
def test_a_study_writes_through_no_link(victim, out, tmp_path, name, target, capsys):
    (tmp_path / "directory").mkdir()
    (out / name).symlink_to(tmp_path / target)
    (tmp_path / "study.toml").write_text(STUDY)
    arguments = ["sweep", str(tmp_path / "study.toml"), "--workers", "1", "--no-pictures"]
    assert main([*arguments, "--quiet", "--out", str(out)]) == 2
    assert f"{out / name}: is a link" in capsys.readouterr().err
    assert not (tmp_path / "nothing").exists()
    assert not [*(tmp_path / "directory").iterdir()]


@pytest.mark.parametrize("kind", ["hard link", "pipe"])
def test_rows_go_into_no_file_that_has_another_name_and_wait_for_no_pipe(
    victim, out, tmp_path, capsys, kind
):
    """A hard link cannot be told from the file itself: both are one file of two names."""
    if kind == "pipe":
        os.mkfifo(out / "runs.jsonl")
    else:
        os.link(victim, out / "runs.jsonl")
    (tmp_path / "study.toml").write_text(STUDY)
    assert main(["sweep", str(tmp_path / "study.toml"), "--quiet", "--out", str(out)]) == 2
    assert "no file of its own" in capsys.readouterr().err


def test_a_directory_is_known_by_any_of_its_names(out, monkeypatch):
    monkeypatch.chdir(out.parent)
    with lock_directory(output_directory("out")) as first, lock_directory(out) as second:
        assert first.resolve() == second.resolve()
