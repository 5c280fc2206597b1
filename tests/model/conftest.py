"""STEP files that these tests write are sound: they are read in the process of the tests."""

import pytest

from fe_models.cache import reduce_here


@pytest.fixture(scope="module")
def sound_files():
    """Start no children: each costs as much as a short run."""

    def here(_, _function, *arguments, report=None):
        return reduce_here(*arguments, report)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fe_models.geometry.StepFile.in_child", here)
        yield
