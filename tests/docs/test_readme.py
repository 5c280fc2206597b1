"""Every command and every code block of the README runs."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
BIN = Path(sys.executable).parent


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


def commands():
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    parts = [part.strip() for line in lines for part in line.split("&&")]
    return [part for part in parts if re.search(r"exu-press ", part)]


def test_both_setup_commands_stand_in_the_readme():
    lines = [line for block in blocks("sh") for line in block.splitlines()]
    starts = [line for line in lines if line.startswith("python3 -m venv .venv && ")]
    assert any("exu-press compare press" in line for line in starts)
    assert any(line.endswith("pytest") for line in starts)


@pytest.mark.parametrize("command", commands())
def test_command(command, tmp_path):
    words = shlex.split(command)
    words[0] = str(BIN / Path(words[0]).name)
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    out = tmp_path / words[words.index("--out") + 1]
    assert list(out.rglob("run.nc")) and list(out.rglob("*.png"))


@pytest.mark.parametrize("number", range(len(blocks("python"))))
def test_python_block(number, tmp_path):
    block = blocks("python")[number]
    done = subprocess.run(
        [sys.executable, "-c", block], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout


@pytest.mark.parametrize("number", range(len(blocks("toml"))))
def test_scene_block(number, tmp_path):
    from exu_press import load_scene

    path = tmp_path / "scene.toml"
    path.write_text(blocks("toml")[number], encoding="utf-8")
    assert load_scene(path).film is not None


@pytest.mark.long
@pytest.mark.parametrize("line", [b for b in blocks("sh") if b.startswith("python3 -m venv")])
def test_setup_command_on_a_bare_machine(line, tmp_path):
    clone = tmp_path / "clone"
    subprocess.run(["git", "clone", "--quiet", str(ROOT), str(clone)], check=True)
    done = subprocess.run(line, shell=True, cwd=clone, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
