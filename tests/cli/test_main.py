"""How any command ends: Ctrl-C, a closed pipe, its version; and what --help shows of each."""

import importlib.metadata
import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import exu_press
from exu_press.cli import main
from exu_press.cli.main import COMMANDS, load_command

COMMAND = str(Path(sys.executable).with_name("exu-press"))


def test_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    version = importlib.metadata.version("exu-press")
    assert capsys.readouterr().out == f"exu-press {version}\n"
    assert exu_press.__version__ == version


def test_a_closed_pipe_is_quiet(tmp_path):
    arguments = ["run", "slider_crank", "--set", "revolutions=0.02", "--no-pictures", "--no-error"]
    read, write = os.pipe()
    os.close(read)
    process = subprocess.run(
        [COMMAND, *arguments, "--out", str(tmp_path)],
        stdout=write,
        stderr=subprocess.PIPE,
        text=True,
        timeout=60,
    )
    os.close(write)
    assert process.stderr == ""
    assert process.returncode == 141
    assert (tmp_path / "run.nc").exists()


@pytest.mark.parametrize("closed", [">&-", "<&- >&- 2>&-"])
def test_closed_streams_are_no_error(tmp_path, closed):
    """What is opened later does not take their numbers, nor what is printed."""
    arguments = "run slider_crank --set revolutions=0.01 --no-pictures --out ."
    script = f"{COMMAND} {arguments} {closed}"
    done = subprocess.run(["bash", "-c", script], cwd=tmp_path, capture_output=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, b"")
    assert exu_press.Result.load(tmp_path / "run.nc").completed


def test_a_full_disk_under_the_output_is_said(tmp_path):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run([COMMAND, "doctor"], stdout=full, stderr=subprocess.PIPE, timeout=60)
    assert done.returncode == 3
    assert (
        done.stderr == b"exu-press: standard output: cannot be written (No space left on device)\n"
    )


def test_ctrl_c_while_the_commands_are_loaded():
    code = """
import os, signal, sys, exu_press.cli
module = sys.modules["exu_press.cli.main"]
module.import_module = lambda name: os.kill(os.getpid(), signal.SIGINT)
sys.exit(module.main(["run", "press"]))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.stderr, done.returncode) == ("", -signal.SIGINT)


def test_ctrl_c_before_the_command_line_is_loaded():
    code = """
import builtins, os, signal
from exu_press.__main__ import main
usual = builtins.__import__
def interrupted(name, *rest):
    if name == "exu_press.cli":
        os.kill(os.getpid(), signal.SIGINT)
    return usual(name, *rest)
builtins.__import__ = interrupted
main()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (done.stderr, done.returncode) == ("", -signal.SIGINT)


LONG = "x" * 5000


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run", LONG], "File name too long"),
        (["draw", LONG], "File name too long"),
        (["compare", LONG], "File name too long"),
        (["view", LONG], "File name too long"),
        (["report", LONG], "File name too long"),
        (["spectrum", "a\0b"], "without a zero character"),
        (["run", "press", "--out", "a\0b"], "without a zero character"),
        (["new", "a.toml", "--mechanism", ""], "mechanism = '': allowed"),
    ],
)
def test_paths_that_no_system_takes(arguments, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    told = capsys.readouterr().err
    assert told.startswith("exu-press: ") and told.count("\n") == 1 and said in told
    assert len(told) < 1000 and not list(tmp_path.iterdir())


def printed_help(capsys, *words):
    with pytest.raises(SystemExit) as ended:
        main([*words, "--help"])
    assert ended.value.code == 0
    return " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize("name", COMMANDS)
def test_example(name, capsys, monkeypatch):
    command = load_command(name)
    example = shlex.split(command.EXAMPLE)
    assert example[:2] == ["exu-press", name]
    assert f"example: {command.EXAMPLE}" in printed_help(capsys, name)
    asked = []
    idle = SimpleNamespace(
        EXAMPLE=command.EXAMPLE,
        add_arguments=command.add_arguments,
        execute=lambda options: asked.append(options) or 0,
    )
    monkeypatch.setattr(sys.modules[main.__module__], "load_command", lambda _: idle)
    assert main(example[1:]) == 0
    assert len(asked) == 1
