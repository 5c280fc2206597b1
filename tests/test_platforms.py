"""What differs between systems, as far as one of them can show it: paths, encodings, line ends."""

import io
import os
import subprocess
import sys

import matplotlib
import pytest

from exu_press import Result, Scene
from exu_press.cli import main
from exu_press.parallel.rows import RowFile
from fe_models.temporary import TemporaryFolder, remove_abandoned

SCENE = """mechanism = "slider_crank"
revolutions = 0.02

[joints.crank_pin]
kind = "dry"
clearance = 1e-4
"""


@pytest.fixture
def home(tmp_path):
    """A home as a German Windows may have it."""
    folder = tmp_path / "Jörg Müller Ω" / "eigene Läufe"
    folder.mkdir(parents=True)
    return folder


def run_command(words, home):
    """Run a command in a home, on a console of Windows's old encoding."""
    bare = {name: value for name, value in os.environ.items() if not name.startswith("XDG_")}
    environment = {
        **bare,
        "HOME": str(home),
        "USERPROFILE": str(home),
        "PYTHONIOENCODING": "cp1252",
        "PYTHONUTF8": "0",
        "MPLBACKEND": "nonsense",  # a display that matplotlib does not know is not needed
        "MPLCONFIGDIR": matplotlib.get_configdir(),  # with its list of fonts
    }
    return subprocess.run(
        [sys.executable, "-m", "exu_press", *words],
        cwd=home,
        env=environment,
        capture_output=True,
        check=False,
    )


def test_a_home_with_blanks_and_umlauts_and_a_console_without_unicode(home):
    (home / "Übung Ω.toml").write_text(SCENE, encoding="utf-8")
    out = home / "Lauf Ω 1"
    done = run_command(["run", "Übung Ω.toml", "--out", out.name, "--no-error"], home)
    assert done.returncode == 0, done.stderr.decode("cp1252")
    assert "slider" in done.stdout.decode("cp1252") or done.stdout
    assert Result.load(out / "run.nc").completed
    assert list(out.glob("*.png"))


def test_names_that_a_console_lacks_letters_for_are_written_as_escapes(home, monkeypatch):
    console = io.TextIOWrapper(io.BytesIO(), encoding="cp1252", write_through=True)
    (home / "Ω.toml").write_text(SCENE, encoding="utf-8")
    monkeypatch.setattr("sys.stdout", console)
    words = ["run", str(home / "Ω.toml"), "--out", str(home / "Ω")]
    assert main([*words, "--no-error", "--no-pictures"]) == 0
    assert rb"\u03a9" in console.buffer.getvalue()


@pytest.mark.parametrize("begin", ["", "\ufeff"], ids=["plain", "with a byte order mark"])
def test_line_ends_of_windows(home, begin):
    plain, windows = home / "plain.toml", home / "windows.toml"
    plain.write_bytes(SCENE.encode())
    windows.write_bytes((begin + SCENE).replace("\n", "\r\n").encode())
    assert Scene.load(windows) == Scene.load(plain)


def test_rows_are_kept_byte_by_byte_on_a_system_without_links_and_pipes(home, monkeypatch):
    monkeypatch.setattr("exu_press.parallel.rows.SYSTEM_FLAGS", 0)
    row = {"status": "ok", "reason": "", "name": "Ω"}
    with RowFile(home / "runs.jsonl") as file:
        file.append("key", None, row)
    with RowFile(home / "runs.jsonl") as file:
        assert file.finished_row("key", None) == row


def test_temporary_folders_need_no_lock_of_files(monkeypatch):
    monkeypatch.setattr("sys.platform", "win32")
    with TemporaryFolder() as folder:
        (folder / "file").touch()
        remove_abandoned()
        assert (folder / "file").exists()
    assert not folder.exists()
