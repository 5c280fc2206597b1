"""Friction of a guide without clearance: its side force times the coefficient, along the guide.

The side force is that of the constraint which holds the body across an ideal guide, or of the
spring of an elastic one. Exudyn's multipliers are iterates of Newton's method like all else, so
that the friction of a step goes with the side force at its end. Exudyn asks an item for no
derivatives by multipliers: without them each iteration leaves mu times the slope with which the
body's force turns aside, some hundredths of the error, but more than all of it where a film holds
the crank. So the integration adds them (`multiplier_partials`).

Friction acts in the line of the point that is guided, and has no moment about it; on a moving guide
its opposite acts there. Accelerations at
the start are those without it, as the multipliers are not known yet: the first step mends that.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np

from exu_press.joints.user_force import StepWatch, add_massless_item
from exu_press.laws.friction import Friction, LuGre
from exu_press.numerics.arrays import Array

if TYPE_CHECKING:
    from exu_press.joints.guide_line import GuideLine

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

    def partials(self, q: Array, q_t: Array) -> tuple[Array, Array] | None:
        """Return None: its derivatives are those of `multiplier_partials`."""
        return None


class SpringSide:
    """Normal force of a spring and damper across an elastic guide."""

    def __init__(self, stiffness: float, damping: float, line: "GuideLine") -> None:
        """Take stiffness, N/m, and damping, N s/m, of a spring across the line of a guide."""
        self._stiffness, self._damping, self._line = stiffness, damping, line

    def force(self, q: Array, q_t: Array) -> float:
        """Return the force of the spring, N."""
        rate = float(self._line.normal_row(q) @ q_t)
        return self._stiffness * self._line.lateral_displacement(q) + self._damping * rate

    def partials(self, q: Array, q_t: Array) -> tuple[Array, Array]:
        """Return its derivatives by the coordinates and by their rates, (n,)."""
        across, turning = self._line.normal_row(q), self._line.turning(self._line.direction_row(q))
        return self._stiffness * across + self._damping * turning @ q_t, self._damping * across


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
    """One massless item over the nodes of a guided body, and of the one on which it slides."""

    def __init__(
        self,
        mbs: exu.MainSystem,
        nodes: Sequence[int],
        line: "GuideLine",
        side: SideForce,
        law: Friction | LuGre,
    ) -> None:
        """Add the friction of a guide to a system.

        Args:
            mbs: not yet assembled.
            nodes: of the body, and of the one on which it slides unless that is the frame.
            line: of the guide, by the coordinates of these nodes.
            side: the force across it.
            law: friction coefficient of a sliding velocity.
        """
        self.friction = SlidingFriction(law)
        self._line, self._side = line, side
        self._mbs, self._nodes = mbs, list(nodes)
        self._rows: Array | None = None  # of the body's coordinates among the system's
        self._data: Any = mbs.systemData
        if isinstance(side, HeldSide):
            guide_frictions(mbs).append(self)
        self._steps = StepWatch(mbs)
        add_massless_item(mbs, nodes, self._forces, self._jacobian)

    def _forces(self, mbs: exu.MainSystem, time: float, item: int, q: Any, q_t: Any) -> Array:
        q, q_t = self._state(time, q, q_t)
        along = self._line.direction_row(q)
        mu, _ = self.friction(float(along @ q_t))
        return -mu * abs(self._side.force(q, q_t)) * along

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
        q, q_t = self._state(time, q, q_t)
        along, turning = self._line.direction_row(q), self._line.turning(-self._line.normal_row(q))
        mu, slope = self.friction(float(along @ q_t))
        side = self._side.force(q, q_t)
        row = slope * abs(side) * (by_q_t * along + by_q * turning @ q_t)
        partials = self._side.partials(q, q_t)
        if partials is not None:
            by_places, by_rates = partials
            row = row + mu * np.sign(side) * (by_q * by_places + by_q_t * by_rates)
        matrix = exu.MatrixContainer()  # a container would add to what it was given before
        matrix.SetWithDenseMatrix(np.outer(along, row) + by_q * mu * abs(side) * turning)
        return matrix

    def _state(self, time: float, q: Any, q_t: Any) -> tuple[Array, Array]:
        """Return a state as arrays; tell the friction about the step that is being tried."""
        if step := self._steps.new_step(time):
            self.friction.begin_step(*step)
        return np.asarray(q), np.asarray(q_t)

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
        current = exu.ConfigurationType.Current
        q = np.asarray(self._data.GetODE2Coordinates(current, False))[self._rows]
        rates = np.asarray(self._data.GetODE2Coordinates_t(current, False))[self._rows]
        along = self._line.direction_row(q)
        mu, _ = self.friction(float(along @ rates))
        side = self._side.force(q, rates)
        return self._rows, self._side.index, mu * np.sign(side) * along
