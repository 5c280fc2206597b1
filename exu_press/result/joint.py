"""What one joint did during a run."""

from dataclasses import dataclass

import numpy as np

from exu_press.arrays import Array

__all__ = ["JointRecord"]


@dataclass(frozen=True)
class JointRecord:
    """One joint over time; an ideal one has its force, and zeros for what only clearance allows.

    Attributes:
        kind: "ideal", "dry" or "lubricated".
        spherical: whether it is a ball in a socket.
        clearance: radial clearance, m.
        force: on the journal or ball, (n, 2) in the plane, (n, 3) of a spherical joint, N.
        eccentricity: journal centre minus bearing centre, same shape, m.
        gap: clearance less eccentricity, (n,), m: the film's least thickness, or minus the
            penetration.
        moment: on journal and bearing about their centres, (n, 2), N m.
        dissipated_power: what contact, friction and film turn into heat, (n,), W.
    """

    kind: str
    spherical: bool
    clearance: float
    force: Array
    eccentricity: Array
    gap: Array
    moment: Array
    dissipated_power: Array

    @property
    def distance(self) -> Array:
        """Magnitude of the eccentricity, (n,), m."""
        return np.asarray(np.linalg.norm(self.eccentricity, axis=1))
