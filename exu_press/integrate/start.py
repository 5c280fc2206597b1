"""The state from which a run starts, moved to fit its constraints before the first step."""

import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array
from exu_press.numerics.linear import Equations

__all__ = ["fit_jump", "fit_start", "start_rates", "start_without_mass"]

LOOK_AHEAD = 0.01
"""Time ahead of the start at which constraints are evaluated, over the largest step; motions are
smooth in it."""

START_ITERATIONS = 4
"""Iterations of Newton's method to positions that fit the constraints."""

FITS = 1e-14, 1e-6, 1e-6
"""Relative violation up to which positions, velocities and accelerations may be off before they
are moved: differences are rounded. Forces of constraints go as violations over the square of a
step: on a ton, 1e-13 m are 20 kN in a step of 0.1 us."""

MASSLESS = 1e-12
"""Over the largest mass, up to which a coordinate has none."""


class _Start:
    """The current state at a time, s, and its constraints there and soon after."""

    def __init__(self, task: Task, constraints: Constraints, time: float) -> None:
        self._data, self._current = task.problem.data, task.problem.current
        self._constraints = constraints
        self._solver, self._mbs = task.solver, task.problem.mbs
        self._start, self._ahead = time, LOOK_AHEAD * task.largest
        self.q = np.array(self._current.positions)
        self.v = np.array(self._current.velocities)
        self.a = np.array(self._current.accelerations)
        self._mass = np.array(task.solver.GetSystemMassMatrix())
        self._matrix = constraints.matrix(self._mass, constraints.directions())
        self.held = ~constraints.of_velocities()

    def put(self, time: float = 0.0) -> None:
        """Set the state after a time (s), with the accelerations of the start."""
        current = self._current
        current.positions[:] = self.q + time * self.v + 0.5 * time * time * self.a
        current.velocities[:] = self.v + time * self.a
        current.accelerations[:] = self.a
        self._data.SetTime(self._start + time)

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

    def projected(self, vector: Array, violated: Array, fits: float) -> Array:
        """Return the nearest vector, in the kinetic norm, without violations; itself if it fits."""
        change = self._solved(np.zeros(len(vector)), violated)
        return (
            vector if self._norm(change) <= fits * self._norm(vector - change) else vector - change
        )

    def pushed(self) -> Array:
        """Return the accelerations of the forces in the state, if constraints stood still."""
        self.put()
        self._solver.ComputeODE2RHS(self._mbs)
        forces = np.array(self._solver.GetSystemResidual())[: len(self.q)]
        return self._solved(forces, np.zeros(len(self.held)))

    def fit_rates(self, *, moved: bool) -> Array:
        """Let velocities and accelerations fit; return what of their rate constraints prescribe.

        Args:
            moved: whether springs and contacts push otherwise than by the given accelerations.
        """
        held, accelerations, self.a = self.held, self.a, np.zeros_like(self.a)
        self.v = self.projected(self.v, np.where(held, self.rates()[0], self.violated()), FITS[1])
        self.a = self.pushed() if moved else accelerations
        first, second, _ = self.rates()
        self.a = self.projected(self.a, np.where(held, second, first), FITS[2])
        _, second, third = self.rates()
        rate = self.projected(np.zeros_like(self.a), np.where(held, third, second), 0.0)
        self.put()
        return rate

    def _solved(self, forces: Array, violated: Array) -> Array:
        """Return the change that forces and violations ask for."""
        right = np.zeros(len(self._matrix))
        right[: len(forces) + len(violated)] = np.concatenate([forces, violated])
        try:
            return np.asarray(Equations(self._matrix).solve(right)[: len(forces)])
        except np.linalg.LinAlgError:  # coordinates without mass, as of a beam's cross-sections
            return np.asarray(np.linalg.lstsq(self._matrix, right, rcond=None)[0][: len(forces)])

    def _norm(self, vector: Array) -> float:
        return float(np.sqrt(abs(vector @ self._mass @ vector)))


def fit_start(task: Task, constraints: Constraints) -> tuple[Array, Array] | None:
    """Let the start fit the constraints, as near to what it was as can be.

    Exudyn computes accelerations at the start, but for constraints that stand still: where an
    offset's user function prescribes a motion, what it asks of velocities and accelerations is not
    in them. And a drawing with five digits is off its joints by micrometres, of which a first step
    of microseconds would make metres a second. What is missing is found along the motion that the
    start has: the constraints are asked at a few instants ahead, whose differences are what they
    change by.

    Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, VII.1 (consistent
    values of systems of index 3).

    The solver has computed the mass matrix of the state.

    Returns:
        The accelerations, and what of their rate the constraints prescribe; None without any.
    """
    if not constraints.count or not task.problem.nodes:
        return None
    start = _Start(task, constraints, task.start)
    length, moved = task.problem.length or 1.0, False
    for _ in range(START_ITERATIONS):
        violated = np.where(start.held, start.violated(), 0.0)
        if np.abs(violated).max() <= FITS[0] * length:
            break
        start.q, moved = start.projected(start.q, violated, 0.0), True
    return start.a, start.fit_rates(moved=moved)


