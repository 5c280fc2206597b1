"""The error of one step over the allowed one; compiled like the joints.

Each criterion is a class of `exu_press.integrate.criteria`. With the step h, accelerations a, their
rate j_n = (a_n - a_(n-1)) / h, the scale of speeds V, eccentricities e and the clearance c::

    velocities                         h^2 |j_n - j_(n-1)| / 6    over share V      BodyError
    of a vibration, over its cycle     the largest of late        over share V      Envelope
    positions along constraints        h^3 |j_n| / 6, by |a| / V  over share V      BodyError
    velocities as prescribed           h^2 |j_n| / 12             over tol V        BodyError
    accelerations between two instants h |j_n - j_(n-1)| / 8      over tol |a|      Curvature
    first-order coordinates            h^3 |y_ttt| / 12           over share |y|    FirstOrderError
    eccentricities                     e less the integral of e_t over share c      JointError
    penetrations                       the same across surfaces   over a part of it JointError
    forces of films that turn          |F| (turned angle)^2 / 8   over tol |F|      TurningForce
    switches of Exudyn's contacts      h |a| / 2                  over tol V        StepError

The share of the tolerance is that of `ErrorPerStep`; 1 is what a step may miss.
"""

import math

from exu_press.integrate.contact import Settling
from exu_press.integrate.criteria.bodies import BodyError
from exu_press.integrate.criteria.curvature import Curvature
from exu_press.integrate.criteria.eccentricity import JointError
from exu_press.integrate.criteria.first_order import FirstOrderError
from exu_press.integrate.criteria.newton_matrix import NewtonMatrix
from exu_press.integrate.criteria.share import ErrorPerStep
from exu_press.integrate.criteria.turning import Turning
from exu_press.integrate.criteria.turning_force import TurningForce
from exu_press.integrate.criteria.vibration import Envelope
from exu_press.integrate.settings import Task

__all__ = ["StepError"]

TURNS_BY_ROUNDING = 10.0
"""Over the smallest step: in shorter ones rounding turns the forces of films."""


