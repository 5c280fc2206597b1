"""The scripts that print the tables of README and docs run, reduced, and end in numbers."""

import pytest
from running import run


@pytest.mark.parametrize(
    ("script", "options", "expected"),
    [
        ("contact_restitution.py", [], "(default)"),
        ("benchmark_modes.py", [], "ratio"),
        ("flexible_convergence.py", ["--out", "convergence"], "error 0.01"),
        ("flexible_parts.py", ["--out", "parts"], "flexible, second shapes"),
    ],
)
def test_script(script, options, expected, tmp_path):
    assert expected in run(script, tmp_path, *options)
