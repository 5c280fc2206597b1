"""Copies of the process are safe in tests: execnet's second thread keeps no lock."""

import sys

import pytest


@pytest.fixture(autouse=True)
def copies(monkeypatch):
    if sys.platform != "linux":
        pytest.skip("only Linux copies a process")
    monkeypatch.setattr("exu_press.exudyn_systems.level.why_not_copied", str)
