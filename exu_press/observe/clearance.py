"""What happened in a clearance joint."""

from typing import Any

import numpy as np

from exu_press.arrays import Array
from exu_press.result import JointRecord

__all__ = ["TOUCH", "joint_summary"]

TOUCH = 1e-10
"""Penetration from which surfaces count as touching, m; the force begins at zero."""


def joint_summary(time: Array, joint: JointRecord, *, onset: float | None) -> dict[str, Any]:
    """Return what a joint is, its eccentricity, force, film and contact.

    Args:
        time: (n,), s.
        joint: what it did.
        onset: gap at which its surfaces begin to touch, m; None where they may not.

    Returns:
        The entries of summary.json; null for what the joint does not have. The smallest film is 0
        where surfaces touch, `impacts` counts the touches, the shares are shares of time. An ideal
        joint has kind, clearance and force alone.
    """
    peak_force = float(np.linalg.norm(joint.force, axis=1).max())
    if joint.kind == "ideal":
        return {"kind": joint.kind, "clearance": 0.0, "peak_force": peak_force}
    film = joint.kind == "lubricated"
    entries: dict[str, Any] = {
        "kind": joint.kind,
        "clearance": joint.clearance,
        "max_eccentricity_ratio": float(joint.distance.max() / joint.clearance),
        "peak_force": peak_force,
        "peak_penetration": None,
        "min_film": max(0.0, float(joint.gap.min())) if film else None,
        "impacts": None,
        "share_free_flight": None,
        "share_contact": None,
    }
    if onset is not None:
        penetration = -joint.gap
        touching = penetration + onset > TOUCH
        share = _share_touching(time, penetration + onset - TOUCH)
        entries |= {
            "peak_penetration": float(max(0.0, penetration.max())),
            "impacts": int(np.count_nonzero(touching[1:] & ~touching[:-1])) + int(touching[0]),
            "share_free_flight": 1.0 - share,
            "share_contact": share,
        }
    return entries


def _share_touching(time: Array, depth: Array) -> float:
    """Return the share of time in which a depth (n,), linear between instants, is above zero."""
    span = np.diff(time)
    if not len(span):
        return 0.0
    one, other = np.maximum(depth[:-1], 0.0), np.maximum(depth[1:], 0.0)
    apart = np.maximum(-depth[:-1], 0.0) + np.maximum(-depth[1:], 0.0)
    above = one + other
    part = np.divide(above, above + apart, out=np.zeros_like(span), where=above > 0.0)
    return float(span @ part / span.sum())
