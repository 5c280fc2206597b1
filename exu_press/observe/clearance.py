"""What happened in a clearance joint."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["TOUCH", "joint_summary"]

Array = NDArray[np.float64]

TOUCH = 1e-10
"""Penetration from which surfaces count as touching, m; the force begins at zero."""


def joint_summary(
    time: Array,
    eccentricity: Array,
    force: Array,
    clearance: float,
    *,
    film: bool,
    contact: bool,
    onset: float = 0.0,
) -> dict[str, Any]:
    """Return eccentricity, force, film and contact of one joint.

    Args:
        time: (n,), s.
        eccentricity: (n, 2) or (n, 3), m.
        force: same shape, N.
        clearance: radial clearance, m.
        film: whether there is a film; its smallest thickness is given then, 0 where surfaces touch.
        contact: whether the surfaces may touch; penetration and shares are given then.
        onset: gap at which the surfaces' asperities begin to touch, m.

    Returns:
        The entries of summary.json; null for what the joint does not have. `impacts` counts the
        touches, the shares are shares of time.
    """
    distance = np.linalg.norm(eccentricity, axis=1)
    penetration = distance - clearance
    touching = penetration + onset > TOUCH
    entries: dict[str, Any] = {
        "max_eccentricity_ratio": float(distance.max() / clearance),
        "peak_force": float(np.linalg.norm(force, axis=1).max()),
        "peak_penetration": None,
        "min_film": max(0.0, float(-penetration.max())) if film else None,
        "impacts": None,
        "share_free_flight": None,
        "share_contact": None,
    }
    if contact:
        span = np.diff(time)
        share = float(span @ (touching[1:] & touching[:-1]) / span.sum()) if len(span) else 0.0
        entries |= {
            "peak_penetration": float(max(0.0, penetration.max())),
            "impacts": int(np.count_nonzero(touching[1:] & ~touching[:-1])) + int(touching[0]),
            "share_free_flight": 1.0 - share,
            "share_contact": share,
        }
    return entries
