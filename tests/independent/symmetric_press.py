"""The paper's press, symmetric and in ideal guides, with clearance in crank pin and balls.

Three coordinates: the slide's height, the linkage's direction (from its crank end to the slide) and
the slider's height. Links 5 to 7 and the plungers follow the slide; the counterweight follows the
crank and bears on nothing else. The crank turns at constant speed. Lengths and masses: Table 2.
"""

from cmath import exp
from dataclasses import dataclass
from math import cos, pi, sin, sqrt

import numpy as np
from independent.clearance import Clearance, Reduced
from independent.reduced_slider_crank import Numbers, ReducedSliderCrank

A, LINK_5, LINK_6, LINK_7, PLUNGER = 0.1655, 0.23, 0.24, 0.164, 0.55
SLIDE, MASS_5, MASS_6, MASS_7, MASS_8, SLIDER = 60.0, 22.72, 24.13, 15.5, 155.3, 1347.0
BOTTOM = -0.03 - 0.383
PIVOT = complex(A, BOTTOM - sqrt(LINK_5**2 - A**2) + LINK_6)


def chain(y):
    """Ball's height, its slope, and the right half's mass, mass rate and weight by slide height.

    The slide stands at height y. Kinetic energy is M(y) y_t^2 / 2, so that its force is
    M y_tt + M' y_t^2 / 2, and gravity's is -g W.
    """
    slide, slide_1 = 1j * y, 1j
    base = PIVOT - slide
    far = abs(base)
    along = (LINK_5**2 - LINK_6**2 + far**2) / (2 * far)
    knuckle = slide + (along - 1j * sqrt(LINK_5**2 - along**2)) * base / far
    u, v = knuckle - slide, knuckle - PIVOT
    knuckle_1 = solve(u, v, dot(u, slide_1), 0.0)
    knuckle_2 = solve(u, v, -(abs(knuckle_1 - slide_1) ** 2), -(abs(knuckle_1) ** 2))
    across = A - knuckle.real
    foot = complex(A, knuckle.imag - sqrt(LINK_7**2 - across**2))
    w = foot - knuckle
    foot_1 = solve(w, 1 + 0j, dot(w, knuckle_1), 0.0)
    foot_2 = solve(w, 1 + 0j, dot(w, knuckle_2) - abs(foot_1 - knuckle_1) ** 2, 0.0)
    mass = half_rate = weight = 0.0
    zero = 0j
    for m, length, (p, p_1, p_2), (r, r_1, r_2) in (
        (MASS_5, LINK_5, (slide, slide_1, zero), (knuckle, knuckle_1, knuckle_2)),
        (MASS_6, LINK_6, (PIVOT, zero, zero), (knuckle, knuckle_1, knuckle_2)),
        (MASS_7, LINK_7, (knuckle, knuckle_1, knuckle_2), (foot, foot_1, foot_2)),
    ):
        centre_1, centre_2 = (p_1 + r_1) / 2, (p_2 + r_2) / 2
        d, d_1, d_2 = r - p, r_1 - p_1, r_2 - p_2
        turn_1 = (d.conjugate() * d_1).imag / length**2
        turn_2 = (d.conjugate() * d_2).imag / length**2
        inertia = m * length**2 / 12
        mass += m * abs(centre_1) ** 2 + inertia * turn_1**2
        half_rate += m * dot(centre_1, centre_2) + inertia * turn_1 * turn_2
        weight += m * centre_1.imag
    mass += MASS_8 * abs(foot_1) ** 2
    half_rate += MASS_8 * dot(foot_1, foot_2)
    weight += MASS_8 * foot_1.imag
    return foot.imag - PLUNGER, foot_1.imag, mass, half_rate, weight


def dot(a, b):
    """Scalar product."""
    return (a.conjugate() * b).real


def solve(u, v, along_u, along_v):
    """The vector with these scalar products."""
    det = u.real * v.imag - u.imag * v.real
    return complex(
        (along_u * v.imag - along_v * u.imag) / det, (u.real * along_v - v.real * along_u) / det
    )


@dataclass(frozen=True)
class SymmetricPress(Reduced):
    """`crank_pin` is a kind of `Clearance`; the balls are dry, of its clearance or of their own."""

    crank_pin: str
    numbers: Numbers
    ball_clearance: float | None = None

    @property
    def in_balls(self):
        """Clearance of the balls, m."""
        return self.numbers.clearance if self.ball_clearance is None else self.ball_clearance

    def eccentricities(self, t, q):
        """Return that of the crank pin (complex) and of a ball, m: journal less bearing."""
        n = self.numbers
        y, phi, slider = q
        angle = n.speed * t
        pin = n.crank_radius * complex(-sin(angle), cos(angle))
        return pin - (1j * y - n.rod_length * exp(1j * phi)), chain(y)[0] - slider

    def start(self):
        """Return the ideal mechanism at top dead centre."""
        n = self.numbers
        y = n.crank_radius - n.rod_length
        turn = n.crank_radius * n.speed / n.rod_length
        return (y, -pi / 2, chain(y)[0]), (0.0, turn, 0.0)

    def accelerations(self, t, q, q_t):
        """Lagrange's equations."""
        return self.loads(t, q, q_t)[0]

    def loads(self, t, q, q_t):
        """Return the accelerations and the forces on the crank pin and on each ball, N."""
        n = self.numbers
        (y, phi, slider), (y_t, phi_t, slider_t) = q, q_t
        ball, slope, mass, half_rate, weight = chain(y)
        rod, half = n.rod_length * exp(1j * phi), 0.5 * n.rod_length
        angle = n.speed * t
        pin = n.crank_radius * complex(-sin(angle), cos(angle))
        end, end_t = 1j * y - rod, 1j * y_t - 1j * phi_t * rod
        force, _, on_rod = Clearance(self.crank_pin, n).loads(
            pin - end, 1j * n.speed * pin - end_t, n.speed, phi_t
        )
        apart, closing = ball - slider, slope * y_t - slider_t
        sense = 1.0 if apart > 0.0 else -1.0
        law = ReducedSliderCrank("none", n)
        on_ball = -sense * law.normal_force(abs(apart) - self.in_balls, sense * closing)
        c, s = cos(phi), sin(phi)
        on_phi = (-rod.conjugate() * -force).imag + on_rod  # -F at its end, from the slide
        a, b = n.rod_inertia + n.rod_mass * half**2, -n.rod_mass * half * c
        d = n.rod_mass + SLIDE + 2 * mass
        rhs_phi = on_phi + n.rod_mass * n.gravity * half * c
        rhs_y = (
            -force.imag
            + 2 * slope * on_ball
            - n.gravity * (n.rod_mass + SLIDE + 2 * weight)
            - n.rod_mass * half * s * phi_t**2
            - 2 * half_rate * y_t**2
        )
        det = a * d - b * b
        accelerations = (
            (a * rhs_y - b * rhs_phi) / det,
            (d * rhs_phi - b * rhs_y) / det,
            -2 * on_ball / SLIDER - n.gravity,
        )
        return accelerations, abs(force), abs(on_ball)

    def peaks(self, times, states):
        """Return the slider's peak acceleration in every revolution, m/s^2."""
        accelerations = [
            abs(self.loads(t, state[:3], state[3:])[0][2])
            for t, state in zip(times, states.T.tolist(), strict=True)
        ]
        turns = self.numbers.speed * times / (2.0 * pi)
        revolution = np.minimum(turns, turns[-1] - 1e-9).astype(int)
        found = np.zeros(revolution[-1] + 1)
        np.maximum.at(found, revolution, accelerations)
        return found.tolist()
