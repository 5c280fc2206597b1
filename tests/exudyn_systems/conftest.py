"""Copies of the process are safe in tests: execnet's second thread keeps no lock."""

import pytest


@pytest.fixture(autouse=True)
def copies(monkeypatch):
    monkeypatch.setattr("exu_press.exudyn_systems.level.may_copy", lambda: True)
