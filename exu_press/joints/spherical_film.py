"""The film between a ball and its socket in space: its force, its couples and their derivatives."""

import numpy as np

from exu_press.joints.ends import cross_matrix
from exu_press.laws.film.ball import BallFilm
from exu_press.numerics.arrays import Array

__all__ = ["SphericalFilm"]


class SphericalFilm:
    """A film law of the plane of eccentricity and motion, in whatever direction that plane lies.

    The resultant acts half-way between the two centres, and the shear of the rotation drags the
    ball with P c (j_across Delta + (j_along - j_across) (n . Delta) n), Delta = omega_J - omega_B,
    and takes the socket along.

    Attributes:
        outside: eccentricity ratio of the last state if the law did not hold there.
        force: on the ball, N.
        moments: on the ball and on the socket about their centres, N m.
    """

    def __init__(self, film: BallFilm, scale: float, clearance: float) -> None:
        """Fill the gap.

        Args:
            film: of ball and socket.
            scale: P = mu R^4 / c^2, N s.
            clearance: c, m.
        """
        self._film, self._scale, self._clearance = film, scale, clearance
        self.outside: float | None = None
        self.force: Array = np.zeros(3)
        self.moments: Array = np.zeros((2, 3))
        self._apart = self._swept = np.zeros(3)
        self._previous: tuple[Array, Array, Array] | None = None
        self._started = False

    def reset(self) -> None:
        """Forget everything."""
        self._previous, self._started = None, False

    def move(self, e: float, n: Array, relative: Array, omegas: Array) -> None:
        """Go to a state.

        Args:
            e: eccentricity, m.
            n: (3,), its direction.
            relative: (3,), its rate, m/s.
            omegas: (6,), angular velocities of ball and socket, rad/s.
        """
        c, p = self._clearance, self._scale
        self._previous = (self._apart, self._swept, self.force) if self._started else None
        self._started = True
        self._e, self._n, self._apart = e, n, e * n
        self._mean, self._spin = 0.5 * (omegas[:3] + omegas[3:]), omegas[:3] - omegas[3:]
        # the eccentricity's rate in the frame that turns with the film: it presses oil out
        self._swept = relative - cross_matrix(self._mean) @ self._apart
        v_n = float(n @ self._swept)
        aside = self._swept - v_n * n
        speed = float(np.sqrt(aside @ aside))
        self._t = -aside / speed if speed > 0.0 else _unit_normal_to(n)
        self._eps_w = 2.0 * speed / c
        response = self._film.law(e / c, v_n / c, self._eps_w)
        self._response = response
        f_r, f_t = p * response[0], p * response[1]
        if f_r == f_r:
            self.outside = None
        elif e == e:
            self.outside = e / c
        if v_n == 0.0 and speed == 0.0 and f_r == f_r:
            f_r = f_t = 0.0  # a law may take a speed for one at rest, to have partials there
        self.force = f_r * n + f_t * self._t
        self._along = self._film.spin(e / c)
        across, along = response[8], self._along[0]
        shear = p * c * (across * self._spin + (along - across) * float(n @ self._spin) * n)
        couple = -0.5 * f_t * e * (cross_matrix(n) @ self._t)
        self.moments = np.array([couple - shear, couple + shear])

    def partials(self) -> tuple[Array, Array]:
        """Return derivatives of force and both moments, (9, 3) by the eccentricity and (9, 9).

        The latter by its rate and by both angular velocities.
        """
        n, t, e, p = self._n, self._t, self._e, self._scale
        q = p / self._clearance
        _, f_t, r_eps, r_dot, r_w, t_eps, t_dot, t_w, across, d_across = self._response
        aside = -2.0 * q * (f_t / self._eps_w if self._eps_w > 0.0 else t_w)
        beside = cross_matrix(n) @ t
        by_swept = (
            np.outer(n, q * r_dot * n - 2.0 * q * r_w * t)
            + np.outer(t, q * t_dot * n - 2.0 * q * t_w * t)
            + aside * np.outer(beside, beside)
        )
        by_e = np.outer(q * (r_eps * n + t_eps * t), n)
        flat = np.eye(3) - np.outer(n, n)
        if e > 0.0:  # force and speed as they are, seen from a direction that turns
            by_e += _rotation_derivative(n, flat, self.force) / e
            by_e -= by_swept @ _rotation_derivative(n, flat, self._swept) / e
        by_swept = self._secant(by_e, by_swept)
        by_e = by_e - by_swept @ cross_matrix(self._mean)
        apart = cross_matrix(self._apart)
        by_omega = 0.5 * by_swept @ apart
        along, d_along = self._along
        pc = p * self._clearance
        by_spin = pc * (across * np.eye(3) + (along - across) * np.outer(n, n))
        turning = float(n @ self._spin)
        sheared = p * np.outer(d_across * self._spin + (d_along - d_across) * turning * n, n)
        if e > 0.0:
            rest = np.outer(n, flat @ self._spin) + turning * flat
            sheared += pc * (along - across) / e * rest
        of_force = 0.5 * (cross_matrix(self.force) - apart @ by_e)
        by_place = np.vstack([by_e, of_force - sheared, of_force + sheared])
        lever = -0.5 * apart @ np.hstack([by_swept, by_omega, by_omega])
        spun = np.hstack([np.zeros((3, 3)), by_spin, -by_spin])
        by_rates = np.vstack(
            [np.hstack([by_swept, by_omega, by_omega]), lever - spun, lever + spun]
        )
        return by_place, by_rates

    def _secant(self, by_e: Array, by_swept: Array) -> Array:
        """Return derivatives by the speed that lead to the force of the state before.

        As `InterfaceJoint` has it, and for the same reason.
        """
        if self._previous is None:
            return by_swept
        apart, swept, force = self._previous
        change = swept - self._swept
        rest = force - self.force - by_e @ (apart - self._apart) - by_swept @ change
        square = float(change @ change)
        if not float(rest @ rest) < float((by_swept * by_swept).sum()) * square:
            return by_swept
        return by_swept + np.outer(rest, change) / square


def _rotation_derivative(n: Array, flat: Array, vector: Array) -> Array:
    """Return (n x d) x vector by d, for d across n."""
    return np.asarray(float(n @ vector) * flat - np.outer(n, flat @ vector))


def _unit_normal_to(n: Array) -> Array:
    normal = np.cross(n, np.eye(3)[int(np.argmin(np.abs(n)))])
    return np.asarray(normal / np.sqrt(normal @ normal))
