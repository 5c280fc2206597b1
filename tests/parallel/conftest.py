import pytest


@pytest.fixture(autouse=True)
def workers(processes):
    """What is tested here are processes."""
