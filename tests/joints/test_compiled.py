"""Compiled or in Python, and which: the tests beside this one hold for both."""

import importlib.machinery
import runpy
import sys
from pathlib import Path

import pytest

import exu_press
from exu_press.joints import COMPILED

ROOT = Path(__file__).parents[2]


def test_all_modules_are_compiled_or_none():
    package = Path(exu_press.__file__).parent
    suffixes = tuple(importlib.machinery.EXTENSION_SUFFIXES)
    compiled = [path for path in package.rglob("*") if path.name.endswith(suffixes)]
    assert len(compiled) == (len(executed("setup")["MODULES"]) if COMPILED else 0)


def test_when_to_compile(monkeypatch):
    is_compiled = executed("build_backend")["is_compiled"]
    for asked, editable, expected in (("1", True, True), ("0", False, False), ("", True, False)):
        monkeypatch.setenv("EXU_PRESS_COMPILE", asked)
        assert is_compiled(editable) is expected
    monkeypatch.setenv("EXU_PRESS_COMPILE", "yes")
    with pytest.raises(SystemExit, match="EXU_PRESS_COMPILE = 'yes': allowed are 0 and 1"):
        is_compiled(editable=False)


def executed(name):
    """Run setup.py, without building anything, or its backend, and return what it defines."""
    if not (ROOT / "setup.py").exists():
        pytest.skip("not run from the sources")
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("EXU_PRESS_COMPILE", raising=False)
        patch.setattr("setuptools.setup", lambda **options: None)
        patch.setattr(sys, "argv", ["setup.py", "egg_info"])
        patch.syspath_prepend(ROOT)
        return runpy.run_path(str(ROOT / f"{name}.py"))
