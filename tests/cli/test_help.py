"""--help of every command shows an example that the command's own parser takes."""

import shlex
import sys
from types import SimpleNamespace

import pytest

from exu_press.cli.main import COMMANDS, load_command, main


def printed_help(capsys, *words):
    with pytest.raises(SystemExit) as ended:
        main([*words, "--help"])
    assert ended.value.code == 0
    return " ".join(capsys.readouterr().out.split())


def test_help_names_every_command(capsys):
    text = printed_help(capsys)
    assert "example: exu-press" in text
    for name, verb in zip(("run", "sweep", "fit"), ("Run one", "Run many", "Find"), strict=True):
        assert f"{name} {verb}" in text


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
