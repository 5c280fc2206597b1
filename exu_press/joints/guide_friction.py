"""Friction of a guide without clearance: its side force times the coefficient, along the guide.

The side force is that of the constraint which holds the body across an ideal guide, or of the
spring of an elastic one. Exudyn's multipliers are iterates of Newton's method like all else, so
that the friction of a step goes with the side force at its end. Exudyn asks an item for no
derivatives by multipliers: without them each iteration leaves mu times the slope with which the
body's force turns aside, some hundredths of the error, but more than all of it where a film holds
the crank. So the integration adds them (`multiplier_partials`).

Friction acts in the line of the point that is guided, and has no moment about it. Accelerations at
the start are those without it, as the multipliers are not known yet: the first step mends that.
"""

from collections.abc import Sequence
from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import ObjectGenericODE2, VObjectGenericODE2

from exu_press.laws.friction import Friction, LuGre
from exu_press.numerics.arrays import Array

__all__ = [
    "GuideFriction",
    "HeldSide",
    "SideForce",
    "SlidingFriction",
    "SpringSide",
    "guide_frictions",
]

REGISTRY = "exu_press_guide_frictions"


def guide_frictions(mbs: exu.MainSystem) -> list["GuideFriction"]:
    """Return the frictions of a system that go with multipliers, kept with its own variables."""
    registered: list[GuideFriction] = mbs.variables.setdefault(REGISTRY, [])
    return registered


class HeldSide:
    """Normal force of a constraint that holds the body across an ideal guide."""

    partials: tuple[Array, Array] | None = None
    """By the coordinates of the body's nodes and by their rates, (n,); None: as if it were even."""

    def __init__(self, mbs: exu.MainSystem, constraint: int) -> None:
        """Take the object number of a constraint with one row of length 1."""
        self._data: Any = mbs.systemData
        self._constraint = constraint
        self._index: int | None = None

    @property
    def index(self) -> int:
        """Its place among the multipliers, which is known when the system is assembled."""
        if self._index is None:
            self._index = int(self._data.GetObjectLTGAE(self._constraint)[0])
        return self._index

    def force(self, q: Array, q_t: Array) -> float:
        """Return the multiplier, N."""
        current = exu.ConfigurationType.Current
        return float(self._data.GetAECoordinates(current, False)[self.index])


class SpringSide:
    """Normal force of a spring and damper across an elastic guide."""

    def __init__(self, stiffness: float, damping: float, across: Array, missed: float) -> None:
        """Take a spring.

        Args:
            stiffness: N/m.
            damping: N s/m.
            across: (n,), displacement of the body across its guide by each coordinate.
            missed: displacement across the guide where the coordinates are zero, m.
        """
        self._stiffness, self._damping = stiffness, damping
        self._across, self._missed = across, missed

    def force(self, q: Array, q_t: Array) -> float:
        """Return the force of the spring, N."""
        moved = float(self._across @ q) + self._missed
        return self._stiffness * moved + self._damping * float(self._across @ q_t)

    @property
    def partials(self) -> tuple[Array, Array] | None:
        """Its derivatives by the coordinates and by their rates."""
        return self._stiffness * self._across, self._damping * self._across


SideForce = HeldSide | SpringSide


class SlidingFriction:
    """A friction law from step to step; a bristle is kept with it."""

    def __init__(self, law: Friction | LuGre) -> None:
        """Start at rest."""
        self.law = law
        self._bristle = self._next_bristle = 0.0
        self._speed: float | None = None
        self._next_speed: float | None = None
        self._step = 0.0

    def begin_step(self, step: float, accepted: bool) -> None:
        """Start a step of a size, s, after the last one was accepted or is repeated."""
        if accepted:
            self._bristle, self._speed = self._next_bristle, self._next_speed
        self._step = step

    def __call__(self, speed: float) -> tuple[float, float]:
        """Return the coefficient, signed like the speed, m/s, and its derivative, s/m."""
        if not isinstance(self.law, LuGre):
            return self.law(speed)
        mu, slope, bristle = self.law.advance(speed, self._bristle, self._step, self._speed)
        self._next_bristle, self._next_speed = bristle, speed
        return mu, slope

    def coefficients(self, time: Array, speed: Array) -> Array:
        """Return the coefficients over recorded steps from rest, (n,).

        Args:
            time: (n,), s.
            speed: (n,), m/s.
        """
        replayed, coefficients = SlidingFriction(self.law), np.zeros_like(time)
        previous = time[0]
        for i, (now, v) in enumerate(zip(time.tolist(), speed.tolist(), strict=True)):
            replayed.begin_step(now - previous, accepted=True)
            coefficients[i], previous = replayed(v)[0], now
        return coefficients


