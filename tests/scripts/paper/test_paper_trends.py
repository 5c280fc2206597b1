"""What series do, in the paper's words."""

import pytest

from paper.trends import follows


@pytest.mark.parametrize(
    ("stated", "values", "holds"),
    [
        ("rises", [1.0, 1.2, 1.5], True),
        ("rises", [1.0, 1.01, 1.015], False),  # less than the least change
        ("rises", [1.0, 1.6, 1.3], False),  # falls in between
        ("rises", [1.0, 0.99, 1.3], True),  # by less than the least change
        ("falls", [3.0, 2.0], True),
        ("falls", [2.0, 3.0], False),
        ("rises, then falls", [1.0, 2.0, 3.0, 2.5], True),
        ("rises, then falls", [1.0, 2.0, 3.0, 3.0], False),
        ("falls, then rises", [3.0, 2.0, 2.0, 3.0], True),
        ("falls, then rises", [3.0, 2.0, 1.0, 0.5], False),
        ("negligible", [0.02, 0.0], True),
        ("negligible", [0.02, 0.5], False),
    ],
)
def test_trends(stated, values, holds):
    assert follows(stated, values) is holds
