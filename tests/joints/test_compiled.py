"""Compiled or in Python, and which: the tests beside this one hold for both."""

import importlib.machinery
import runpy
import sys
from pathlib import Path

import pytest

import exu_press
from exu_press.joints import COMPILED
from exu_press.joints.interface import FilmInterface
from exu_press.laws.film import pinkus

ROOT = Path(__file__).parents[2]


def test_it_knows_whether_it_is_compiled():
    """A compiled class keeps what it is given as its type; one in Python takes anything."""
    interface = FilmInterface(pinkus(), 1.0, 1e-4)
    if COMPILED:
        with pytest.raises(TypeError):
            interface.scale = "thick"
    else:
        interface.scale = "thick"
        assert interface.scale == "thick"


def test_all_modules_are_compiled_or_none():
    package = Path(exu_press.__file__).parent
    suffixes = tuple(importlib.machinery.EXTENSION_SUFFIXES)
    compiled = [path for path in package.rglob("*") if path.name.endswith(suffixes)]
    assert len(compiled) == (len(setup_script("")["MODULES"]) if COMPILED else 0)


def test_when_to_compile(monkeypatch):
    for asked, command, expected in (
        ("1", "editable_wheel", True),
        ("0", "bdist_wheel", False),
        ("", "editable_wheel", False),
    ):
        script = setup_script(asked)
        monkeypatch.setattr(sys, "argv", ["setup.py", command])
        assert script["wanted"]() is expected
    with pytest.raises(SystemExit, match="EXU_PRESS_COMPILE = 'yes': allowed are 0 and 1"):
        setup_script("yes")


def setup_script(asked):
    """Run setup.py without building anything, and return what it defines."""
    if not (ROOT / "setup.py").exists():
        pytest.skip("not run from the sources")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("EXU_PRESS_COMPILE", asked)
        patch.setattr("setuptools.setup", lambda **options: None)
        patch.setattr(sys, "argv", ["setup.py", "egg_info"])
        return runpy.run_path(str(ROOT / "setup.py"))
