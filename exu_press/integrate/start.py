"""The state from which a run starts, moved to fit its constraints before the first step."""

import math
from collections.abc import Callable

import numpy as np

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.forces import forces
from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array
from exu_press.numerics.linear import Equations

__all__ = ["LOOK_AHEAD", "fit_jump", "fit_start", "start_rates", "start_without_mass"]

LOOK_AHEAD = 0.01
"""Time between the instants at which constraints are asked at the start, over the largest step."""

START_ITERATIONS = 10
"""Iterations of Newton's method to positions that fit the constraints."""

FITS = 1e-14, 1e-6, 1e-6
"""Relative violation up to which positions, velocities and accelerations may be off before they
are moved: differences are rounded. Forces of constraints go as violations over the square of a
step: on a ton, 1e-13 m are 20 kN in a step of 0.1 us."""

NEAR = 1e-9
"""Between positions at which constraints are asked whether they are lines, over the length: its
square is less than a last digit."""

LINES = 1e-20
"""Over the length: by how much the violations of a line are off it at such positions."""

SAMPLES = 3
"""Of these positions: at a third of them last digits cancel by chance."""

DEFORMS = 1e-8
"""Violation at the start, over the length, from which bodies are not to be deformed to fit: less
is rounding, and makes speeds of micrometres a second."""

SHRINKS = 0.5
"""Part of what is missing that two iterations leave at most; more is rounding. One may leave all:
Exudyn's directions of joints are those of Euler parameters of length 1, which the first one mends.
"""

MASSLESS = 1e-12
"""Over the largest mass, up to which a coordinate has none."""


def _accelerations(task: Task) -> Array:
    """Return the accelerations of these forces, zero where there is no mass."""
    mass = task.solver.GetSystemMassMatrix()
    return np.asarray(np.linalg.lstsq(mass, forces(task), rcond=MASSLESS)[0])


