"""Correction of generalized-alpha's memory from step to step, where the step changes."""

from collections.abc import Callable

import numpy as np

from exu_press.integrate.constraints import Constraints, normalise
from exu_press.integrate.task import SAME, Task, inertia_factor
from exu_press.numerics.arrays import Array

__all__ = ["VariableStepCorrection"]

RESISTANCE = 0.999
"""Part of the masses' resistance to a change that forces have too, but for rounding."""

ITERATIONS = 3
"""Of the projection; each leaves some hundredths."""

DIVERGED = 10.0
"""Change over the first one, where iterations lead away from the constraints."""


class VariableStepCorrection:
    """Carries generalized-alpha over a change of step without ringing.

    With steps of one size h generalized-alpha settles on offsets that belong to h: its algorithmic
    acceleration is the true one at another instant, a_alg - a = h (alpha_m - alpha_f) da/dt, and
    constrained velocities miss the constraints by an amount of order h^2. A much shorter step
    answers both, and what Newton's method left of the positions' constraints, with accelerations
    that alternate for a dozen steps. So the first is scaled by the ratio of the steps, the second
    by its square, unless that would be rounding, and the third is taken away.

    Without clearance joints motion is smooth, and steps change seldom. With them steps change all
    the time, and to fit velocities costs as much as a step: it is done once steps have shrunk to a
    third. A longer step is left alone there: scaling up would blow up what an impact left ringing.

    Exudyn's algorithmic acceleration can be read but not written, and keeps the value of a failed
    try. But positions, velocities and accelerations at the step's beginning can be shifted so that
    the step comes out as if it had been changed. At rest a film carries nothing, and takes up its
    load within a microsecond: Exudyn's accelerations are wrong then. What the first step changes
    the velocities by is right; so the step is repeated from that.

    Source: M. Arnold and O. Bruels, Convergence of the generalized-alpha scheme for constrained
    mechanical systems, Multibody System Dynamics 18 (2007), Eqs. 2 and 3, and its remarks on the
    hidden constraints.
    """

    def __init__(self, task: Task, constraints: Constraints) -> None:
        """Watch the steps of a system that has these constraints."""
        system = task.system
        self._smooth = system.joints is None  # and steps change seldom
        self._film_waits = system.has_film
        self._refit, self._look_ahead = task.tuning.refit, task.tuning.look_ahead
        self._task, self._solver, self._constraints = task, task.solver, constraints
        self._data, self._current, self._at_start = system.data, system.current, system.start
        self._now, self._start_state = self._current.motion(), self._at_start.motion()
        self._start: float | None = None  # of the step under way, s
        self._last: float | None = None  # size of the last accepted step, s
        self._fits = self._leaves = 0.0  # the step that constrained velocities fit, now and next
        # alpha_m, alpha_f, beta and gamma, which the solver has from its first step on
        self._method: tuple[float, float, float, float] | None = None
        self._state: list[list[float]] = []  # at the step's beginning, before any shift
        # of it: what constraints forbid of positions and velocities
        self._offsets: list[list[float]] | None = None
        self._ahead = 0.0  # how far ahead rates were looked for there, s
        self._mean: list[float] | None = None  # acceleration of the first step
        # accelerations at the start, and what of their rate constraints prescribe
        self._initial: tuple[list[float], list[float]] | None = None

    def repeats_from_mean(self, step: float) -> bool:
        """Return whether a step (s) is to be repeated from its own mean acceleration.

        The first one is, once, where a film takes up its load. To be asked after it was tried.
        """
        if not self._film_waits:
            return False
        self._film_waits = False
        self._mean = ((self._current.velocities - self._at_start.velocities) / step).tolist()
        return True

    def start_from(self, accelerations: Array, rate: Array) -> None:
        """Let the first step have the offsets on which further ones settle, by a start's rates."""
        self._initial = accelerations.tolist(), rate.tolist()

    def before_try(self, start: float, step: float) -> None:
        """Shift the state from which Exudyn is about to try a step (s) from a start (s)."""
        repeated = start == self._start
        if not repeated:
            self._last = None if self._start is None else start - self._start
            self._fits = max(self._leaves, self._last or 0.0)
            self._start, self._state, self._offsets = start, [], None
        self._leaves = self._fits
        ratio = 1.0 if self._last is None else step / self._last
        if not self._smooth or (ratio > 1.0 and self._is_roundoff(ratio)):
            ratio = min(1.0, ratio)
        first = self._last is None and self._initial is not None
        if repeated or first or abs(ratio - 1.0) > SAME:
            self._shift(step, ratio)

    def _is_roundoff(self, ratio: float) -> bool:
        """Return whether the last step's offsets, scaled up by this ratio, would be rounding."""
        if self._task.fixed:
            return False
        assert self._last is not None
        scales = self._task.scales
        error = ratio * ratio * scales.roundoff / self._last
        return error > self._task.tolerance * scales.speed

    def _shift(self, step: float, ratio: float) -> None:
        """Shift positions, velocities and accelerations for a step `ratio` times the last one.

        Newton's method may start anew, from what Exudyn keeps of the step's beginning; so that is
        shifted as well, by what is missing there.
        """
        solver = self._solver
        if not self._state:
            self._state = [floats.read() for floats in self._start_state]
        q, v, a = self._state
        if abs(ratio - 1.0) > SAME and (self._smooth or step / self._fits < self._refit):
            self._leaves = step
            if self._constraints.count:
                q, v = self._fitted_to_constraints(step)
        at_start: list[float] = solver.GetStartOfStepStateAAlgorithmic().tolist()
        algorithmic = [a[i] + ratio * (at_start[i] - a[i]) for i in range(len(a))]
        if self._method is None:
            self._method = solver.alphaM, solver.alphaF, solver.newmarkBeta, solver.newmarkGamma
        alpha_m, alpha_f, beta, gamma = self._method
        if self._last is None and self._mean is not None:
            a = algorithmic = self._mean
        elif self._last is None and self._initial is not None:
            a, rate = self._initial
            settled = alpha_m - alpha_f
            by_a, by_v = settled * step, (1.0 / 6.0 - beta - 0.5 * settled) * step * step
            algorithmic = [a[i] + by_a * rate[i] for i in range(len(a))]
            v = [v[i] + by_v * rate[i] for i in range(len(v))]
        # q1 = q + h v + h^2 (1/2 - beta) a + h^2 beta a1 and v1 = v + h (1 - gamma) a + h gamma a1
        # with (1 - alpha_m) a1 + alpha_m a = (1 - alpha_f) a_true1 + alpha_f a_true
        by = step * step * (gamma - 0.5 - beta), step * (1.0 - gamma), -alpha_m / alpha_f
        shifted = [q, v, a]
        now: list[float] = solver.GetAAlgorithmic().tolist()
        for state, there in ((self._now, now), (self._start_state, at_start)):
            change = [algorithmic[i] - there[i] for i in range(len(there))]
            for k in range(3):
                values, factor = shifted[k], by[k]
                state[k].write([values[i] + factor * change[i] for i in range(len(change))])

    def _fitted_to_constraints(self, step: float) -> tuple[list[float], list[float]]:
        """Return positions and velocities at the beginning of a step (s) that fit to its size."""
        differenced = self._constraints.rates_not_provided
        if self._offsets is None or (differenced and step < self._ahead):
            self._ahead = self._look_ahead * min(step, self._fits)
            self._offsets = self._violations().tolist()
        (q, v, _), (of_q, of_v), fraction = self._state, self._offsets, step / self._fits
        too_much = 1.0 - fraction * fraction
        fitted_q = [q[i] - of_q[i] for i in range(len(q))]
        return fitted_q, [v[i] - too_much * of_v[i] for i in range(len(v))]

    def _violations(self) -> Array:
        """Return what of positions and velocities constraints forbid, (2, n), in Newton's norm.

        The least change in the norm of the last Jacobian, as in an iteration of Newton's method: in
        that of masses alone a journal was moved in its film by 1e-5 m/s, which it answered with
        2.4 kN. But a contact that lets go may give way to a change, so that a large one costs
        nothing: where masses alone resist more, they count.
        """
        solver, size = self._solver, len(self._current.positions)
        jacobian, state = np.asarray(solver.GetSystemJacobian()), np.array(self._state)
        directions, lengths = normalise(jacobian[-self._constraints.count :, :size])
        forces = jacobian[:size, :size]
        inertia = inertia_factor(solver) * solver.GetSystemMassMatrix()
        project = self._constraints.projection(0.5 * (forces + forces.T), directions)
        changes = self._least(project, lengths, state)
        for change in changes:
            if change @ forces @ change < RESISTANCE * (change @ inertia @ change):
                project = self._constraints.projection(inertia, directions)
                return self._least(project, lengths, state)
        return changes

    def _least(self, project: Callable[[Array], Array], lengths: Array, state: Array) -> Array:
        """Return the least changes of positions and velocities that constraints ask for, (2, n).

        Directions, which had these lengths (count,), are those of the last Jacobian; violations are
        those of the state (3, n) at the step's beginning: a few iterations lead to it.
        """
        position, velocity = self._current.positions, self._current.velocities
        now = self._data.GetTime()
        self._data.SetTime(self._start)
        changes, violations = np.zeros((len(position), 2)), np.zeros((len(lengths), 2))
        largest = []  # change of positions and velocities, turn by turn
        for _ in range(ITERATIONS):
            position[:], velocity[:] = state[:2] - changes.T
            violations[:, 0] = self._constraints.violations()
            violations[:, 1] = self._constraints.violation_rates(self._ahead)
            violations /= lengths[:, None]
            same = violations[:, :1] == violations[:, 1:]
            # prescribed speeds are no places, and are met as they are
            np.copyto(violations, 0.0, where=same)
            changes += project(violations)
            largest.append(np.abs(changes).max(axis=0))
        # where directions have turned too far to lead there, or forces are beyond all numbers
        changes[:, ~(largest[-1] <= DIVERGED * largest[0])] = 0.0
        self._data.SetTime(now)
        return changes.T
