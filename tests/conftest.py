"""What tests of more than one folder need."""

import pytest
from browser import launched


@pytest.fixture(scope="session")
def browser():
    """A real browser; a test that asks for it is skipped where there is none."""
    yield from launched()
