"""A joint with clearance between two bodies: the loads of the reduced slider-crank's pin on both.

Points, velocities and forces are complex numbers x + i y; no Exudyn, no exu_press.
"""

from dataclasses import dataclass
from math import nan

import numpy as np
from independent.reduced_slider_crank import Numbers, ReducedSliderCrank
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Clearance:
    """One joint; `kind` is "pinkus", "pi_film", "none" or "lugre_steady"."""

    kind: str
    numbers: Numbers

    def loads(self, e, e_t, omega_j, omega_b):
        """Force on the journal, and the moments on journal and bearing about their centres.

        The bearing has the opposite force. What the two bodies exert on each other has no sum: the
        journal's moment is what momentum conservation leaves.
        """
        pin = ReducedSliderCrank(self.kind, self.numbers)
        f_x, f_y, p_x, p_y, couple, _ = pin.pin_force(
            e.real, e.imag, e_t.real, e_t.imag, omega_j, omega_b, 0.0
        )
        on_bearing = couple - (p_x * f_y - p_y * f_x)
        on_journal = -on_bearing - (e.real * f_y - e.imag * f_x)
        return complex(f_x, f_y), on_journal, on_bearing


def moment(arm, force):
    """Moment of a force at an arm."""
    return arm.real * force.imag - arm.imag * force.real


class Reduced:
    """A model in reduced coordinates q: `accelerations(t, q, q_t)` and the start are its own."""

    def rate(self, t, state):
        """Time derivative of (q, q_t)."""
        half = len(state) // 2
        q, q_t = state[:half].tolist(), state[half:].tolist()
        try:
            return [*q_t, *self.accelerations(t, q, q_t)]
        except (OverflowError, ZeroDivisionError):  # a trial step far outside
            return [nan] * len(state)

    def run(self, times, tolerance):
        """Return the states (2 n, times) from the ideal mechanism's start at t = 0."""
        return self.solved(float(times[-1]), tolerance, times).y

    def solved(self, end, tolerance, times=None, method="LSODA"):
        """Return SciPy's solution at the solver's own instants, for peaks, or at those given."""
        q, q_t = self.start()
        start = np.array([*q, *q_t])
        scale = np.repeat([1.0, 10.0], len(q))
        solution = solve_ivp(
            self.rate,
            (0.0, end),
            start,
            method=method,
            t_eval=times,
            first_step=1e-8,
            max_step=2e-4,
            rtol=tolerance,
            atol=tolerance * 1e-3 * scale,
        )
        if not solution.success:
            raise RuntimeError(solution.message)
        return solution
