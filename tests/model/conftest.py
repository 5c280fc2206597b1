"""STEP files and matrices that these tests write are sound: the process of the tests reads them."""

import pytest

from fe_models.lazy import named_object


@pytest.fixture(scope="module")
def sound_files():
    """Start no children: each costs as much as a short run."""

    def here(_, function, *arguments, report=None):
        reports = [] if report is None else [report]
        return named_object(function)(*arguments, *reports)

    with pytest.MonkeyPatch.context() as patch:
        for reader in ("geometry.StepFile", "matrices.MatrixPart"):
            patch.setattr(f"fe_models.{reader}.in_child", here)
        yield
