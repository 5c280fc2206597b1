"""Constraint violation of a system, and the smallest change that removes it.

Exudyn tells violations of positions, and of velocities where a constraint has a rate of its own.
But where a user function prescribes an offset and none its rate, Exudyn takes that for zero, and at
flexible bodies' rigid markers velocities are off the rates of the positions by a millionth of a
metre a second; the rates of such systems are found from positions, a little ahead and behind.

Before the first step the state is moved to fit them (`fit_start`); where the step changes, so is
what generalized-alpha carries over (`StepChange`).
"""

import math

import numpy as np
from numpy.typing import NDArray

from exu_press.arrays import Array
from exu_press.integrate.settings import SAME, Task, inertia_factor
from exu_press.numerics.linear import Equations

__all__ = [
    "Constraints",
    "StepChange",
    "fit_start",
    "start_rates",
    "start_without_mass",
]

Flags = NDArray[np.bool_]

GIVE = 1e-8
"""Of constraints, over what the masses give way. Where two of them nearly say the same, a hundredth
of it made 5e-11 m of the last digits of positions, which contacts took for a motion."""

LOOK_AHEAD = 0.01
"""Time ahead of the start at which constraints are evaluated, over the largest step; motions are
smooth in it."""

REDUNDANT = 1e-8
"""Singular value of constraints' directions of length 1, below which one repeats others."""

START_ITERATIONS = 4
"""Of Newton's method to positions that fit the constraints."""

FITS = 1e-14, 1e-6, 1e-6
"""Relative violation up to which positions, velocities and accelerations may be off before they
are moved: differences are rounded. Forces of constraints go as violations over the square of a
step: on a ton, 1e-13 m are 20 kN in a step of 0.1 us."""

AHEAD = 1.0 / 64.0
"""Of a step: near enough to tell velocities from positions, far enough for rounded ones."""

MORE = 0.999
"""Of what masses resist a change with: to which part forces resist it too, but for rounding."""

MASSLESS = 1e-12
"""Over the largest mass, up to which a coordinate has none."""

CHANGE_ITERATIONS = 3
"""To velocities and positions that fit the constraints; each leaves some hundredths."""


class Constraints:
    """The constraints of a system."""

    def __init__(self, task: Task) -> None:
        """Take what is solved."""
        problem = task.problem
        self._mbs, self._solver, self._data = problem.mbs, task.solver, problem.data
        self._current, self._untold = problem.current, problem.untold_rates
        self._start = problem.start
        self._of_velocities: Flags | None = None

    @property
    def count(self) -> int:
        """Their number."""
        return len(self._current.multipliers)

    def of_velocities(self) -> Flags:
        """Return which of them hold velocities; the others hold positions."""
        if self._of_velocities is None:
            self._of_velocities = np.asarray(self._jacobian(0.0, 1.0).any(axis=1))
        return self._of_velocities

    def directions(self) -> Array:
        """Return the rate of each one's violation with the coordinates it holds, (count, n)."""
        return self._jacobian(1.0, 0.0) + self._jacobian(0.0, 1.0)

    def redundant(self) -> int:
        """Return how many of them say the same as others, where the step under way begins."""
        if not self.count:
            return 0
        positions = self._current.positions
        tried = np.array(positions)
        positions[:] = self._start.positions
        directions = self.directions()
        positions[:] = tried
        lengths = np.sqrt(np.square(directions).sum(axis=1))
        held = directions[lengths > 0.0] / lengths[lengths > 0.0, None]  # else switched off
        return len(held) - int(np.linalg.matrix_rank(held, tol=REDUNDANT))

    def _jacobian(self, of_positions: float, of_velocities: float) -> Array:
        solver, size = self._solver, len(self._current.positions)
        before = np.array(solver.GetSystemJacobian())
        solver.SetSystemJacobian(np.zeros((size + solver.GetODE1size() + self.count,) * 2))
        solver.ComputeJacobianAE(self._mbs, of_positions, of_velocities)
        found = np.array(solver.GetSystemJacobian())[-self.count :, :size]
        solver.SetSystemJacobian(before)
        return found

    def violated(self, *, velocities: bool = False) -> Array:
        """Return by how much each is violated in the current state; or its rate, if it has one."""
        self._solver.ComputeAlgebraicEquations(self._mbs, velocityLevel=velocities)
        return np.array(self._solver.GetSystemResidual())[-self.count :]

    def violated_rates(self, ahead: float) -> Array:
        """Return by how much velocities of the current state violate each constraint.

        Args:
            ahead: time within which positions tell it where velocities do not, s.
        """
        if not self._untold:
            return self.violated(velocities=True)
        time, positions = self._data.GetTime(), self._current.positions
        now, here = np.array(positions), self.violated()
        beside = []
        for side in (ahead, -ahead):
            positions[:] = now + side * self._current.velocities
            self._data.SetTime(time + side)
            beside.append(self.violated())
        positions[:] = now
        self._data.SetTime(time)
        rates = (beside[0] - beside[1]) / (2.0 * ahead)
        return np.where(self.of_velocities(), here, rates)

    def matrix(self, mass: Array, directions: Array) -> Array:
        """Return [[M, C^T], [C, -give]].

        Euler parameters have no mass along themselves, where a constraint holds them: the masses
        alone cannot be inverted, with the constraints they can. The little give allows for
        constraints that say the same as others, or nothing.

        Args:
            mass: (n, n).
            directions: C, (count, n).
        """
        size, count = len(mass), len(directions)
        matrix = np.zeros((size + count, size + count))
        matrix[:size, :size] = mass
        matrix[size:, :size] = directions
        matrix[:size, size:] = directions.T
        give = GIVE * np.square(directions).max() / np.diag(mass).max()
        own = range(size, size + count)
        matrix[own, own] = -give or -1.0
        return matrix


