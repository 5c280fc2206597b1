"""Energy that the method's error holds while constraints turn the motion."""

import numpy as np

from exu_press.integrate.problem import Problem
from exu_press.integrate.settings import Task
from exu_press.numerics.arrays import Array

__all__ = ["KeptEnergy"]

TURNED = 0.3
"""Largest angle by which constraints turn velocities in a step, rad; more is rounding."""


class KeptEnergy:
    """Scales velocities with the step, so that no energy comes or goes where constraints turn them.

    Steps of one size h follow, to h^2, equations of their own (modified equations)::

        q' = v + d_q h^2 j,   M v' = F - G^T lambda + d_v h^2 M j',   G(q) = 0

    with accelerations a, their rate j, and the method's d_q = (alpha_m - alpha_f)/2 + beta - 1/6
    and d_v = (alpha_m - alpha_f)(alpha_m + gamma - 1/2) + gamma/2 - 1/6. Where forces are
    conservative and masses constant, with constraints or without, these keep
    E - h^2 (d_v v M j - (d_q + d_v) a M a / 2), with E the energy. So what energy is off by comes
    and goes with the motion, and does not grow while steps have one size. But a change of step
    leaves it behind, and from change to change it adds up.

    Springs that obey Hooke's law make it the same in all places. But where constraints turn the
    motion, with accelerations N, it is -h^2 (3 d_v + d_q) N M N / 2, as v M j = -N M N. With a step
    from h_1 to h_2 velocities change by -(h_2^2 - h_1^2) (3 d_v + d_q)/2 |N|^2/|v|^2 of what
    constraints do not prescribe of them, which hands it over, and N, which goes with their square,
    by twice that part. Sizes are kinetic norms. A constant may be taken from |N|^2: that where
    steps first change, so that a rotor that turns steadily keeps its velocity.

    Euler parameters p have no mass along themselves, but there they turn, with 4 J |p'|^2 for the
    square of a speed. About a fixed axis all is as with constant masses; where axes turn and
    inertias differ it is not, and a body that tumbles is left with an error.

    Not where loads have corners, as in scenes: these change the energy by more, and the torques of
    a drive in two runs with other steps differed by 0.4 % of the peak.

    Source: modified equations, E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration,
    chapter IX; the change is worked out here.
    """

    def __init__(self, task: Task) -> None:
        """Take the solver of a task."""
        self._solver, problem = task.solver, task.problem
        self._reference = problem.reference
        self._turning: float | None = None  # |N|^2 where steps first change
        self._parameters = [
            slice(node.start + node.size - 4, node.start + node.size)
            for node in problem.nodes
            if node.quaternion
        ]

    @staticmethod
    def suits(problem: Problem) -> bool:
        """Return whether a system has rigid bodies of constant masses alone, and constraints.

        Those in space have Euler parameters, and no springs: robots that controllers drive took
        twice the steps. Beams and cables vibrate, and rang on.
        """
        if not problem.rigid or problem.untold_rates or not len(problem.current.multipliers):
            return False
        turning = [node for node in problem.nodes if node.rotations]
        return all(node.quaternion for node in turning) and not (turning and problem.springs)

    def per_square(
        self, step: float, positions: Array, velocities: Array, inertia: Array, held: Array
    ) -> Array:
        """Return the changes of velocities and accelerations over h_2^2 - h_1^2, (2, n), SI.

        Args:
            step: the last one, s.
            positions: (n,).
            velocities: (n,).
            inertia: (n, n).
            held: what constraints prescribe of velocities and accelerations, (n, 2).
        """
        of_v, of_a = held.T
        kinetic, turning = float(velocities @ inertia @ velocities), float(of_a @ inertia @ of_a)
        for part in self._parameters:
            rates, p = velocities[part], self._reference[part] + positions[part]
            square = float(rates @ rates)
            if square > 0.0:
                mass = float(rates @ inertia[part, part] @ rates) / square
                turning += mass * float(p @ of_a[part]) ** 2
        if not step * step * turning <= TURNED * TURNED * kinetic or kinetic == 0.0:
            return np.zeros((2, len(held)))
        if self._turning is None:
            self._turning = turning
        solver = self._solver
        settled, gamma = solver.alphaM - solver.alphaF, solver.newmarkGamma
        d_q = 0.5 * settled + solver.newmarkBeta - 1.0 / 6.0
        d_v = settled * (solver.alphaM + gamma - 0.5) + 0.5 * gamma - 1.0 / 6.0
        change = -0.5 * (3.0 * d_v + d_q) * (turning - self._turning) / kinetic
        return np.array([change * (velocities - of_v), 2.0 * change * of_a])
