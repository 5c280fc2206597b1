"""--help of every command shows an example that the command's own parser takes."""

import shlex
from importlib import import_module

import pytest

from exu_press.cli.main import COMMANDS, main


def printed_help(capsys, *words):
    with pytest.raises(SystemExit) as ended:
        main([*words, "--help"])
    assert ended.value.code == 0
    return " ".join(capsys.readouterr().out.split())


def test_help_names_every_command(capsys):
    text = printed_help(capsys)
    assert "example: exu-press" in text
    for name in COMMANDS:
        module = import_module(f"exu_press.cli.{name}")
        assert f"{name} {module.__doc__.splitlines()[0].split()[0]}" in text


@pytest.mark.parametrize("name", COMMANDS)
def test_example(name, capsys, monkeypatch):
    module = import_module(f"exu_press.cli.{name}")
    example = shlex.split(module.EXAMPLE)
    assert example[:2] == ["exu-press", name]
    assert f"example: {module.EXAMPLE}" in printed_help(capsys, name)
    asked = []
    monkeypatch.setattr(module, "execute", lambda options: asked.append(options) or 0)
    assert main(example[1:]) == 0
    assert len(asked) == 1
