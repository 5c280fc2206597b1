"""Derivatives of laws by central differences."""

import numpy as np


def slopes(function, state, widths):
    """Return how a function's values change with each argument: (arguments, values)."""
    rows = []
    for i, width in enumerate(widths):
        high, low = (
            np.array(function(*(v + sign * width * (i == k) for k, v in enumerate(state))))
            for sign in (1.0, -1.0)
        )
        rows.append((high - low) / (2.0 * width))
    return np.array(rows)
