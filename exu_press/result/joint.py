"""One joint over a run."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array, lengths
from exu_press.result.channel import Channel

__all__ = ["JointRecord"]


@dataclass(frozen=True)
class JointRecord:
    """One joint over time; an ideal one has its force, and zeros elsewhere.

    Attributes:
        name: of the joint.
        kind: "ideal", "dry" or "lubricated".
        clearance: radial clearance, m; of worn surfaces its mean.
        channels: of the run.
    """

    name: str
    kind: str
    clearance: float
    channels: Mapping[str, Channel]

    @property
    def spherical(self) -> bool:
        """Return whether it is a ball in a socket."""
        return self.channels[f"{self.name}_force"].axis == "space"

    @property
    def force(self) -> Array:
        """On the journal or ball, (n, 2) in the plane, (n, 3) of a spherical joint, N."""
        return self.channels[f"{self.name}_force"].values

    @property
    def eccentricity(self) -> Array:
        """Journal centre minus bearing centre, (n, 2) or (n, 3), m."""
        force = self.force
        return np.zeros_like(force) if self.kind == "ideal" else self._of_clearance("eccentricity")

    @property
    def gap(self) -> Array:
        """The film's least thickness, or -penetration, (n,), m."""
        own = self.channels.get(f"{self.name}_gap")
        return self.clearance - self.distance if own is None else own.values

    @property
    def moment(self) -> Array:
        """On journal and bearing about their centres, (n, 2), N m."""
        if self.kind == "ideal":
            return np.zeros((len(self.force), 2))
        return self._of_clearance("moment")

    @property
    def dissipated_power(self) -> Array:
        """Heat of contact, friction and film, (n,), W."""
        return np.zeros(len(self.force)) if self.kind == "ideal" else self._of_clearance("power")

    @property
    def distance(self) -> Array:
        """Magnitude of the eccentricity, (n,), m."""
        return lengths(self.eccentricity)

    def _of_clearance(self, what: str) -> Array:
        """Return a channel that joints with clearance have."""
        return self.channels[f"{self.name}_{what}"].values
