"""Number and duration of contacts."""

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["TOUCH", "contacts", "share_of_contact"]

TOUCH = 1e-10
"""Penetration from which surfaces count as touching, m; the force begins at zero."""


def contacts(depth: Array) -> int:
    """Return how often surfaces begin to touch.

    Args:
        depth: (n,), m, of the penetration beyond the contact onset.
    """
    touching = depth > TOUCH
    return int(np.count_nonzero(touching[1:] & ~touching[:-1])) + int(touching[0])


def share_of_contact(time: Array, depth: Array) -> float:
    """Return the share of time in which surfaces touch.

    Args:
        time: (n,), s.
        depth: (n,), m, of the penetration beyond the contact onset, linear between instants.
    """
    depth, span = depth - TOUCH, np.diff(time)
    if not len(span):
        return 0.0
    one, other = np.maximum(depth[:-1], 0.0), np.maximum(depth[1:], 0.0)
    apart = np.maximum(-depth[:-1], 0.0) + np.maximum(-depth[1:], 0.0)
    above = one + other
    part = np.divide(above, above + apart, out=np.zeros_like(span), where=above > 0.0)
    return float(span @ part / span.sum())
