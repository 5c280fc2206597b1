"""STEP files that these tests write are sound: they are read in the process of the tests."""

from importlib import import_module

import pytest


@pytest.fixture(scope="module")
def sound_files():
    """Start no children: each costs as much as a short run."""

    def here(_, function, *arguments, report=None):
        module, _, name = function.partition(":")
        reports = [] if report is None else [report]
        return getattr(import_module(module), name)(*arguments, *reports)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fe_models.geometry.StepFile.in_child", here)
        yield
