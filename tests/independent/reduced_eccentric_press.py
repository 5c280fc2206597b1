"""The eccentric press with clearance in both ends of its rod: four coordinates.

The rod is free (x, y and direction, from crank pin to wrist pin); slide and ram move up and down as
one, as their balls are ideal. The crank turns at constant speed.
"""

from cmath import exp
from dataclasses import dataclass
from math import cos, pi, sin

from independent.clearance import Clearance, Reduced, moment
from independent.reduced_slider_crank import Numbers


@dataclass(frozen=True)
class ReducedEccentricPress(Reduced):
    """`crank_pin` and `wrist_pin` are kinds of `Clearance`."""

    crank_pin: str
    wrist_pin: str
    numbers: Numbers

    def start(self):
        """Return the ideal mechanism at top dead centre."""
        n = self.numbers
        turn = n.crank_radius * n.speed / n.rod_length
        middle = n.crank_radius - n.rod_length / 2
        moving = -0.5 * n.crank_radius * n.speed  # half of the crank pin's speed
        return (0.0, middle, -pi / 2, n.crank_radius - n.rod_length), (moving, 0.0, turn, 0.0)

    def accelerations(self, t, q, q_t):
        """Newton's and Euler's equations of rod and slide."""
        n = self.numbers
        z, half = complex(q[0], q[1]), 0.5 * n.rod_length * exp(1j * q[2])
        z_t, half_t = complex(q_t[0], q_t[1]), 1j * q_t[2] * half
        angle = n.speed * t
        pin = n.crank_radius * complex(-sin(angle), cos(angle))
        first, _, to_rod = Clearance(self.crank_pin, n).loads(
            pin - (z - half), 1j * n.speed * pin - (z_t - half_t), n.speed, q_t[2]
        )
        second, from_rod, _ = Clearance(self.wrist_pin, n).loads(
            z + half - 1j * q[3], z_t + half_t - 1j * q_t[3], q_t[2], 0.0
        )
        total = second - first - 1j * n.rod_mass * n.gravity
        turning = moment(-half, -first) + moment(half, second) + to_rod + from_rod
        return (
            total.real / n.rod_mass,
            total.imag / n.rod_mass,
            turning / n.rod_inertia,
            -second.imag / n.slider_mass - n.gravity,
        )