class _Start:
    """The current state at a time, s, and its constraints there and soon after."""

    def __init__(self, task: Task, constraints: Constraints, time: float, ahead: float) -> None:
        self._task, self._constraints = task, constraints
        self._data, self._current = task.problem.data, task.problem.current
        self._solver, self._mbs = task.solver, task.problem.mbs
        self._start, self._ahead = time, ahead
        self.length = task.problem.length or 1.0
        self.q = np.array(self._current.positions)
        self.v = np.array(self._current.velocities)
        self.a = np.array(self._current.accelerations)
        self.turn()
        self.held = ~constraints.of_velocities()

    def turn(self) -> None:
        """Take masses and constraints' directions of the current state."""
        self._mass = np.array(self._solver.GetSystemMassMatrix())
        self._directions = self._constraints.directions()
        self._equations = Equations(self._constraints.matrix(self._mass, self._directions))

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

    def fitted(self, vector: Array, missing: Callable[[Array], Array], order: int) -> Array:
        """Return the nearest vector, in the kinetic norm, with which nothing is missing.

        A relative change by FITS is rounding, and one that rounded differences make; so is one that
        does not shrink.

        Args:
            vector: velocities or accelerations; itself where it fits.
            missing: of them: what the constraints' rates are off by.
            order: of the rates.
        """
        last = before = math.inf
        fits, least = FITS[order], self._rounded(order)
        for _ in range(START_ITERATIONS):
            change = self.undone(missing(vector))
            size = self._norm(change)
            if size <= max(least, fits * self._norm(vector - change)) or size > SHRINKS * before:
                break
            vector, last, before = vector - change, size, last
        return vector

    def _rounded(self, order: int) -> float:
        """Return what rounding makes of a change that rates of this order ask for."""
        rounding = self._task.tuning.rounding * self.length / self._ahead**order
        rounded = np.full(len(self.held), rounding)
        return self._norm(self.undone(rounded))

    def shaken(self) -> Array:
        """Return by how much positions change, (n,), where constraints are off in a last digit.

        Each by one, m or rad, one way or the other. But those that are lines, as that of a
        coordinate, have none to be off in.
        """
        random, there, bent = np.random.default_rng(0), self.q, np.zeros(len(self.held))
        at_start = self.violated()
        for _ in range(SAMPLES):
            apart = NEAR * self.length * random.uniform(-1.0, 1.0, len(there))
            self.q = there + 0.3 * apart
            between = self.violated()
            self.q = there + apart
            bent += np.abs(0.7 * at_start - between + 0.3 * self.violated())
        self.q = there
        self.put()
        either_way = random.choice([-1.0, 1.0], len(self.held))
        return self.undone(np.where(bent > LINES * self.length, either_way, 0.0))

    def stiffened(self, period: float) -> Array:
        """Return the matrix of changes of positions that deform nothing, for `undone`.

        A body that is deformed to fit vibrates: what a marker on 100 nodes was off by, 1 mm, made
        speeds of 1000 m/s of a steel bar's modes. So the norm is that of masses, and of the
        stiffness with which a displacement pushes for a period.

        Args:
            period: that time, s.
        """
        size = len(self.q)
        before = np.array(self._solver.GetSystemJacobian())
        self._solver.ComputeJacobianODE2RHS(self._mbs, -1.0, 0.0)
        stiffness = np.array(self._solver.GetSystemJacobian())[:size, :size]
        self._solver.SetSystemJacobian(before)
        norm = self._mass + 0.5 * period * period * (stiffness + stiffness.T)
        return self._constraints.matrix(norm, self._directions)

    def undone(self, violated: Array, matrix: Array | None = None) -> Array:
        """Return the least change to take away, that undoes violations, as `Constraints.undone`.

        In the kinetic norm, or with that of another matrix.
        """
        return self._solved(np.zeros(len(self.q)), violated, matrix)

    def pushed(self) -> Array:
        """Return the accelerations of the forces in the state, if constraints stood still."""
        self.put()
        return self._solved(forces(self._task), np.zeros(len(self.held)))

    def fit_rates(self, *, pushed: bool) -> Array:
        """Let velocities and accelerations fit; return what of their rate constraints prescribe.

        Accelerations that fit are left alone: differences tell them to fewer digits. A rate that
        rounding may have made is none.

        Args:
            pushed: whether forces are others than the given accelerations belong to.
        """
        held, velocities, accelerations = self.held, self.v, self.a
        self.a = np.zeros_like(accelerations)

        def of_velocities(velocities: Array) -> Array:
            self.v = velocities
            return np.where(held, self.rates()[0], self.violated())

        def of_accelerations(accelerations: Array) -> Array:
            self.a = accelerations
            first, second, _ = self.rates()
            return np.where(held, second, first)

        self.v = self.fitted(velocities, of_velocities, 1)
        pushed = pushed or self.v is not velocities
        if pushed or self._driven():
            given = self.pushed() if pushed else accelerations
            self.a = self.fitted(given, of_accelerations, 2)
        else:
            self.a = accelerations
        _, second, third = self.rates()
        rate = -self.undone(np.where(held, third, second))
        self.put()
        return rate if self._norm(rate) > self._rounded(3) else np.zeros_like(rate)

    def _driven(self) -> bool:
        """Return whether constraints change while nothing moves, as prescribed motions do."""
        now = self.violated()
        for i in range(1, 4):
            self._data.SetTime(self._start + i * self._ahead)
            if (self._constraints.violated() != now).any():
                return True
        return False

    def _solved(self, pushing: Array, violated: Array, matrix: Array | None = None) -> Array:
        """Return the change that forces and violations ask for."""
        equations = self._equations if matrix is None else Equations(matrix)
        right = np.zeros(len(equations.matrix))
        right[: len(pushing) + len(violated)] = np.concatenate([pushing, violated])
        try:
            return np.asarray(equations.solve(right)[: len(pushing)])
        except np.linalg.LinAlgError:  # coordinates without mass, as of a beam's cross-sections
            least = np.linalg.lstsq(equations.matrix, right, rcond=None)[0]
            return np.asarray(least[: len(pushing)])

    def _norm(self, vector: Array) -> float:
        return float(np.sqrt(abs(vector @ self._mass @ vector)))


