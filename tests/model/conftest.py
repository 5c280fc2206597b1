"""STEP files that these tests write are sound: no further process reads them first."""

import pytest


@pytest.fixture(scope="module")
def sound_files():
    """Leave out the check of tests/parts/test_step_check.py, which costs as much as a short run."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fe_models.shapes.check_step", lambda _path: None)
        yield
