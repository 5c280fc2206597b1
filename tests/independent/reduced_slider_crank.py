"""The slider-crank with clearance in its crank pin, reduced to two coordinates.

Written from the equations of docs/theory with nothing but the standard library, NumPy and SciPy:
no Exudyn, no exu_press. Coordinates are the rod's angle phi (direction from its crank end to its
slider end) and the slider's height y; a bristle is a third one. The crank turns at constant speed.
"""

from dataclasses import dataclass, field
from math import atan2, cos, exp, hypot, nan, pi, sin, sqrt, tanh

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Numbers:
    """Sizes and law parameters, SI; defaults are Table 2's."""

    crank_radius: float = 0.03
    rod_length: float = 0.383
    rod_mass: float = 184.5
    rod_inertia: float = 184.5 * 0.383**2 / 12
    slider_mass: float = 1347.0
    gravity: float = 9.81
    speed: float = 240 * pi / 30
    clearance: float = 1e-4
    radius: float = 0.07
    stiffness: float = 2.5545e10
    damping_max: float = 2.5545e8
    damping_depth: float = 1e-5
    mu_static: float = 0.01
    mu_kinetic: float = 0.01
    sigma_0: float = 1e5
    sigma_1: float = 400.0
    sigma_2: float = 0.0
    stribeck_velocity: float = 0.0176
    stribeck_exponent: float = 2.0
    regularisation_velocity: float = 1e-4
    viscosity: float = 0.4
    length: float = 0.1


@dataclass(frozen=True)
class ReducedSliderCrank:
    """Equations of motion; `pin` is "pinkus", "pi_film", "none", "lugre_steady" or "lugre"."""

    pin: str
    numbers: Numbers = field(default_factory=Numbers)

    def start(self) -> list[float]:
        """Return the state of the ideal mechanism at top dead centre, bristle relaxed."""
        n = self.numbers
        turn = n.crank_radius * n.speed / n.rod_length
        state = [-pi / 2, n.crank_radius - n.rod_length, turn, 0.0]
        return [*state, 0.0] if self.pin == "lugre" else state

    def rate(self, t: float, state) -> list[float]:
        """Return the state's time derivative (Lagrange's equations for phi and y)."""
        n = self.numbers
        phi, y, phi_t, y_t = state[0], state[1], state[2], state[3]
        c, s = cos(phi), sin(phi)
        angle, half = n.speed * t, n.rod_length / 2
        r, big_l = n.crank_radius, n.rod_length
        # journal on the crank minus bearing on the rod
        e_x = -r * sin(angle) + big_l * c
        e_y = r * cos(angle) - (y - big_l * s)
        u = -r * n.speed * cos(angle) - big_l * s * phi_t
        v = -r * n.speed * sin(angle) - (y_t - big_l * c * phi_t)
        f_x, f_y, p_x, p_y, couple, bristle_rate = self.pin_force(
            e_x, e_y, u, v, n.speed, phi_t, state[4] if len(state) > 4 else 0.0
        )
        # -F on the rod at the point p from the bearing's centre
        q_y = -f_y
        q_phi = -(f_x * big_l * s - f_y * big_l * c) - (p_x * f_y - p_y * f_x) + couple
        a = n.rod_inertia + n.rod_mass * half**2
        b = -n.rod_mass * half * c
        d = n.rod_mass + n.slider_mass
        rhs_phi = q_phi + n.rod_mass * n.gravity * half * c
        rhs_y = q_y - d * n.gravity - n.rod_mass * half * s * phi_t**2
        det = a * d - b * b
        rates = [
            phi_t,
            y_t,
            (d * rhs_phi - b * rhs_y) / det,
            (a * rhs_y - b * rhs_phi) / det,
        ]
        return [*rates, bristle_rate] if len(state) > 4 else rates

    def pin_force(
        self,
        e_x: float,
        e_y: float,
        u: float,
        v: float,
        omega_j: float,
        omega_b: float,
        z: float,
    ) -> tuple[float, float, float, float, float, float]:
        """Return force on the journal, arm of its opposite and couple on the bearing, and dz/dt."""
        n, couple = self.numbers, 0.0
        e = hypot(e_x, e_y)
        n_x, n_y = (e_x / e, e_y / e) if e > 0.0 else (1.0, 0.0)
        v_n, v_t = u * n_x + v * n_y, v * n_x - u * n_y
        if self.pin in ("pinkus", "pi_film"):
            film = pinkus if self.pin == "pinkus" else pi_film
            eps, c = e / n.clearance, n.clearance
            if eps >= 1.0:  # no film there; Radau then takes a smaller step
                return nan, nan, nan, nan, nan, nan
            eps_w = eps * (omega_j + omega_b) - 2 * v_t / c
            scale = n.viscosity * n.length * n.radius**3 / c**2
            f_r, f_t = film(eps, v_n / c, eps_w)
            couple = scale * c * 2 * pi / sqrt(1 - eps * eps) * (omega_j - omega_b)
            f_n, f_t, reach, bristle_rate = scale * f_r, scale * f_t, e / 2, 0.0
        else:
            # contact point on the journal's surface: material velocities of the two bodies there
            reach = n.radius + e
            sliding = v_t + omega_j * n.radius - omega_b * reach
            mu, bristle_rate = self.friction(sliding, z)
            normal = self.normal_force(e - n.clearance, v_n)
            f_n, f_t = -normal, -mu * normal
        return (
            f_n * n_x - f_t * n_y,
            f_n * n_y + f_t * n_x,
            reach * n_x,
            reach * n_y,
            couple,
            bristle_rate,
        )

    def normal_force(self, depth: float, rate: float) -> float:
        """Return Hertz + STEP without tension."""
        n = self.numbers
        if depth <= 0.0:
            return 0.0
        x = min(depth / n.damping_depth, 1.0)
        damping = n.damping_max * x * x * (3 - 2 * x)
        return max(0.0, n.stiffness * depth * sqrt(depth) + damping * rate)

    def friction(self, v: float, z: float) -> tuple[float, float]:
        """Return mu and dz/dt."""
        n = self.numbers
        if self.pin == "none":
            return 0.0, 0.0
        g = n.mu_kinetic + (n.mu_static - n.mu_kinetic) * exp(
            -(abs(v / n.stribeck_velocity) ** n.stribeck_exponent)
        )
        if self.pin == "lugre_steady":
            return g * tanh(v / n.regularisation_velocity) + n.sigma_2 * v, 0.0
        z_t = v - n.sigma_0 * abs(v) * z / g
        return n.sigma_0 * z + n.sigma_1 * z_t + n.sigma_2 * v, z_t

    def jacobian(self, t: float, state) -> np.ndarray:
        """Return the Jacobian by central differences: a handful of scalar calls."""
        state = [float(x) for x in state]
        columns = []
        for i, width in enumerate((1e-9, 1e-9, 1e-6, 1e-6, 1e-11)[: len(state)]):
            up, down = state.copy(), state.copy()
            up[i] += width
            down[i] -= width
            high, low = self.rate(t, up), self.rate(t, down)
            columns.append([(a - b) / (2 * width) for a, b in zip(high, low, strict=True)])
        return np.array(columns).T

    def slider(self, times: np.ndarray, tolerance: float) -> np.ndarray:
        """Return the slider's height at the times, by SciPy's Radau from t = 0."""
        start = self.start()
        scale = np.array([1.0, 1.0, 10.0, 10.0, 1e-6][: len(start)])
        solution = solve_ivp(
            lambda t, x: self.rate(t, x.tolist()),
            (0.0, float(times[-1])),
            start,
            method="Radau",
            jac=self.jacobian,
            first_step=1e-7,
            t_eval=times,
            rtol=tolerance,
            atol=tolerance * scale,
        )
        if not solution.success:
            raise RuntimeError(solution.message)
        return solution.y[1]