def fit_start(
    task: Task, constraints: Constraints, ahead: float, *, pushed: bool = False
) -> tuple[Array, Array] | None:
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

    Args:
        task: to be solved.
        constraints: of the system.
        ahead: time between these instants, s.
        pushed: whether forces are others than Exudyn computed accelerations from.

    Returns:
        The accelerations, and what of their rate the constraints prescribe; None where there is
        nothing to fit.
    """
    if not task.problem.nodes:
        return None
    if not constraints.count:
        if not pushed:
            return None
        accelerations = task.problem.current.accelerations
        accelerations[:] = _accelerations(task)
        return np.array(accelerations), np.zeros_like(accelerations)
    start = _Start(task, constraints, task.start, ahead)
    length, deforms = start.length, False
    anywhere = task.problem.joints is None  # clearance joints remember where they were asked
    last = before = math.inf
    for i in range(START_ITERATIONS):
        violated = np.where(start.held, start.violated(), 0.0)
        size = float(np.abs(violated).max())
        if size <= FITS[0] * length or size > SHRINKS * before:
            break
        last, before = size, last
        if i:
            task.solver.ComputeMassMatrix(task.problem.mbs)
            start.turn()
        deforms = deforms or (anywhere and size > DEFORMS * length)
        matrix = start.stiffened(task.largest) if deforms else None
        start.q = start.q - start.undone(violated, matrix)
    if anywhere:
        constraints.shaken = start.shaken()
    rate = start.fit_rates(pushed=pushed or last < math.inf)
    return start.a, rate


def fit_jump(
    task: Task, constraints: Constraints, before: Array, end: float, ahead: float
) -> tuple[Array, Array, Array]:
    """Return the motion after a jump of velocities, prescribed or set; let positions fit.

    The constraints' impulses change velocities by the least, in the kinetic norm: all else acts for
    no time. What Newton's method has left of positions would be a jolt in a short step.

    Args:
        task: to be solved; its current state is where they jump.
        constraints: of the system.
        before: velocities, as set, or in front of what is prescribed.
        end: of the jump, s.
        ahead: time between the instants at which constraints are asked, s.

    Returns:
        Velocities and accelerations, and the prescribed rate of these.

    Source: F. Pfeiffer and C. Glocker, Multibody Dynamics with Unilateral Contacts, 1996: M times
    the jump of velocities is the constraints' directions times their impulses.
    """
    if not constraints.count:
        accelerations = _accelerations(task)
        return before, accelerations, np.zeros_like(accelerations)
    start = _Start(task, constraints, end, ahead)
    tried, start.v = (start.v, start.a), before
    start.q = start.q - start.undone(np.where(start.held, start.violated(), 0.0))
    rate = start.fit_rates(pushed=True)
    current = task.problem.current
    current.velocities[:], current.accelerations[:] = tried
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
        rates = task.solver.GetSystemResidual()[before : before + size]
        problem.current.rates[:] = problem.start.rates[:] = rates


class _WithoutMass:
    """Coordinates without mass: their velocity balances springs and dampers.

    Attributes:
        free: directions without mass that constraints leave free, (k, n).
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Find coordinates without mass; the solver has computed the mass matrix of the state."""
        self._task, self._current = task, task.problem.current
        mass = np.array(task.solver.GetSystemMassMatrix())
        size = len(mass)
        held = constraints.directions() if constraints.count else np.zeros((0, size))
        scaled = np.zeros((size, held.shape[1]))  # places along cables have none
        scaled[:, :size] = mass / (np.abs(mass).max(initial=0.0) or 1.0)
        _, found, directions = np.linalg.svd(np.vstack([scaled, held]))
        rank = np.count_nonzero(found > MASSLESS * found.max(initial=0.0))
        self.free = directions[rank:, :size]

    def balance(self) -> Array:
        """Change the velocities of the current state so; return the others' accelerations."""
        task, velocities, free = self._task, self._current.velocities, self.free
        size, slopes, pushing = np.abs(velocities).max() or 1.0, [], forces(task)
        for direction in free:
            velocities += size * direction
            slopes.append(free @ (forces(task) - pushing) / size)
            velocities -= size * direction
        velocities -= np.linalg.lstsq(np.array(slopes).T, free @ pushing, rcond=MASSLESS)[0] @ free
        return _accelerations(task)


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
