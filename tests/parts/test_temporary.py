"""Temporary folders go with their objects, and those of killed processes with the next one."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from exu_press.cli import main
from fe_models.temporary import TemporaryFolder, remove_abandoned, replacing


@pytest.fixture(autouse=True)
def base(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path


def left_by_a_kill(base):
    """Return the folder of a process that is killed."""
    code = (
        f"import tempfile, sys; tempfile.tempdir = {str(base)!r}\n"
        "from fe_models.temporary import TemporaryFolder\n"
        "folder = TemporaryFolder(); (folder.path / 'values').write_text('1')\n"
        "print(folder.path, flush=True); sys.stdin.read()"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    folder = Path(process.stdout.readline().strip())
    with TemporaryFolder():
        assert (folder / "values").exists()  # its process lives
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert (folder / "values").exists()
    return folder


@pytest.mark.skipif(sys.platform == "win32", reason="folders are not locked there")
def test_what_a_killed_process_leaves_goes_at_the_next_start_or_command(base):
    folder = left_by_a_kill(base)
    with TemporaryFolder() as other:
        assert list(base.iterdir()) == [other]
    assert not folder.exists()
    folder = left_by_a_kill(base)
    assert main(["new", str(base / "scene.toml")]) == 0
    assert not folder.exists()


def test_no_link_is_followed(base, tmp_path):
    """A folder, or a lock, that is a link to somewhere else is let be."""
    precious = tmp_path / "precious"
    precious.mkdir()
    (precious / ".lock").write_text("")
    (base / "exu_press_temporary_a").symlink_to(precious)
    (base / "exu_press_temporary_b").mkdir()
    (base / "exu_press_temporary_b" / ".lock").symlink_to(precious / ".lock")
    with TemporaryFolder():
        pass
    assert (precious / ".lock").exists()
    assert (base / "exu_press_temporary_b").exists()


def test_a_half_written_file_goes_at_the_next_write_and_one_in_writing_stays(base):
    code = (
        "import sys; from pathlib import Path; from fe_models.temporary import replacing\n"
        f"with replacing(Path({str(base / 'part.npz')!r})) as stream:\n"
        "    stream.write(b'half'); stream.flush(); print('written', flush=True); sys.stdin.read()"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    process.stdout.readline()
    remove_abandoned(base)
    (partial,) = base.glob("*/part.npz")  # its process lives
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert partial.read_bytes() == b"half"
    remove_abandoned(base)
    assert not list(base.iterdir())


def test_a_file_replaces_another_one_whole_or_not_at_all(base):
    (base / "a").write_bytes(b"old")
    with pytest.raises(ZeroDivisionError), replacing(base / "a") as stream:
        stream.write(b"half")
        raise ZeroDivisionError
    assert (base / "a").read_bytes() == b"old"
    with replacing(base / "a") as stream:
        stream.write(b"new")
    assert [(file.name, file.read_bytes()) for file in base.iterdir()] == [("a", b"new")]
