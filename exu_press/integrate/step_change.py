"""Carry generalized-alpha over a change of step without ringing.

With steps of one size h generalized-alpha settles on offsets that belong to h: its algorithmic
acceleration a is the true one at another instant, a - a_true = h (alpha_m - alpha_f) da_true/dt,
and where positions are constrained the velocities miss the constraints by an amount of order h^2.
A much shorter step takes both for errors and answers with accelerations that alternate for a dozen
steps, larger than the motion's own changes. Scaled to the new step, by its ratio to the old one and
by that ratio's square, both fit at once; the latter costs as much as a step. Likewise what Newton's
method left of the positions' constraints, 1e-10 m, is nothing beside a long step but a jolt beside
a short one: it is taken away.

Without films and contacts motion is smooth, steps change seldom, and each change is worth this.
With them steps change all the time: velocities are fitted once steps have shrunk to a third, and a
longer step, which has little to make of either, is left alone: scaling up would blow up whatever an
impact or a film's start left ringing.

Exudyn's algorithmic acceleration can be read but not written, and when a step is repeated it keeps
the value of the failed try. But positions, velocities and accelerations at the step's beginning can
be shifted so that the step comes out as if it had been changed.

At rest a film carries nothing, and within a microsecond or less it takes up its load: the
accelerations with which Exudyn starts are then wrong at once, and ring. What the first step changes
the velocities by is right, as a film answers to velocities; so the step is repeated from that.

Source: M. Arnold and O. Bruels, Convergence of the generalized-alpha scheme for constrained
mechanical systems, Multibody System Dynamics 18 (2007), Eqs. 2 and 3, and its remarks on the
hidden constraints.
"""

from typing import Any

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exu_press.integrate.constraints import Constraints
from exu_press.integrate.tuning import Tuning

__all__ = ["StepChange"]

Array = NDArray[np.float64]

AHEAD = 1.0 / 64.0
"""Of a step: near enough to tell velocities from positions, far enough for rounded ones."""

CURRENT = exu.ConfigurationType.Current
START = exu.ConfigurationType.StartOfStep

SAME = 1e-6
"""Steps that differ by less, relative, are one size: the clock's last digits."""


class StepChange:
    """Fits the state at a step's beginning to the step, if that is another or repeated."""

    def __init__(
        self,
        mbs: exu.MainSystem,
        solver: Any,
        constraints: Constraints,
        smooth: bool,
        tuning: Tuning,
    ) -> None:
        """Watch the steps of a system.

        Args:
            mbs: the system.
            solver: an exu.MainSolverImplicitSecondOrder, which is about to solve it.
            constraints: of the system.
            smooth: whether there is neither a film nor a contact.
            tuning: numbers.
        """
        self._smooth = smooth
        self._refit = tuning.refit
        self._iterations = tuning.constraint_iterations
        self._solver, self._constraints = solver, constraints
        self._data: Any = mbs.systemData
        self._start: float | None = None  # of the step under way, s
        self._last: float | None = None  # size of the last accepted step, s
        self._fits = self._leaves = 0.0  # the step that constrained velocities fit, now and next
        self._state: list[Array] | None = None  # at the step's beginning, before any shift
        self._offsets: tuple[Array, Array] | None = None
        self._mean: Array | None = None  # acceleration of the first step
        # accelerations at the start, and what of their rate constraints prescribe
        self._given: tuple[Array, Array] | None = None

    def start_over(self, time: float) -> bool:
        """Return whether the first step is to be repeated, from its own mean acceleration.

        To be asked after the try of a step to `time`, s, where a film takes up its load.
        """
        if self._last is not None or self._mean is not None or self._start is None:
            return False
        (_, now, _), (_, before, _) = self._views(CURRENT), self._views(START)
        self._mean = np.asarray((now - before) / (time - self._start))
        return True

    def start_from(self, accelerations: Array, rate: Array) -> None:
        """Let the first step start with the offsets on which further ones would settle.

        Args:
            accelerations: at the start.
            rate: what constraints prescribe of their rate of change.
        """
        self._given = accelerations, rate

    def before_try(self, time: float) -> None:
        """Shift the state from which Exudyn is about to try a step to `time`, s."""
        start = self._data.GetTime(START)
        repeated = start == self._start
        if not repeated:
            self._last = None if self._start is None else start - self._start
            self._fits = max(self._leaves, self._last or 0.0)
            self._start, self._state, self._offsets = start, None, None
        self._leaves = self._fits
        step = time - start
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
        solver = self._solver
        if self._state is None:
            self._state = [np.array(view) for view in self._views(START)]
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
        for where, there in ((CURRENT, solver.GetAAlgorithmic()), (START, at_start)):
            missing = wanted - there
            shifted = (
                q + step * step * (gamma - 0.5 - beta) * missing,
                v + step * (1.0 - gamma) * missing,
                a - (solver.alphaM / solver.alphaF) * missing,
            )
            for view, value in zip(self._views(where), shifted, strict=True):
                view[:] = value

    def _views(self, where: exu.ConfigurationType) -> tuple[Any, Any, Any]:
        """Return positions, velocities and accelerations as Exudyn holds them."""
        data = self._data
        return (
            data.GetODE2Coordinates(where, False),
            data.GetODE2Coordinates_t(where, False),
            data.GetODE2Coordinates_tt(where, False),
        )

    def _violations(self) -> tuple[Array, Array]:
        """Return what of positions and velocities the constraints forbid, in the kinetic norm.

        The directions in which constraints act are those of the last Jacobian, perhaps a degree of
        the crank away; how far they are violated is of this very state, so a few turns lead to it.
        """
        assert self._state is not None
        solver = self._solver
        mass = np.asarray(solver.GetSystemMassMatrix())
        size, count = len(mass), self._constraints.count
        if count == 0:
            return np.zeros(size), np.zeros(size)
        directions = np.asarray(solver.GetSystemJacobian())[-count:, :size]
        # Newton's matrix has those of velocities over the step
        lengths = np.sqrt(np.square(directions).sum(axis=1))
        lengths[lengths == 0.0] = 1.0
        matrix = self._constraints.matrix(mass, directions / lengths[:, None])
        position, velocity, _ = self._views(CURRENT)
        now = self._data.GetTime()
        self._data.SetTime(self._start)
        found, violated = np.zeros((size, 2)), np.zeros((size + count, 2))
        for _ in range(self._iterations):
            position[:] = self._state[0] - found[:, 0]
            velocity[:] = self._state[1] - found[:, 1]
            violated[size:, 0] = self._constraints.violated()
            violated[size:, 1] = self._constraints.violated_rates(AHEAD * self._fits)
            violated[size:] /= lengths[:, None]
            same = violated[:, 0] == violated[:, 1]
            violated[same] = 0.0  # prescribed speeds are no places, and are met as they are
            found += np.linalg.solve(matrix, violated)[:size]
        self._data.SetTime(now)
        return found[:, 0], found[:, 1]
