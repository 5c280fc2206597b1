"""STEP files that these tests write are sound: they are read in the process of the tests."""

import pytest

from fe_models.lazy import named_object


@pytest.fixture(scope="module")
def sound_files():
    """Start no children: each costs as much as a short run."""

    def here(_, function, *arguments, report=None):
        reports = [] if report is None else [report]
        return named_object(function)(*arguments, *reports)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fe_models.geometry.StepFile.in_child", here)
        yield