def pinkus(eps: float, eps_t: float, eps_w: float) -> tuple[float, float]:
    """Return F_r / P and F_t / P of Eq. 35 with |eps_dot|, in its regular form."""
    s2 = 1 - eps * eps
    a, b = abs(eps_w) / 2, abs(eps_t)
    big_s = sqrt(s2) * sqrt(a * a + b * b)
    q = b * eps / (big_s + 1.5 * b * eps) if b * eps > 0.0 else 0.0
    factor = 1 + 1.5 * q if eps_t > 0.0 else 1 - 1.5 * q
    radial = 4 * eps * big_s + (2 + eps * eps) * pi * factor * eps_t
    return (
        -6 / ((2 + eps * eps) * s2**1.5) * radial,
        6 * pi * eps_w / ((2 + eps * eps) * sqrt(s2)) * factor,
    )


def pi_film(eps: float, eps_t: float, eps_w: float) -> tuple[float, float]:
    """Return F_r / P and F_t / P of the exact closed form."""
    s2, two = 1 - eps * eps, 2 + eps * eps
    big_s = sqrt(s2) * sqrt((eps_w / two) ** 2 + eps_t**2)  # k_C |eps_dot| eps
    factor = 1 + 2 / pi * atan2(eps * eps_t, big_s) if big_s > 0.0 else 1.0
    radial = 2 * two * eps * big_s + two * pi * factor * eps_t
    return -6 / (two * s2**1.5) * radial, 6 * pi * eps_w / (two * sqrt(s2)) * factor
