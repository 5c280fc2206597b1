"""The error of one step over the allowed one; compiled like the joints.

Bodies' velocities, clearance joints' eccentricities and first-order coordinates; 1 is what a step
may miss, and `ErrorPerStep` says how much that is of the run's tolerance.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from exu_press.integrate.problem import FoundScales, Problem
from exu_press.integrate.settings import SAME, SolverTuning, Task, inertia_factor
from exu_press.joints.joint import ClearanceJoint
from exu_press.numerics.linear import Equations

__all__ = ["BodyError", "ErrorPerStep", "FirstOrderError", "JointError", "StepError", "Turning"]

EPSILON = 1.1e-16
"""Last digit of a number, over it."""

LARGER = 4.0
"""Over the kinetic energy of a change, from where that of the filtered one is of last digits."""

LOOK_EVERY = 8
"""Steps after which turning velocities are looked at, as that takes half as long as a step."""

LATE = 0.99
"""Of the largest value of late, what is left of it after a step."""

LEAST_PENETRATION = 1e-3
"""Over the clearance, up to which a penetration counts as this."""


@dataclass(frozen=True)
class ErrorPerStep:
    """The relative error of a step with which the run's error is its tolerance.

    Generalized-alpha is of second order: its local error goes with h^3, and a run needs about
    tolerance^(-1/2) steps. So that the error of the whole run follows the tolerance, one step may
    have tolerance^(3/2). With clearance joints it may have a hundredth of the tolerance at least,
    as below 1e-4 impacts become no more.

    A run of many more steps adds more errors up: all of them where bodies vibrate and a phase
    drifts, so that a step may have less by how many steps of its size the run would take, over what
    is usual. First-order coordinates relax, and their errors are of either sign: the root of that.

    Attributes:
        whole: what a step may have in a run of a usual number of steps.
        shortest: step of such a run, s; 0.0 lets all steps have the whole.
    """

    whole: float
    shortest: float = 0.0

    @classmethod
    def of(
        cls, tolerance: float, duration: float, many_steps: float, impacts: bool
    ) -> "ErrorPerStep":
        """Return what the steps of a run may miss.

        Args:
            tolerance: of the run.
            duration: of the run, s.
            many_steps: times tolerance^(-1/2), the largest usual number of steps.
            impacts: whether there are clearance joints.
        """
        whole = math.pow(tolerance, 1.5)
        if impacts:
            return cls(max(whole, 1e-2 * tolerance))
        return cls(whole, duration * math.sqrt(tolerance) / many_steps)

    def at(self, step: float, most: float = math.inf) -> float:
        """Return what a step (s) may have of velocities.

        Args:
            step: s.
            most: to which the errors of all steps can add up, over what the run may have.
        """
        if step >= self.shortest:
            return self.whole
        return self.whole * min(1.0, max(step / self.shortest, 1.0 / most))

    def relaxing(self, step: float) -> float:
        """Return what a step (s) may have of first-order coordinates."""
        return math.sqrt(self.whole * self.at(step))


class Turning:
    """The angle by which a body's velocity turns to one side, as a crank's, until the run ends.

    What a speed is off by makes the place be off by more and more, unless the motion comes back, as
    a vibration does. After a turn by an angle, in radians, the velocity there is off by so many
    times the error of the speed. So speeds may be off by less, if velocities are to turn by more
    than a radian yet; what is off across the velocity turns with it, and adds up to nothing.

    The angle so far is that between velocity and acceleration over time, with its sign, in the
    kinetic norm; each instant counts with the square of the largest speed then, as what nearly
    rests has no direction. The velocities of Euler parameters turn by half of what the body does.
    """

    def __init__(self, problem: Problem, scales: FoundScales, duration: float, foreseen: float):
        """Follow the bodies of a system.

        Args:
            problem: what is solved.
            scales: of the motion.
            duration: of the run, s.
            foreseen: over the time so far, for how long the motion is believed to go on likewise.
        """
        self._state, self._scales = problem.current, scales
        self._duration, self._foreseen = duration, foreseen
        points = [(i, node) for i, node in enumerate(problem.nodes) if node.displacements]
        sizes = [node.size if node.quaternion else node.displacements for _, node in points]
        count, most = len(points), max(sizes, default=0)
        self._nodes = np.array([i for i, _ in points], dtype=int)
        self._places = np.zeros((count, most), dtype=int)  # of coordinates
        self._roots = np.zeros((count, most))  # of inertias
        for i, (_, node) in enumerate(points):
            places = range(node.start, node.start + sizes[i])
            self._places[i, : sizes[i]] = places
            self._roots[i, : sizes[i]] = [math.sqrt(scales.inertias[k]) for k in places]
        self._turned = np.zeros((count, most, most))  # times squares of speeds
        self._squares = 0.0  # of speeds, over time
        self._time = self._looked = 0.0
        self._steps = 0
        self._angle = 0.0

    def stepped(self, step: float) -> float:
        """Return the angle still to come, rad, after an accepted step (s)."""
        self._time += step
        self._steps += 1
        if len(self._nodes) and not self._steps % LOOK_EVERY:
            self._angle = self._look(self._time - self._looked)
            self._looked = self._time
        return self._angle

    def _look(self, span: float) -> float:
        """Return the angle still to come, rad, after a span of time (s) with these velocities."""
        masses = np.array(self._scales.masses)[self._nodes]
        weights = self._roots / np.sqrt(np.where(masses > 0.0, masses, math.inf))[:, None]
        speeds = weights * self._state.velocities[self._places]
        changes = weights * self._state.accelerations[self._places]
        self._squares += span * float(np.square(speeds).sum(axis=1).max())
        if self._squares == 0.0:
            return 0.0
        products = span * speeds[:, :, None] * changes[:, None, :]
        self._turned += products - products.transpose(0, 2, 1)
        turned = math.sqrt(0.5 * float(np.square(self._turned).sum(axis=(1, 2)).max()))
        rest = min(self._duration - self._time, self._foreseen * self._time)
        return max(0.0, rest) * turned / self._squares


class Quiet:
    """Velocity amplitude of a vibration of which each step misses the same, m/s.

    All errors that steps make of a vibration add up to no more than the vibration itself. One whose
    amplitude is below the tolerance need not be followed, however long it lasts; if what a step may
    have shrank with the step there, steps would shrink until they resolve it, a thousandfold.

    A vibration of the amplitude V and the angular frequency omega has the velocity's third
    derivative b = omega^3 V. Its change from step to step, over the step and over b, is omega, and
    2 / h where the step h is too long to tell. Both are the largest of late, as each is zero at
    times.
    """

    def __init__(self, scales: FoundScales) -> None:
        """Take the scales of the motion."""
        self._scales = scales
        self._before: list[float] = []
        self._size = self._rate = 0.0
        self._tried: tuple[list[float], float, float] = [], 0.0, 0.0

    def amplitude(self, change: list[float], step: float) -> float:
        """Return it, or infinity where it is not known yet.

        Args:
            change: of the accelerations' rate within a step, in SI over seconds.
            step: s.
        """
        bend = [value / step for value in change]
        size = max(self._scales.norm(bend), LATE * self._size)
        rate = 0.0
        if self._before:
            turn = [a - b for a, b in zip(bend, self._before, strict=True)]
            rate = max(self._scales.norm(turn) / step, LATE * self._rate)
        self._tried = bend, size, rate
        if rate <= 0.0:
            return math.inf
        omega = min(rate / size, 2.0 / step)
        return size / (omega * omega * omega)

    def accept(self) -> None:
        """Remember the step last tried."""
        self._before, self._size, self._rate = self._tried


class BodyError:
    """Tells from the accelerations at three instants what a step missed; 1 is what it may.

    h^3 |second derivative of the acceleration| / 6 against what velocities may be off by; the
    largest of all bodies, in the kinetic norm sqrt(|dx|^2 + (J/m) dphi^2).

    Attributes:
        change: of the accelerations' rate, by the step last tried, in SI over seconds.
        rate: of the accelerations' change, in the step last tried.
        turning: angle by which velocities are to turn yet, rad: `Turning`.
        velocities: of all coordinates, where they are to turn by more than a radian.
    """

    def __init__(
        self,
        accelerations: list[float],
        per_step: ErrorPerStep,
        scales: FoundScales,
        tuning: SolverTuning,
        noise: float,
        tolerance: float = 1.0,
        absolute: float = 0.0,
    ) -> None:
        """Take the bodies and the scales.

        Args:
            accelerations: of all coordinates, at the beginning of the first step.
            per_step: what a velocity may be off by in one step, over the scale of speeds.
            scales: of the motion, which knows the bodies.
            tuning: numbers.
            noise: what rounded positions make of accelerations, times the step's square, m.
            tolerance: of the run.
            absolute: errors of velocities below it do not count, m/s.
        """
        self._scales, self._per_step, self._tolerance = scales, per_step, tolerance
        self._absolute = absolute
        self._noise = noise
        self._constant = tuning.velocity_constant
        self._before = self._now = accelerations
        self._rate_before: list[float] = []  # none before the first step
        self.rate: list[float] = []
        self.change: list[float] = []
        self.turning = 0.0
        self.velocities: list[float] = []
        self._bend: list[float] = []  # second derivative of the accelerations
        self._bend_before: list[float] = []
        self._size = self._size_before = 0.0  # of the bend, its largest norm
        self._common = self._common_before = 0.0  # of the bends of two steps, likewise
        self._step = self._step_before = 0.0
        self._most = scales.norm(accelerations)  # so far, m/s^2
        self._quiet = Quiet(scales)
        self._share = math.inf  # of what errors can add up to, over what the run may have

    def tried(self, now: list[float], step: float) -> float:
        """Return the error of a step (s) that ends with these accelerations."""
        self._now = now
        before, last = self._before, self._rate_before
        self.rate = rate = [(now[i] - before[i]) / step for i in range(len(now))]
        if last:
            self.change = [rate[i] - last[i] for i in range(len(rate))]
        else:
            part = step * self._part_changed(rate)
            self.change = [part * value for value in rate]
        if last and step < self._per_step.shortest:
            allowed = self._tolerance * self._scales.speed
            if allowed > 0.0:
                self._share = self._quiet.amplitude(self.change, step) / allowed
        return self.error(self.change, step)

    def _part_changed(self, rate: list[float]) -> float:
        """Return the rate of the accelerations, in the first step, over them: at most one a step.

        What it changes by within the step is not known yet: as much as the accelerations do.
        """
        change, largest = self._scales.norm(rate), self.largest()
        return change / largest if change > 0.0 else 0.0

    def error(self, change: list[float], step: float, left: float = 0.0) -> float:
        """Return the error that goes with a change of the accelerations' rate.

        Args:
            change: in SI over seconds.
            step: s.
            left: what its constraints leave open of positions, m.
        """
        noise = max(self._noise, left)
        missed = self._constant * step * step
        error = missed * self._scales.norm(change) / self._limit(step, noise, 1.0)
        if self.turning > 1.0:
            along = self._scales.along(change, self.velocities)
            error = max(error, missed * along / self._limit(step, noise, self.turning))
        return error

    def of_positions(self, rate: list[float], step: float) -> float:
        """Return the error that goes with positions, where constraints take that of velocities.

        On a circle the third derivative of the velocity points to the centre, and the constraint
        takes it away; but positions miss h^3 |da/dt| / 6 along the circle, and the velocity there
        changes by its acceleration over its speed.

        Args:
            rate: of the accelerations' change, in SI over seconds.
            step: s.
        """
        missed = self._constant * step * step * step * self._scales.norm(rate)
        per_length = self.largest() / self._scales.speed
        return missed * per_length / self._limit(step, self._noise, 1.0)

    def _limit(self, step: float, noise: float, grows: float) -> float:
        """Return what a velocity may be off by in a step (s), m/s, if that grows by a factor."""
        whole = self._per_step.at(step, self._share) * self._scales.speed
        return max(whole / grows, self._constant * noise / step)

    def of_jump(self) -> float:
        """Return the largest change of an acceleration in the step last tried, m/s^2."""
        return self._scales.norm([a - b for a, b in zip(self._now, self._before, strict=True)])

    def largest(self) -> float:
        """Return the largest acceleration at the two ends of the step last tried, m/s^2."""
        return max(self._scales.norm(self._now), self._scales.norm(self._before))

    def offset(self, step: float) -> float:
        """Return what velocities that constraints prescribe are off by at each instant, m/s.

        They follow from two positions: h^2 |rate of the acceleration| / 12, if that is more than
        what alternates because positions are rounded.
        """
        off = step * step * self._scales.norm(self.rate) / 12.0
        return off if off > self._noise / (6.0 * step) else 0.0

    def curvature(self, step: float, tolerance: float) -> float:
        """Return what accelerations are off a line between a step's ends, over what they may.

        That is a tolerance of the largest, or what changes no velocity within the step by more than
        the absolute tolerance. What alternates from step to step is none of the
        motion's, and a jump does not shrink with the step: what two steps of one size have in
        common counts, and in a step of another size what the last two had.
        """
        self._bend = bend = [value / step for value in self.change]
        self._size, self._step = self._scales.norm(bend), step
        self._common = self._common_before
        if self._bend_before and abs(step - self._step_before) < SAME * step:
            mean = [0.5 * (a + b) for a, b in zip(bend, self._bend_before, strict=True)]
            smaller = min(self._size, self._size_before)
            self._common = min(self._scales.norm(mean), 3.0 * smaller)
        off = 0.125 * step * step * self._common
        allowed = max(tolerance * self._most, self._absolute / step)
        return off / max(allowed, self._noise / (step * step))

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        if self._bend:  # they are asked for
            self._step_before, self._common_before = self._step, self._common
            self._size_before = self._size
            self._bend_before = self._bend if self._rate_before else []
            self._most = max(self._most, self._scales.norm(self._now))
        self._before, self._rate_before = self._now, self.rate
        self._quiet.accept()


class JointError:
    """The eccentricity's error of one clearance joint: its way less that of its velocities.

    See `exu_press.joints.path`. Where surfaces touch, its part across them is an error of the
    penetration, and held against that too.
    """

    def __init__(
        self,
        joint: ClearanceJoint,
        limit: float,
        drift: float,
        rounding: float,
        penetration: float,
    ) -> None:
        """Take a joint and its scales.

        Args:
            joint: whose eccentricity is looked at.
            limit: the error of a step that counts as 1, m.
            drift: the same over the step, m/s, where a film alone lies between the surfaces: it
                keeps what each step leaves, always on the same side, so that errors add up.
            rounding: of positions, as it alternates, m; no error below it counts as 1.
            penetration: what that may be off by, over itself, as a part of the same of an
                eccentricity, over the clearance.
        """
        self._joint = joint
        self._penetration = penetration
        self._limit = limit
        self._rounding = rounding
        self._drift = drift if joint.contact_onset == math.inf else math.inf

    def error(self, step: float, left: float = 0.0) -> float:
        """Return the error of a step (s) that ends where the joint was last asked for its force.

        Args:
            step: s.
            left: what its constraints leave open of positions, m.
        """
        joint, rounding = self._joint, max(self._rounding, left)
        place = joint.eccentricity
        missed, along = joint.path.missed(place, joint.relative_velocity, step)
        error = missed / max(min(self._limit, self._drift * step), rounding)
        depth = math.hypot(*place) - joint.contact_onset
        if depth > 0.0:
            relative = max(LEAST_PENETRATION, self._penetration * depth / joint.clearance)
            error = max(error, abs(along) / max(relative * self._limit, rounding))
        return error


class FirstOrderError:
    """The error of the trapezoidal rule: h^3 |y'''| / 12, over each coordinate's largest value."""

    def __init__(self, problem: Problem, per_step: ErrorPerStep) -> None:
        """Take what is solved, and what one step may miss, relative."""
        self._current, self._per_step = problem.current, per_step
        self._before = np.array(problem.start.rates)
        self._largest = np.abs(problem.start.first_order)
        self._change: Any = None  # of the rate, over the step, in the step before
        self._tried: tuple[Any, Any] = self._before, None

    def error(self, step: float) -> float:
        """Return the error of a step (s) that ends in the current state."""
        rate = np.array(self._current.rates)
        change = (rate - self._before) / step
        self._tried = rate, change
        if self._change is None:
            return 0.0
        missed = step * step * np.abs(change - self._change) / 12.0
        largest = np.maximum(self._largest, step * np.abs(rate))
        counts = largest > 0.0
        relative = float((missed[counts] / largest[counts]).max(initial=0.0))
        return relative / self._per_step.relaxing(step)

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        self._before, self._change = self._tried
        self._largest = np.maximum(self._largest, np.abs(self._current.first_order))


class StepError:
    """Estimates the error of the step just tried; 1 is what one step may have.

    Velocities, against the scale of speeds: `BodyError`;
    first-order coordinates likewise, against their largest values: `FirstOrderError`. Where
    that is too much, what counts is the part that Newton's matrix lets through: constraints, films
    and contacts undo the rest within the step (L. F. Shampine's filter for stiff systems, see
    Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8). Without films and contacts
    also velocities that follow from constraints, at each instant against the tolerance itself. What
    rounding moves in an equilibrium is no error.

    Clearance joints: what the eccentricity changes by, less the integral of its rate, against the
    joint's clearance and penetration, in films against the clearance and the time: `JointError`.

    Attributes:
        start: accelerations of all coordinates at the run's start, where they are not Exudyn's.
        limiting: in how many tries each clearance joint had the largest error.
    """

    def __init__(self, task: Task) -> None:
        """Look at what is solved."""
        problem, tolerance, tuning = task.problem, task.tolerance, task.tuning
        self._task, self._solver, self._scales = task, task.solver, task.scales
        self._velocities = problem.current.velocities
        self._accelerations = problem.current.accelerations
        self._tolerance, self._switching = tolerance, problem.switching
        duration, impacts = task.end - task.start, problem.joints is not None
        self._per_step = ErrorPerStep.of(tolerance, duration, tuning.many_steps, impacts)
        self.start: list[float] = []
        self._bodies: BodyError | None = None
        self._turning: Turning | None = None
        self._step = 0.0  # last tried, s
        self._first_order: FirstOrderError | None = None
        self._joints: list[JointError] = []
        self.limiting: list[int] = []

    def __call__(self, step: float) -> float:
        """Return the error of the step (s) that ends in the current state."""
        if self._bodies is None:
            self._bodies = self._first_look()
        self._step = step
        bodies, scales, now = self._bodies, self._scales, self._accelerations.tolist()
        still = scales.resting and scales.still(self._velocities.tolist())
        if scales.resting and not still:
            scales.set_out(self._velocities.tolist(), now)
        if bodies.turning > 1.0:
            bodies.velocities = self._velocities.tolist()
        error, left = bodies.tried(now, step), 0.0
        if still:
            error = 0.0
        elif error > 1.0:
            if self._turning is None:
                (change,) = self._filtered(bodies.change)
                error = bodies.error(change, step)
            else:
                change, rate = self._filtered(bodies.change, bodies.rate)
                error = max(bodies.error(change, step), bodies.of_positions(rate, step))
            if error > 1.0 and self._joints:
                left = self._left_in_constraints()
                error = bodies.error(change, step, left)
        if not (still or self._joints):  # whose impacts and films need finer steps, by far
            offset = self._relative(bodies.offset(step))
            if not self._switching:  # whose accelerations jump
                offset = max(offset, bodies.curvature(step, self._tolerance))
            error = max(error, math.pow(offset, 1.5))  # as the step's cube
        if self._first_order is not None:
            error = max(error, self._first_order.error(step))
        if self._switching:
            error = max(error, self.of_switch(step))
        largest = -1
        for number, joint in enumerate(self._joints):
            found = joint.error(step)
            if found > 1.0:
                left = left or self._left_in_constraints()
                found = joint.error(step, left)
            if found > error:
                error, largest = found, number
        if largest >= 0:
            self.limiting[largest] += 1
        return error

    def of_switch(self, step: float) -> float:
        """Return the error of a step in which Exudyn's contacts or friction have switched.

        The switch lies anywhere in the step, and its force is at most about as large as what the
        accelerations show: half of it acted too long. As switches are few, that is held against
        the tolerance itself.
        """
        if self._bodies is None or not self._solver.it.discontinuousIteration:
            return 0.0
        return self._relative(0.5 * step * self._bodies.largest())

    def of_jump(self, step: float) -> float:
        """Return the error if a jump of the accelerations lies in the step just tried.

        However short the step, it is then of first order; at most half of the jump times the step,
        which is held against the tolerance itself as jumps are few.
        """
        return 0.0 if self._bodies is None else self._relative(0.5 * step * self._bodies.of_jump())

    def change_of_speed(self) -> float:
        """Return what a jump of accelerations in the step last tried changes a speed by, m/s."""
        return 0.0 if self._bodies is None else self._step * self._bodies.of_jump()

    def accept(self) -> None:
        """Remember the accepted step's end as the next one's beginning."""
        assert self._bodies is not None
        self._bodies.accept()
        if self._turning is not None:
            self._bodies.turning = self._turning.stepped(self._step)
        if not self._scales.fixed:
            self._scales.update(self._velocities.tolist(), self._accelerations.tolist())
        if self._first_order is not None:
            self._first_order.accept()

    def _relative(self, speed: float) -> float:
        """Return an error of a speed (m/s) over what the run may have of it."""
        allowed = self._tolerance * self._scales.speed
        return speed / allowed if allowed > 0.0 else 0.0

    def _first_look(self) -> BodyError:
        """Return the bodies' errors from the first step's beginning on; look at the rest too."""
        task, problem, tuning = self._task, self._task.problem, self._task.tuning
        noise = self._scales.alternating(tuning.rounding, self._solver.alphaF)
        if len(problem.start.rates):
            self._first_order = FirstOrderError(problem, self._per_step)
        per_step = self._per_step
        if problem.joints is None:
            duration = task.end - task.start
            self._turning = Turning(problem, self._scales, duration, tuning.foreseen)
        else:
            whole = self._per_step.whole
            of_bodies, penetration = tuning.beside_joints * whole, tuning.penetration
            if problem.modes and tuning.modal_mass > 0.0:
                of_bodies = tuning.vibrating * self._tolerance
                penetration = tuning.vibrating_penetration
            per_step = ErrorPerStep(of_bodies)
            per_time = task.tolerance / (tuning.kept_steps * task.usual)
            self._joints = [
                JointError(j, whole * j.clearance, per_time * j.clearance, noise, penetration)
                for j in problem.joints.joints
            ]
            self.limiting = [0] * len(self._joints)
        start = self.start or problem.start.accelerations.tolist()
        return BodyError(
            start, per_step, self._scales, tuning, noise, self._tolerance, task.absolute
        )

    def _left_in_constraints(self) -> float:
        """Return how far the last digits of constraints move a body, m.

        By far where a mechanism passes a position in which two of them nearly say the same.
        """
        jacobian = np.asarray(self._solver.GetSystemJacobian())
        size, count = len(self._accelerations), self._solver.GetAEsize()
        of_constraints = np.eye(len(jacobian), count, count - len(jacobian))
        try:
            moved = np.abs(Equations(jacobian).solve(of_constraints)[:size]).sum(axis=1)
        except np.linalg.LinAlgError:  # constraints that say the same
            return 0.0
        return EPSILON * self._scales.length * self._scales.norm(moved.tolist())

    def _filtered(self, *changes: list[float]) -> list[list[float]]:
        """Return what Newton's matrix, M (1 - alpha_m)/(1 - alpha_f) + ..., leaves of changes."""
        solver = self._solver
        before, mass = np.array(changes).T, solver.GetSystemMassMatrix()
        jacobian, size = np.asarray(solver.GetSystemJacobian()), len(before)
        right = np.zeros((len(jacobian), len(changes)))
        right[:size] = np.dot(mass, before) * inertia_factor(solver)
        try:
            filtered = Equations(jacobian).solve(right)[:size]
            if not self._joints and _larger(filtered, before, mass):
                # masses and springs make nothing larger, but constraints that nearly say the same
                filtered = np.linalg.lstsq(jacobian, right, rcond=None)[0][:size]
        except np.linalg.LinAlgError:  # constraints that say the same
            return list(changes)
        found: list[list[float]] = filtered.T.tolist()
        return found


def _larger(after: Any, before: Any, mass: Any) -> bool:
    """Return whether changes, (n, k), have far more kinetic energy than before, if any."""
    energies = [float(np.sum(changes * np.dot(mass, changes))) for changes in (after, before)]
    return not energies[0] <= LARGER * energies[1]
