"""A crank's pin between the walls of a swinging arm, itself or with a block on it, by SciPy.

Points are complex numbers in the arm's frame, whose y axis lies along the walls. The block has two
ends that touch, the pin touches itself. One and two degrees of freedom: the arm's angle, and the
block's.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class SwingingArm:
    speed: float
    crank: float
    pivot: complex
    inertia: float  # of the arm about its pivot
    mass: float
    centre: complex  # of the arm from its pivot
    clearance: float
    stiffness: float  # of all points that touch together
    damping: float
    depth: float  # at which the damping is full
    friction: float
    slow: float  # speed that makes friction smooth
    lever: float
    block_inertia: float = 0.0
    block_length: float = 0.0  # 0: the pin itself
    gravity: float = 9.81

    def pin(self, time):
        place = self.crank * 1j * np.exp(1j * self.speed * time)
        return place - self.pivot, 1j * self.speed * place

    def press(self, place, velocity, turning, arm, arm_rate, stiffness):
        """Moment on the arm, and force on a point with its place of contact, about the pivot."""
        turn = np.exp(-1j * arm)
        z = place * turn
        rate = velocity * turn - 1j * arm_rate * z
        wall = (self.crank * 1j - self.pivot).real
        side = np.sign(z.real - wall)
        depth = abs(z.real - wall) - self.clearance
        if depth <= 0.0:
            return 0.0, 0j, 0j
        share = min(depth / self.depth, 1.0)
        normal = stiffness * depth
        normal += self.damping * share**2 * (3.0 - 2.0 * share) * side * rate.real
        normal = max(normal, 0.0)
        touched = z + side * self.lever
        sliding = rate.imag + side * self.lever * (turning - arm_rate)
        force = -side * normal - 1j * self.friction * np.tanh(sliding / self.slow) * normal
        return -(touched.conjugate() * force).imag, force / turn, touched / turn

    def derivative(self, time, state):
        place, velocity = self.pin(time)
        arm, arm_rate, block, block_rate = state
        weight = -self.mass * self.gravity * (self.centre * np.exp(1j * arm)).real
        if not self.block_length:
            moment = self.press(place, velocity, self.speed, arm, arm_rate, self.stiffness)[0]
            return arm_rate, (moment + weight) / self.inertia, 0.0, 0.0
        on_arm = on_block = 0.0
        for side in (-0.5, 0.5):
            reach = side * self.block_length * 1j * np.exp(1j * block)
            moment, force, touched = self.press(
                place + reach,
                velocity + 1j * block_rate * reach,
                block_rate,
                arm,
                arm_rate,
                0.5 * self.stiffness,
            )
            on_arm += moment
            on_block += ((touched - place).conjugate() * force).imag
        return (
            arm_rate,
            (on_arm + weight) / self.inertia,
            block_rate,
            on_block / self.block_inertia,
        )

    def angles(self, time):
        """The arm's angle at some instants, from the start of the ideal mechanism."""
        place, velocity = self.pin(0.0)
        rate = -velocity.real / place.imag
        solution = solve_ivp(
            self.derivative,
            (0.0, time[-1]),
            (0.0, rate, 0.0, rate),
            method="LSODA",
            t_eval=time,
            rtol=1e-9,
            atol=1e-12,
            max_step=1e-5,
        )
        return solution.y[0]