class StepError:
    """Estimates the error of the step just tried; 1 is what one step may have.

    Velocities, against the scale of speeds: `BodyError`;
    first-order coordinates likewise, against their largest values: `FirstOrderError`. Where
    that is too much, what counts is the part that Newton's matrix lets through: constraints, films
    and contacts undo the rest within the step (L. F. Shampine's filter for stiff systems, see
    Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8). Without films and contacts
    also velocities that follow from constraints, at each instant against the tolerance itself, and
    of vibrations the largest error of late: `Envelope`. What
    rounding moves in an equilibrium is no error: it is told from a motion as small by errors that
    do not shrink with the step.

    Clearance joints: what the eccentricity changes by, less the integral of its rate, against the
    joint's clearance and penetration, in films against the clearance and the time: `JointError`;
    and what a film's force is off a line while it turns: `TurningForce`.

    Attributes:
        start: accelerations of all coordinates at the run's start, where they are not Exudyn's.
        limiting: in how many tries each clearance joint had the largest error.
    """

    def __init__(self, task: Task, settling: Settling) -> None:
        """Look at what is solved, and at switches that do not settle."""
        problem, tolerance, tuning = task.problem, task.tolerance, task.tuning
        self._task, self._scales = task, task.scales
        self._matrix, self._iteration = NewtonMatrix(task), task.solver.it
        self._velocities = problem.current.velocities
        self._accelerations = problem.current.accelerations
        self._tolerance, self._switching = tolerance, problem.switching
        self._forces_jump = problem.switching_forces
        duration, impacts = task.end - task.start, problem.joints is not None
        self._per_step = ErrorPerStep.of(tolerance, duration, tuning.many_steps, impacts)
        self.start: list[float] = []
        self._bodies: BodyError | None = None
        self._curvature: Curvature | None = None
        self._turning: Turning | None = None
        self._step = 0.0  # last tried, s
        self._noise = 0.0  # accelerations due to rounded positions, times the step's square, m
        # those which are left of the steps before, and by what part in each further one, m/s^2
        self._alternating = 0.0
        self._fading = 0.0 if task.impacts else task.spectral_radius
        self._doubted = 0.0  # error of a repeated step, in a motion that may be rounding
        self._envelope = Envelope()
        self._settling = settling
        self._jumped = False  # whether accelerations have, in a step of the smallest size
        self._first_order: FirstOrderError | None = None
        self._joints: list[JointError] = []
        self._films: list[tuple[int, TurningForce]] = []
        self.limiting: list[int] = []

    def __call__(self, step: float) -> float:
        """Return the error of the step (s) that ends in the current state."""
        if self._bodies is None:
            self._bodies = self._first_look()
        self._step = step
        bodies, scales, now = self._bodies, self._scales, self._accelerations.tolist()
        small = scales.resting and scales.still(self._velocities.tolist())
        if scales.resting and not small:
            scales.set_out(self._velocities.tolist(), now)
        if small and scales.speed > 0.0 and step <= 2.0 * self._task.smallest:
            scales.rounded = True  # no shorter one tells
        still = small and scales.rounded
        bodies.noise = 0.0
        if still or not small or scales.speed == 0.0:
            bodies.noise = max(self._noise, self._alternating * step * step)
        if bodies.turning > 1.0:
            bodies.velocities = self._velocities.tolist()
        error, left = bodies.tried(now, step), 0.0
        if still:
            error = 0.0
        elif error > 1.0:
            if not self._matrix.serves(step):
                self._matrix.renew()
            change, error = self._filtered(bodies, step)
            if error > 1.0 and self._matrix.renew():
                change, error = self._filtered(bodies, step)
            if error > 1.0 and self._joints:
                left = self._matrix.left_in_constraints()
                error = bodies.error(change, step, left)
        if bodies.quiet < math.inf and not (self._joints or self._forces_jump):
            turned = bodies.vibration.turned(step)
            allowed = bodies.limit(step) / (step * step * step)
            error = self._envelope.over(error, allowed, turned, bodies.quiet)
        if not (still or self._joints):  # whose impacts and films need finer steps, by far
            offset = self._relative(bodies.offset(step))
            if self._curvature is not None:
                offset = max(offset, self._curvature.error(step))
            error = max(error, math.pow(offset, 1.5))  # as the step's cube
        if small and not still and self._is_rounded(error):
            error = 0.0
        if self._first_order is not None:
            error = max(error, self._first_order.error(step))
        if self._switching:
            switch = self.of_switch(step)
            error = switch if self._settling.never else max(error, switch)
        largest = -1
        for number, joint in enumerate(self._joints):
            found = joint.error(step)
            if found > 1.0:
                left = left or self._matrix.left_in_constraints()
                found = joint.error(step, left)
            if found > error:
                error, largest = found, number
        for number, film in self._films:
            found = film.error(step)
            if found > error:
                error, largest = found, number
        if largest >= 0:
            self.limiting[largest] += 1
        return error

    def _filtered(self, bodies: BodyError, step: float) -> tuple[list[float], float]:
        """Return what Newton's matrix leaves of a change in a step (s), and the error with it."""
        if self._turning is None:
            (change,) = self._matrix.filtered(bodies.change)
            return change, bodies.error(change, step)
        change, rate = self._matrix.filtered(bodies.change, bodies.rate)
        return change, max(bodies.error(change, step), bodies.of_positions(rate, step))

    def _is_rounded(self, error: float) -> bool:
        """Return whether what moves by no more than rounding does is rounding, by its error.

        That of a motion shrinks where a step is repeated with a smaller size; that of rounding
        grows.
        """
        if self._doubted > 0.0:
            self._scales.rounded = error >= self._doubted
        if error > 1.0:
            self._doubted = error
        return self._scales.rounded

    @property
    def _has_switched(self) -> bool:
        """Return whether Exudyn iterated on contacts or friction; once without a switch."""
        return bool(self._iteration.discontinuousIteration > 1)

    def of_switch(self, step: float) -> float:
        """Return the error of a step in which Exudyn's contacts or friction have switched.

        The switch lies anywhere in the step, and its force is at most about as large as what the
        accelerations show: half of it acted too long. As switches are few, that is held against
        the tolerance itself.
        """
        if self._bodies is None or not (self._has_switched or self._settling.never):
            return 0.0
        return self._relative(0.5 * step * self._bodies.largest())

    def of_jump(self, step: float) -> float:
        """Return the error if a jump of the accelerations lies in the step just tried.

        However short the step, it is then of first order; at most half of the jump times the step,
        which is held against the tolerance itself as jumps are few.
        """
        if self._bodies is None:
            return 0.0
        self._jumped = True
        return self._relative(0.5 * step * self._bodies.of_jump())

    def change_of_speed(self) -> float:
        """Return what a jump of accelerations in the step last tried changes a speed by, m/s."""
        return 0.0 if self._bodies is None else self._step * self._bodies.of_jump()

    def accept(self, shortened: bool = False) -> None:
        """Remember the accepted step's end as the next one's beginning.

        Args:
            shortened: whether Exudyn let it end where a contact opens or closes.
        """
        assert self._bodies is not None
        self._alternating = self._fading * self._bodies.noise / (self._step * self._step)
        if self._curvature is not None:
            self._curvature.accept()
        self._bodies.accept()
        self._envelope.accept()
        if self._jumped or (self._forces_jump and (shortened or self._has_switched)):
            self._bodies.jumped()
            self._envelope = Envelope()  # a jump is no part of a cycle
        self._jumped = False
        self._doubted = 0.0
        if self._turning is not None:
            self._bodies.turning = self._turning.stepped(self._step)
        if not self._scales.fixed:
            velocities, accelerations = self._velocities.tolist(), self._accelerations.tolist()
            self._scales.update(velocities, accelerations, self._step)
        if self._first_order is not None:
            self._first_order.accept()
        for _, film in self._films:
            film.accept()

    def start_again(self, accelerations: list[float]) -> None:
        """Be told of the accelerations with which the step under way begins anew, as the first."""
        assert self._bodies is not None
        self._bodies.start_again(accelerations)
        self._alternating = 0.0
        self._envelope = Envelope()
        if self._curvature is not None:
            self._curvature.start_again()

    def _relative(self, speed: float) -> float:
        """Return an error of a speed (m/s) over what the run may have of it."""
        allowed = self._tolerance * self._scales.speed
        return speed / allowed if allowed > 0.0 else 0.0

    def _first_look(self) -> BodyError:
        """Return the bodies' errors from the first step's beginning on; look at the rest too."""
        task, problem, tuning = self._task, self._task.problem, self._task.tuning
        self._noise = self._scales.alternating
        if len(problem.start.rates):
            self._first_order = FirstOrderError(problem, self._per_step)
        per_step = self._per_step
        if problem.joints is None:
            duration = task.end - task.start
            self._turning = Turning(
                problem, self._scales, duration, tuning.foreseen, self._tolerance
            )
        else:
            whole = self._per_step.whole
            of_bodies, penetration = tuning.beside_joints * whole, tuning.penetration
            if problem.modes and tuning.modal_mass > 0.0:
                of_bodies = tuning.vibrating * self._tolerance
                penetration = tuning.vibrating_penetration
            per_step = ErrorPerStep(of_bodies)
            per_time = task.tolerance / (tuning.kept_steps * task.usual)
            self._joints = [
                JointError(j, whole * j.clearance, per_time * j.clearance, self._noise, penetration)
                for j in problem.joints.joints
            ]
            self._films = [
                (number, TurningForce(joint, task.tolerance, TURNS_BY_ROUNDING * task.smallest))
                for number, joint in enumerate(problem.joints.joints)
                if joint.lubricated
            ]
            self.limiting = [0] * len(self._joints)
        accelerations = self.start or problem.start.accelerations.tolist()
        scales, noise, tolerance = self._scales, self._noise, self._tolerance
        bodies = BodyError(accelerations, per_step, scales, tuning, noise, tolerance)
        if not (self._joints or self._switching):  # whose accelerations jump
            self._curvature = Curvature(bodies, scales, noise, tolerance, task.absolute)
        return bodies