class GuideFriction:
    """One massless item over the nodes of a guided body."""

    def __init__(
        self,
        mbs: exu.MainSystem,
        nodes: Sequence[int],
        along: Array,
        side: SideForce,
        law: Friction | LuGre,
    ) -> None:
        """Add the friction of a guide to a system.

        Args:
            mbs: not yet assembled.
            nodes: of the body.
            along: (n,), displacement of the body along its guide by each coordinate.
            side: the force across it.
            law: friction coefficient of a sliding velocity.
        """
        self.friction = SlidingFriction(law)
        self._along, self._side = along, side
        self._mbs, self._nodes = mbs, list(nodes)
        self._rows: Array | None = None  # of the body's coordinates among the system's
        self._data: Any = mbs.systemData
        if isinstance(side, HeldSide):
            guide_frictions(mbs).append(self)
        self._step: tuple[float, float] | None = None
        forces: Any = self._forces
        jacobian: Any = self._jacobian
        item = ObjectGenericODE2(
            nodeNumbers=list(nodes),
            forceUserFunction=forces,
            jacobianUserFunction=jacobian,
            visualization=VObjectGenericODE2(show=False),
        )
        mbs.AddObject(item)

    def _forces(self, mbs: exu.MainSystem, time: float, item: int, q: Any, q_t: Any) -> Array:
        self._begin_step(time)
        q, q_t = np.asarray(q), np.asarray(q_t)
        mu, _ = self.friction(float(self._along @ q_t))
        return -mu * abs(self._side.force(q, q_t)) * self._along

    def _jacobian(
        self,
        mbs: exu.MainSystem,
        time: float,
        item: int,
        q: Any,
        q_t: Any,
        by_q: float,
        by_q_t: float,
    ) -> exu.MatrixContainer:
        self._begin_step(time)
        q, q_t = np.asarray(q), np.asarray(q_t)
        mu, slope = self.friction(float(self._along @ q_t))
        side = self._side.force(q, q_t)
        row = by_q_t * slope * abs(side) * self._along
        if self._side.partials is not None:
            by_places, by_rates = self._side.partials
            row = row + mu * np.sign(side) * (by_q * by_places + by_q_t * by_rates)
        matrix = exu.MatrixContainer()  # a container would add to what it was given before
        matrix.SetWithDenseMatrix(np.outer(self._along, row))
        return matrix

    def multiplier_partials(self) -> tuple[Array, int, Array]:
        """Return the change of minus the force with the multiplier of its side force.

        Returns:
            Rows of the system's coordinates, the place among the multipliers, and the derivatives.
        """
        assert isinstance(self._side, HeldSide)
        if self._rows is None:
            sizes = [
                len(self._mbs.GetNodeParameter(n, "referenceCoordinates")) for n in self._nodes
            ]
            starts = [self._mbs.GetNodeODE2Index(node) for node in self._nodes]
            pairs = zip(starts, sizes, strict=True)
            self._rows = np.concatenate([start + np.arange(size) for start, size in pairs])
        rates = np.asarray(self._data.GetODE2Coordinates_t(exu.ConfigurationType.Current, False))
        mu, _ = self.friction(float(self._along @ rates[self._rows]))
        side = self._side.force(rates, rates)
        return self._rows, self._side.index, mu * np.sign(side) * self._along

    def _begin_step(self, time: float) -> None:
        """Tell the friction about the step that is being tried."""
        if self._step is not None and self._step[1] == time:
            return
        start = self._data.GetTime(exu.ConfigurationType.StartOfStep)
        accepted = self._step is None or start != self._step[0] or start == self._step[1]
        self._step = start, time
        self.friction.begin_step(time - start, accepted)