class _Start:
    """The state at the start, and what its constraints say of it and ahead of it."""

    def __init__(self, task: Task, constraints: Constraints) -> None:
        self._data, self._current = task.problem.data, task.problem.current
        self._constraints = constraints
        self._solver, self._mbs = task.solver, task.problem.mbs
        self._start, self._ahead = task.start, LOOK_AHEAD * task.largest
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

    def _solved(self, forces: Array, violated: Array) -> Array:
        """Return the change that forces and violations ask for."""
        right = np.concatenate([forces, violated])
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
    start = _Start(task, constraints)
    held, length, moved = start.held, task.problem.length or 1.0, False
    for _ in range(START_ITERATIONS):
        violated = np.where(held, start.violated(), 0.0)
        if np.abs(violated).max() <= FITS[0] * length:
            break
        start.q, moved = start.projected(start.q, violated, 0.0), True
    accelerations, start.a = start.a, np.zeros_like(start.a)
    start.v = start.projected(start.v, np.where(held, start.rates()[0], start.violated()), FITS[1])
    # springs and contacts push otherwise in another place
    start.a = start.pushed() if moved else accelerations
    first, second, _ = start.rates()
    start.a = start.projected(start.a, np.where(held, second, first), FITS[2])
    _, second, third = start.rates()
    rate = start.projected(np.zeros_like(start.a), np.where(held, third, second), 0.0)
    start.put()
    return start.a, rate


def start_rates(task: Task) -> None:
    """Set the rates of first-order coordinates at the start.

    Exudyn takes them for zero there, which leaves half of the first step's change in the result.
    """
    problem = task.problem
    before, size = len(problem.current.positions), len(problem.current.rates)
    if size:
        task.solver.ComputeODE1RHS(problem.mbs)
        rates = np.array(task.solver.GetSystemResidual())[before : before + size]
        problem.current.rates[:] = problem.start.rates[:] = rates


class _WithoutMass:
    """Coordinates without mass: their velocity balances springs and dampers.

    Attributes:
        free: directions without mass that constraints leave free, (k, n).
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Look for what has no mass; the solver has computed the mass matrix of the state."""
        self._solver, self._mbs, self._current = task.solver, task.problem.mbs, task.problem.current
        self._mass = mass = np.array(task.solver.GetSystemMassMatrix())
        held = [constraints.directions()] if constraints.count else []
        scaled = mass / (np.abs(mass).max(initial=0.0) or 1.0)
        _, found, directions = np.linalg.svd(np.vstack([scaled, *held]))
        self.free = directions[np.count_nonzero(found > MASSLESS * found.max(initial=0.0)) :]

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
        """Return what acts on the coordinates, but constraints."""
        self._solver.ComputeODE2RHS(self._mbs)
        return np.array(self._solver.GetSystemResidual())[: len(self._mass)]


