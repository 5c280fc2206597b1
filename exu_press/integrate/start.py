"""A start that fits the constraints: positions, velocities and accelerations.

Exudyn computes accelerations at the start, but for constraints that stand still: where an offset's
user function prescribes a motion, what it asks of velocities and accelerations is not in them. And
a drawing with five digits is off its joints by micrometres, of which a first step of microseconds
would make metres a second. What is missing is found along the motion that the start has: the
constraints are asked at a few instants ahead, whose differences are what they change by.

Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, VII.1 (consistent
values of systems of index 3).
"""

from typing import Any

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.constraints import Constraints

__all__ = ["fit_start", "start_rates"]

Array = NDArray[np.float64]

CURRENT = exu.ConfigurationType.Current
START = exu.ConfigurationType.StartOfStep

ITERATIONS = 4
"""Of Newton's method to positions that fit the constraints."""

FITS = 1e-9, 1e-6, 1e-6
"""What positions, velocities and accelerations may be off their constraints, relative, before they
are moved: differences are rounded."""


class _Start:
    """The state at the start, and what its constraints say of it and ahead of it."""

    def __init__(
        self, mbs: exu.MainSystem, solver: Any, constraints: Constraints, ahead: float
    ) -> None:
        self._data: Any = mbs.systemData
        self._constraints, self._ahead = constraints, ahead
        self._time = self._data.GetTime()
        self.q, self.v, self.a = (np.array(view) for view in self._views())
        self._mass = np.array(solver.GetSystemMassMatrix())
        self._matrix = constraints.matrix(self._mass, constraints.directions())
        self.held = ~constraints.of_velocities()

    def _views(self) -> tuple[Any, Any, Any]:
        data = self._data
        return (
            data.GetODE2Coordinates(CURRENT, False),
            data.GetODE2Coordinates_t(CURRENT, False),
            data.GetODE2Coordinates_tt(CURRENT, False),
        )

    def put(self, time: float = 0.0) -> None:
        """Set the state after a time (s), with the accelerations of the start."""
        q, v, a = self._views()
        q[:] = self.q + time * self.v + 0.5 * time * time * self.a
        v[:] = self.v + time * self.a
        a[:] = self.a
        self._data.SetTime(self._time + time)

    def violated(self, time: float = 0.0) -> Array:
        """Return by how much each constraint is violated after a time (s)."""
        self.put(time)
        return self._constraints.violated()

    def rates(self) -> tuple[Array, Array, Array]:
        """Return the first, second and third rate of change of the violations."""
        h = self._ahead
        now, one, two, three = (self.violated(i * h) for i in range(4))
        first = (-11.0 * now + 18.0 * one - 9.0 * two + 2.0 * three) / (6.0 * h)
        second = (2.0 * now - 5.0 * one + 4.0 * two - three) / (h * h)
        return first, second, (three - 3.0 * two + 3.0 * one - now) / (h * h * h)

    def mended(self, vector: Array, violated: Array, fits: float) -> Array:
        """Return the nearest vector, in the kinetic norm, without violations; itself if it fits."""
        right = np.concatenate([np.zeros(len(vector)), violated])
        change = np.linalg.solve(self._matrix, right)[: len(vector)]
        return (
            vector if self._norm(change) <= fits * self._norm(vector - change) else vector - change
        )

    def _norm(self, vector: Array) -> float:
        return float(np.sqrt(abs(vector @ self._mass @ vector)))


def fit_start(
    mbs: exu.MainSystem, solver: Any, constraints: Constraints, length: float, ahead: float
) -> tuple[Array, Array] | None:
    """Let the start fit the constraints, as near to what it was as can be.

    Args:
        mbs: the system, at its start, its mass matrix computed.
        solver: an exu.MainSolverImplicitSecondOrder.
        constraints: of the system.
        length: of the coordinates, m.
        ahead: time within which constraints are asked, s; motions are smooth in it.

    Returns:
        The accelerations, and what of their rate the constraints prescribe; None without any.
    """
    if not constraints.count or not solver.GetODE2size():
        return None
    start = _Start(mbs, solver, constraints, ahead)
    held = start.held
    for _ in range(ITERATIONS):
        violated = np.where(held, start.violated(), 0.0)
        if np.abs(violated).max() <= FITS[0] * length:
            break
        start.q = start.mended(start.q, violated, 0.0)
    accelerations, start.a = start.a, np.zeros_like(start.a)
    start.v = start.mended(start.v, np.where(held, start.rates()[0], start.violated()), FITS[1])
    start.a = accelerations
    first, second, _ = start.rates()
    start.a = start.mended(start.a, np.where(held, second, first), FITS[2])
    _, second, third = start.rates()
    rate = start.mended(np.zeros_like(start.a), np.where(held, third, second), 0.0)
    start.put()
    return start.a, rate


def start_rates(mbs: exu.MainSystem, solver: Any) -> None:
    """Set the rates of first-order coordinates at the start.

    Exudyn takes them for zero there, which leaves half of the first step's change in the result.
    """
    data: Any = mbs.systemData
    before, size = solver.GetODE2size(), data.ODE1Size()
    solver.ComputeODE1RHS(mbs)
    rates = np.array(solver.GetSystemResidual())[before : before + size]
    for configuration in (CURRENT, START):
        data.GetODE1Coordinates_t(configuration, False)[:] = rates