def fit_jump(task: Task, constraints: Constraints, end: float) -> tuple[Array, Array, Array]:
    """Return the motion after a step within which the velocity of a prescribed motion jumps.

    The constraints' impulses change velocities by the least, in the kinetic norm: all else acts for
    no time.

    Args:
        task: to be solved; its current state ends the step.
        constraints: of the system.
        end: of the step, s.

    Returns:
        Velocities and accelerations, and the prescribed rate of these.

    Source: F. Pfeiffer and C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996: M times
    the jump of velocities is the constraints' directions times their impulses.
    """
    start = _Start(task, constraints, end)
    tried, start.v = start.v, np.array(task.problem.start.velocities)
    rate = start.fit_rates(moved=True)
    task.problem.current.velocities[:] = tried
    return start.v, start.a, rate


def start_rates(task: Task, time: float) -> None:
    """Set the rates of first-order coordinates at the start of a step, a time in s.

    Exudyn takes them for zero at the start of a run, which leaves half of the first step's change
    in the result, and keeps them where a function changes what they follow from. Its own time is
    that of the step's end by then.
    """
    problem = task.problem
    before, size = len(problem.current.positions), len(problem.current.rates)
    if size:
        now = problem.data.GetTime()
        problem.data.SetTime(time)
        task.solver.ComputeODE1RHS(problem.mbs)
        problem.data.SetTime(now)
        rates = np.array(task.solver.GetSystemResidual())[before : before + size]
        problem.current.rates[:] = problem.start.rates[:] = rates


class _WithoutMass:
    """Coordinates without mass: their velocity balances springs and dampers.

    Attributes:
        free: directions without mass that constraints leave free, (k, n).
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Find coordinates without mass; the solver has computed the mass matrix of the state."""
        self._solver, self._mbs, self._current = task.solver, task.problem.mbs, task.problem.current
        self._mass = mass = np.array(task.solver.GetSystemMassMatrix())
        size = len(mass)
        held = constraints.directions() if constraints.count else np.zeros((0, size))
        scaled = np.zeros((size, held.shape[1]))  # places along cables have none
        scaled[:, :size] = mass / (np.abs(mass).max(initial=0.0) or 1.0)
        _, found, directions = np.linalg.svd(np.vstack([scaled, held]))
        rank = np.count_nonzero(found > MASSLESS * found.max(initial=0.0))
        self.free = directions[rank:, :size]

    def balance(self) -> Array:
        """Change the velocities of the current state so; return the others' accelerations."""
        velocities, free, forces = self._current.velocities, self.free, self._forces()
        size, slopes = np.abs(velocities).max() or 1.0, []
        for direction in free:
            velocities += size * direction
            slopes.append(free @ (self._forces() - forces) / size)
            velocities -= size * direction
        velocities -= np.linalg.lstsq(np.array(slopes).T, free @ forces, rcond=MASSLESS)[0] @ free
        found: Array = np.linalg.lstsq(self._mass, self._forces(), rcond=MASSLESS)[0]
        return found

    def _forces(self) -> Array:
        """Return the forces on the coordinates, without constraints."""
        self._solver.ComputeODE2RHS(self._mbs)
        return np.array(self._solver.GetSystemResidual())[: len(self._mass)]


def start_without_mass(task: Task, constraints: Constraints) -> tuple[Array, Array] | None:
    """Set accelerations at the start, and velocities of coordinates without mass, if there are any.

    Exudyn starts with accelerations of zero then. Those of what has no mass are known from its
    velocities a little ahead.

    The solver has computed the mass matrix of the state.

    Returns:
        The accelerations, and that nothing prescribes their rate; None where all has mass.
    """
    if not task.problem.nodes:
        return None
    massless, data = _WithoutMass(task, constraints), task.problem.data
    if not len(massless.free):
        return None
    current, ahead = task.problem.current, LOOK_AHEAD * task.first
    accelerations = massless.balance()
    positions, velocities = np.array(current.positions), np.array(current.velocities)
    current.positions += ahead * velocities
    current.velocities += ahead * accelerations
    data.SetTime(task.start + ahead)
    expected = np.array(current.velocities)
    massless.balance()
    accelerations += (current.velocities - expected) / ahead
    data.SetTime(task.start)
    for state in (current, task.problem.start):
        state.positions[:], state.velocities[:] = positions, velocities
        state.accelerations[:] = accelerations
    return accelerations, np.zeros_like(accelerations)