def start_without_mass(task: Task, constraints: Constraints) -> tuple[Array, Array] | None:
    """Set accelerations at the start, and velocities of what has no mass, if there is any.

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


class StepChange:
    """Carries generalized-alpha over a change of step without ringing.

    With steps of one size h generalized-alpha settles on offsets that belong to h: its algorithmic
    acceleration a is the true one at another instant, a - a_true = h (alpha_m - alpha_f)
    da_true/dt, and where positions are constrained the velocities miss the constraints by an amount
    of order h^2. A much shorter step takes both for errors and answers with accelerations that
    alternate for a dozen steps, larger than the motion's own changes. Scaled to the new step, by
    its ratio to the old one and by that ratio's square, both fit at once; the latter costs as much
    as a step. Likewise what Newton's method left of the positions' constraints, 1e-10 m, is nothing
    beside a long step but a jolt beside a short one: it is taken away.

    Without films and contacts motion is smooth, steps change seldom, and each change is worth this.
    With them steps change all the time: velocities are fitted once steps have shrunk to a third,
    and a longer step, which has little to make of either, is left alone: scaling up would blow up
    whatever an impact or a film's start left ringing.

    Exudyn's algorithmic acceleration can be read but not written, and when a step is repeated it
    keeps the value of the failed try. But positions, velocities and accelerations at the step's
    beginning can be shifted so that the step comes out as if it had been changed.

    At rest a film carries nothing, and within a microsecond or less it takes up its load: the
    accelerations with which Exudyn starts are then wrong at once, and ring. What the first step
    changes the velocities by is right, as a film answers to velocities; so the step is repeated
    from that.

    Source: M. Arnold and O. Bruels, Convergence of the generalized-alpha scheme for constrained
    mechanical systems, Multibody System Dynamics 18 (2007), Eqs. 2 and 3, and its remarks on the
    hidden constraints.
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Watch the steps of a system that has these constraints."""
        problem = task.problem
        self._smooth = problem.joints is None
        self._film_waits = problem.lubricated
        self._refit = task.tuning.refit
        self._solver, self._constraints = task.solver, constraints
        self._data, self._current, self._at_start = problem.data, problem.current, problem.start
        self._start: float | None = None  # of the step under way, s
        self._last: float | None = None  # size of the last accepted step, s
        self._fits = self._leaves = 0.0  # the step that constrained velocities fit, now and next
        self._state: list[Array] = []  # at the step's beginning, before any shift
        self._offsets: tuple[Array, Array] | None = None
        self._mean: Array | None = None  # acceleration of the first step
        # accelerations at the start, and what of their rate constraints prescribe
        self._given: tuple[Array, Array] | None = None

    def start_over(self, step: float) -> bool:
        """Return whether a step (s) is to be repeated from its own mean acceleration.

        The first one is, once, where a film takes up its load. To be asked after it was tried.
        """
        if not self._film_waits:
            return False
        self._film_waits = False
        self._mean = (self._current.velocities - self._at_start.velocities) / step
        return True

    def start_from(self, accelerations: Array, rate: Array) -> None:
        """Let the first step start with the offsets on which further ones would settle.

        Args:
            accelerations: at the start.
            rate: what constraints prescribe of their rate of change.
        """
        self._given = accelerations, rate

    def before_try(self, start: float, step: float) -> None:
        """Shift the state from which Exudyn is about to try a step (s) from a start (s)."""
        repeated = start == self._start
        if not repeated:
            self._last = None if self._start is None else start - self._start
            self._fits = max(self._leaves, self._last or 0.0)
            self._start, self._state, self._offsets = start, [], None
        self._leaves = self._fits
        ratio = 1.0 if self._last is None else step / self._last
        if not self._smooth:
            ratio = min(1.0, ratio)
        given = self._last is None and self._given is not None
        if repeated or given or abs(ratio - 1.0) > SAME:
            self._shift(step, ratio)

    def _shift(self, step: float, ratio: float) -> None:
        """Shift positions, velocities and accelerations for a step `ratio` times the last one.

        Newton's method may start anew, from what Exudyn keeps of the step's beginning; so that is
        shifted as well, by what is missing there.
        """
        solver, start = self._solver, self._at_start
        if not self._state:
            self._state = [
                np.array(view) for view in (start.positions, start.velocities, start.accelerations)
            ]
        q, v, a = self._state
        if abs(ratio - 1.0) > SAME:
            part = step / self._fits
            if part < self._refit or self._smooth:
                if self._offsets is None:
                    self._offsets = self._violations()
                q = q - self._offsets[0]
                v = v - (1.0 - part * part) * self._offsets[1]
                self._leaves = step
        at_start = solver.GetStartOfStepStateAAlgorithmic()
        wanted = a + ratio * (at_start - a)
        if self._last is None and self._mean is not None:
            a = wanted = self._mean
        elif self._last is None and self._given is not None:
            a, rate = self._given
            settled = solver.alphaM - solver.alphaF
            wanted = a + settled * step * rate
            v = v + (1.0 / 6.0 - solver.newmarkBeta - 0.5 * settled) * step * step * rate
        # q1 = q + h v + h^2 (1/2 - beta) a + h^2 beta a1 and v1 = v + h (1 - gamma) a + h gamma a1
        # with (1 - alpha_m) a1 + alpha_m a = (1 - alpha_f) a_true1 + alpha_f a_true
        beta, gamma = solver.newmarkBeta, solver.newmarkGamma
        current = self._current
        for state, there in ((current, solver.GetAAlgorithmic()), (start, at_start)):
            missing = wanted - there
            state.positions[:] = q + step * step * (gamma - 0.5 - beta) * missing
            state.velocities[:] = v + step * (1.0 - gamma) * missing
            state.accelerations[:] = a - (solver.alphaM / solver.alphaF) * missing

    def _violations(self) -> tuple[Array, Array]:
        """Return what of positions and velocities the constraints forbid, in Newton's norm.

        Of all changes that mend it the one that the last Jacobian resists least, as in an iteration
        of Newton's method: that counts what masses weigh, and what films and contacts would answer
        with. In the norm of masses alone a journal was moved in its film by 1e-5 m/s, which it
        answered with 2.4 kN. But a contact that lets go may give way to a change instead, so that
        a large one costs nothing: where masses alone resist more, they count.
        """
        size, count = len(self._current.positions), self._constraints.count
        if count == 0:
            return np.zeros(size), np.zeros(size)
        solver = self._solver
        jacobian = np.asarray(solver.GetSystemJacobian())
        directions, forces = jacobian[-count:, :size], jacobian[:size, :size]
        inertia = inertia_factor(solver) * solver.GetSystemMassMatrix()
        found = self._projection(0.5 * (forces + forces.T), directions)
        for change in found:
            if change @ forces @ change < MORE * (change @ inertia @ change):
                return self._projection(inertia, directions)
        return found

    def _projection(self, norm: Array, directions: Array) -> tuple[Array, Array]:
        """Return the least changes of positions and velocities that the constraints ask for.

        The directions in which constraints act are those of the last Jacobian, perhaps a degree of
        the crank away; how far they are violated is of this very state, so a few turns lead to it.

        Args:
            norm: (n, n), in which they are the least.
            directions: of the constraints, (count, n).
        """
        size = len(norm)
        # Newton's matrix has those of velocities over the step
        lengths = np.sqrt(np.square(directions).sum(axis=1))
        lengths[lengths == 0.0] = 1.0
        matrix = self._constraints.matrix(norm, directions / lengths[:, None])
        position, velocity = self._current.positions, self._current.velocities
        now = self._data.GetTime()
        self._data.SetTime(self._start)
        found, violated = np.zeros((size, 2)), np.zeros((len(matrix), 2))
        equations: Equations | None = None
        for _ in range(CHANGE_ITERATIONS):
            position[:] = self._state[0] - found[:, 0]
            velocity[:] = self._state[1] - found[:, 1]
            violated[size:, 0] = self._constraints.violated()
            violated[size:, 1] = self._constraints.violated_rates(AHEAD * self._fits)
            violated[size:] /= lengths[:, None]
            same = violated[:, 0] == violated[:, 1]
            violated[same] = 0.0  # prescribed speeds are no places, and are met as they are
            try:
                equations = equations or Equations(matrix)
                found += equations.solve(violated)[:size]
            except np.linalg.LinAlgError:
                found[:] = math.nan
            if not np.isfinite(found).all():  # a film's forces beyond all numbers: it says so
                found[:] = 0.0
                break
        self._data.SetTime(now)
        return found[:, 0], found[:, 1]
