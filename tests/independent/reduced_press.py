"""The symmetric press with dry or lubricated crank pin and dry balls, in three coordinates.

Written from the equations of docs/theory, without Exudyn: coordinates are the slide's height y, the
linkage's angle phi (direction from its crank end to the slide) and the slider's height z. The crank
turns at constant speed, the guides are ideal and both sides do the same, so that the balls move
vertically alone. The laws of contact, friction and film are the package's, which have tests of
their own.
"""

from math import cos, hypot, sin, sqrt

import numpy as np
from scipy.integrate import LSODA

from exu_press import Scene
from exu_press.scene.laws import contact_law, film_law, friction_law


class ReducedPress:
    """Lagrange's equations of a rigid press without blanking and elastic guides."""

    def __init__(self, scene: Scene) -> None:
        """Take a scene with steady laws and balls that are dry."""
        pin, ball, size = scene.joints["crank_pin"], scene.joints["ball_right"], scene.press
        self.size, self.scene, self.radius = size, scene, pin.radius
        self.pin_clearance, self.ball_clearance = pin.clearance, ball.clearance
        self.film = None
        if pin.kind == "lubricated":
            film = pin.film
            self.film = film_law(film, pin.radius, pin.clearance)
            self.film_scale = film.viscosity * film.length * pin.radius**3 / pin.clearance**2
        else:
            self.pin_contact = contact_law(pin.contact, pin.clearance, revolute=True)
            self.friction = friction_law(pin.friction)
        self.ball_contact = contact_law(ball.contact, ball.clearance, revolute=False)
        bottom = -size.crank_radius - size.linkage_length
        drop = sqrt(size.link_5_length**2 - size.pivot_distance**2)
        self.pivot_y = bottom - drop + size.link_6_length
        self.origin = bottom - drop - size.link_7_length - size.plunger_length
        self.linkage_inertia = (
            size.linkage_inertia or size.linkage_mass * size.linkage_length**2 / 12
        )

    def side(self, y: float) -> tuple[float, ...]:
        """Return what one side does at a height of the slide, and its derivatives with that.

        The mass that the slide feels (kg), half its derivative, the weight's force over gravity,
        and the ball's height with its derivative.
        """
        s = self.size
        a, l5, l6, l7 = s.pivot_distance, s.link_5_length, s.link_6_length, s.link_7_length
        # knuckle: to the right of the way from the slide (0, y) to the pivot (a, pivot_y), or left
        b_x, b_y = a, self.pivot_y - y
        square = b_x * b_x + b_y * b_y
        along = (l5 * l5 - l6 * l6 + square) / (2.0 * square)
        across = sqrt(l5 * l5 / square - along * along)
        k_x, k_y = along * b_x + across * b_y, along * b_y - across * b_x  # from the slide
        p_x, p_y = k_x - b_x, k_y - b_y  # from the pivot
        # derivatives with y: p.p' = 0, k.(p' - (0, 1)) = 0
        det = p_x * k_y - p_y * k_x
        d_x, d_y = -p_y * k_y / det, p_x * k_y / det
        v = d_y - 1.0
        r1, r2 = -(d_x * d_x + d_y * d_y), -(d_x * d_x + v * v)
        dd_x, dd_y = (r1 * k_y - r2 * p_y) / det, (r2 * p_x - r1 * k_x) / det
        # foot on x = a: link 7 from the knuckle, (-p_x, f)
        f = -sqrt(l7 * l7 - p_x * p_x)
        f_1 = -p_x * d_x / f
        f_2 = -(d_x * d_x + p_x * dd_x + f_1 * f_1) / f
        u, u_1, u_2 = self.pivot_y + p_y + f, d_y + f_1, dd_y + f_2
        mass = half = weight = 0.0
        for m, x1, y1, x2, y2 in (
            (s.link_5_mass, 0.5 * d_x, 0.5 * (1 + d_y), 0.5 * dd_x, 0.5 * dd_y),
            (s.link_6_mass, 0.5 * d_x, 0.5 * d_y, 0.5 * dd_x, 0.5 * dd_y),
            (s.link_7_mass, 0.5 * d_x, 0.5 * (d_y + u_1), 0.5 * dd_x, 0.5 * (dd_y + u_2)),
            (s.plunger_mass, 0.0, u_1, 0.0, u_2),
        ):
            mass += m * (x1 * x1 + y1 * y1)
            half += m * (x1 * x2 + y1 * y2)
            weight += m * y1
        for m, x1, y1, x2, y2 in (  # m l^2 / 12 turn^2, turn = |change of the link| / l
            (s.link_5_mass / 12, d_x, d_y - 1.0, dd_x, dd_y),
            (s.link_6_mass / 12, d_x, d_y, dd_x, dd_y),
            (s.link_7_mass / 12, -d_x, f_1, -dd_x, f_2),
        ):
            mass += m * (x1 * x1 + y1 * y1)
            half += m * (x1 * x2 + y1 * y2)
        return mass, half, weight, u - s.plunger_length, u_1

    def pin_force(self, e_x, e_y, v_x, v_y, omega_b):
        """Return force on the journal and the moment of its opposite about the bearing's centre."""
        e = hypot(e_x, e_y)
        n_x, n_y = (e_x / e, e_y / e) if e > 0.0 else (1.0, 0.0)
        rate, across = v_x * n_x + v_y * n_y, v_y * n_x - v_x * n_y
        omega_j, c = self.scene.angular_speed, self.pin_clearance
        f_n = f_t = moment = 0.0
        if self.film is not None:
            answer = self.film(e / c, rate / c, (e * (omega_j + omega_b) - 2.0 * across) / c)
            f_n, f_t = self.film_scale * answer[0], self.film_scale * answer[1]
            moment = -0.5 * e * f_t
        elif e > c:
            normal = self.pin_contact.force(e - c, rate, 0.0)[0]
            reach = self.radius + e
            sliding = across + self.radius * omega_j - reach * omega_b
            f_n, f_t = -normal, -self.friction(sliding)[0] * normal
            moment = -reach * f_t
        return f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x, moment

    def rate(self, t, state):
        """Return the state's rate: y, phi, z and theirs."""
        y, phi, z, y_t, phi_t, z_t = state.tolist()
        s, g = self.size, self.scene.gravity
        length, half = s.linkage_length, s.linkage_length / 2
        angle, w = self.scene.start_angle + self.scene.angular_speed * t, self.scene.angular_speed
        c, n = cos(phi), sin(phi)
        r = s.crank_radius
        e_x = -r * sin(angle) + length * c
        e_y = r * cos(angle) - (y - length * n)
        v_x = -r * w * cos(angle) - length * n * phi_t
        v_y = -r * w * sin(angle) - (y_t - length * c * phi_t)
        f_x, f_y, moment = self.pin_force(e_x, e_y, v_x, v_y, phi_t)
        mass, half_slope, weight, ball, ball_1 = self.side(y)
        e = ball - z
        rate = ball_1 * y_t - z_t
        ball_force = 0.0
        if abs(e) > self.ball_clearance:
            sign = 1.0 if e > 0 else -1.0
            ball_force = (
                -sign * self.ball_contact.force(abs(e) - self.ball_clearance, sign * rate, 0.0)[0]
            )
        # linkage: centre (-shift from the middle along phi), kinetic energy with y and phi
        arm = half + s.linkage_mass_offset  # from the slide's pin to the centre of mass
        m = s.linkage_mass
        inertia = self.linkage_inertia + m * arm * arm
        coupled = -m * arm * c
        on_phi = m * g * arm * c - (f_x * length * n - f_y * length * c) + moment
        on_y = (
            -m * g
            - f_y
            - m * arm * n * phi_t * phi_t
            - s.slide_mass * g
            + 2.0 * (-half_slope * y_t * y_t - weight * g + ball_force * ball_1)
        )
        total = m + s.slide_mass + 2.0 * mass
        det = total * inertia - coupled * coupled
        return np.array(
            (
                y_t,
                phi_t,
                z_t,
                (on_y * inertia - coupled * on_phi) / det,
                (total * on_phi - coupled * on_y) / det,
                -g - 2.0 * ball_force / s.slider_mass,
            )
        )

    def start(self):
        """Return coordinates and rates of the ideal mechanism at the start."""
        s, w, angle = self.size, self.scene.angular_speed, self.scene.start_angle
        x, h = -s.crank_radius * sin(angle), s.crank_radius * cos(angle)
        up = sqrt(s.linkage_length**2 - x * x)
        y = h - up
        phi = np.arctan2(y - h, -x)
        v_x, v_y = -h * w, x * w
        y_t = v_y + x * v_x / up
        phi_t = -v_x / up  # -L sin(phi) phi_t = -v_x with sin(phi) = -up / L
        _, _, _, ball, ball_1 = self.side(y)
        return np.array((y, float(phi), ball, y_t, phi_t, ball_1 * y_t))

    def slider(self, duration: float, tolerance: float, moved: float = 0.0):
        """Return time, the six coordinates and rates, and the slider's acceleration, (n, 8).

        Args:
            duration: s.
            tolerance: relative and, in m and 10 m/s, absolute times 1e-3.
            moved: by how much the slider starts too high, m.
        """
        state = self.start()
        state[2] += moved
        scale = np.array((1.0, 1.0, 1.0, 10.0, 10.0, 10.0))
        solver = LSODA(
            self.rate,
            0.0,
            state,
            duration,
            rtol=max(tolerance, 1e-13),
            atol=1e-3 * tolerance * scale,
            first_step=1e-8,
            max_step=1e-4,
        )
        found = [(0.0, *state, self.rate(0.0, state)[5])]
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(message)
            found.append((solver.t, *solver.y, self.rate(solver.t, solver.y)[5]))
        return np.array(found)
