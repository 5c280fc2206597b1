"""A spherical clearance joint between bodies of any kind (Eqs. 12-22), dry or with a film.

Arrays stand before the floats that they are multiplied by: compiled code takes float * array for a
float.
"""

import math
from typing import Any

import numpy as np

from exu_press.joints.ends import BodyEnd, Vector, cross, cross_matrix
from exu_press.joints.joint import SHALLOW, ClearanceJoint, JointState
from exu_press.joints.spherical_film import SphericalFilm
from exu_press.laws.contact import Approach, NormalContact
from exu_press.laws.friction import Friction, LuGre
from exu_press.numerics.arrays import Array

__all__ = ["SpatialSpherical"]


class SpatialSpherical(ClearanceJoint):
    """A ball in a socket, touching where their centres are further apart than the clearance.

    Both forces act at the contact point on the ball's surface, so that momentum and angular
    momentum are conserved exactly; friction opposes the sliding of the two surfaces there. A film
    acts in parallel.
    """

    def __init__(
        self,
        ball: BodyEnd,
        socket: BodyEnd,
        contact: NormalContact | None,
        friction: Friction | LuGre,
        radius: float,
        clearance: float,
        film: SphericalFilm | None = None,
        asperity_onset: float = 0.0,
    ) -> None:
        """Join ball and socket; radius, radial clearance and the gap at which they touch in m."""
        super().__init__(
            ball.indices + socket.indices,
            clearance,
            contact_onset=math.inf if contact is None else clearance - asperity_onset,
            largest_eccentricity=math.inf if contact is None else clearance + SHALLOW * radius,
            lubricated=film is not None,
        )
        self.ball = ball
        self.socket = socket
        self._stateful = contact is not None and (
            isinstance(friction, LuGre) or contact.needs_impact_speed
        )
        self._contact, self._friction = contact, friction
        self._radius = radius
        self._film = film
        self._next_bristle: Array = np.zeros(3)
        self._sliding: Array | None = None
        self._sliding_before: Array | None = None
        self._normal = self._normal_before = self._in_bristles = 0.0
        self._e = 0.0
        self._touching = False
        self.reset()

    @property
    def outside(self) -> float | None:
        """Eccentricity ratio of the last state if the film's law did not hold there."""
        return None if self._film is None else self._film.outside

    def begin_step(self, step: float, accepted: bool) -> None:
        """Keep bristle deflection and approach speed of the last step if it was accepted."""
        super().begin_step(step, accepted)
        if accepted:
            self._in_bristles += self._into_bristles()
            self._bristle = self._next_bristle
            self._sliding_before = self._sliding
            self._normal_before = self._normal
            self._approach.accept()

    def contact_depth(self) -> float:
        """Return the penetration at the last `add_force`, m; none where it is not positive."""
        return self._e - self.contact_onset

    def contact_memory(self) -> float:
        """Return damping over stiffness of the normal force at the last `add_force`, s."""
        if not self._touching:
            return 0.0
        stiffness, damping = self._law[1:]
        if self._film is not None:
            by_place, by_rates = self._film.partials()
            stiffness -= float(self._n @ by_place[:3] @ self._n)
            damping -= float(self._n @ by_rates[:3, :3] @ self._n)
        return damping / stiffness if stiffness > 0.0 else 0.0

    def reset(self) -> None:
        """Relax the bristle."""
        super().reset()
        self._e = 0.0
        self._n, self._relative = np.array([1.0, 0.0, 0.0]), np.zeros(3)
        self._bristle = np.zeros(3)
        self._next_bristle = self._bristle
        self._normal = self._normal_before = self._in_bristles = 0.0
        self._sliding = self._sliding_before = None
        self._approach = Approach()
        self._touching = False
        if self._film is not None:
            self._film.reset()

    def memory(self) -> list[Any]:
        """Return the memory of the steps before, numbers in lists."""
        vectors = self._bristle, self._next_bristle, self._sliding, self._sliding_before
        vectors_as_lists = [None if vector is None else vector.tolist() for vector in vectors]
        return [*super().memory(), vectors_as_lists, self._approach.memory()]

    def recall(self, memory: list[Any]) -> None:
        """Take over the memory of another joint of its kind, in the state of the last forces."""
        super().recall(memory)
        bristle, following, *sliding = memory[2]
        self._bristle, self._next_bristle = np.array(bristle), np.array(following)
        self._sliding, self._sliding_before = (
            None if vector is None else np.array(vector) for vector in sliding
        )
        self._approach.recall(memory[3])

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        self._move(q, q_t)
        if self._touching:
            force, couple = self._normal_force + self._drag, _cross(self._n, self._drag)
            reach = self._radius + self._e
            self.ball.add_forces(_vector(force), _vector(couple * self._radius), out)
            self.socket.add_forces(_vector(-force), _vector(couple * -reach), out)
        if self._film is not None:
            force, (on_ball, on_socket) = self._film.force, self._film.moments
            self.ball.add_forces(_vector(force), _vector(on_ball), out)
            self.socket.add_forces(_vector(-force), _vector(on_socket), out)

    def jacobian(self, by_q: float, by_q_t: float) -> Array | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t), less the terms of turning arms."""
        if self._film is None:
            return self._of_contact(by_q, by_q_t) if self._touching else None
        ball, ball_omega = self.ball.rates()
        socket, socket_omega = self.socket.rates()
        rates = np.zeros((9, len(self.indices)))
        rates[:3] = np.hstack([ball, -socket])
        rates[3:6, : ball.shape[1]] = ball_omega
        rates[6:, ball.shape[1] :] = socket_omega
        by_place, by_rates = self._film.partials()
        matrix = -rates.T @ (by_place * by_q @ rates[:3] + by_rates * by_q_t @ rates)
        entries = np.asarray(matrix).ravel()
        return entries + self._of_contact(by_q, by_q_t) if self._touching else entries

    def _of_contact(self, by_q: float, by_q_t: float) -> Array:
        """Return the part of the contact in the Jacobian."""
        n, e = self._n, self._e
        normal, stiffness, damping = self._law
        across = np.eye(3) - np.outer(n, n)
        by_normal = n * stiffness + (across @ self._relative) * damping / e  # dN by e
        slipping = (  # sliding by the direction n
            across @ cross_matrix(self._swirl) - np.eye(3) * float(n @ self._surface)
        ) - np.outer(n, self._surface)
        by_e = -np.outer(n, by_normal) - across * (normal / e)
        by_v = np.outer(n, n) * -damping
        drag_by_e = -np.outer(self._mu, by_normal) + self._drag_by_sliding @ slipping @ across / e
        drag_by_v = -np.outer(self._mu, n * damping)
        centre, surface = self._rates()
        matrix = centre.T @ ((by_e * by_q + by_v * by_q_t) @ centre)
        matrix += surface.T @ ((drag_by_e * by_q + drag_by_v * by_q_t) @ centre)
        matrix += surface.T @ ((self._drag_by_sliding @ across) * by_q_t @ surface)
        return np.asarray(-matrix).ravel()

    @property
    def eccentricity(self) -> tuple[float, ...]:
        """Journal centre - bearing centre at the last `add_force`, m."""
        return tuple((self._n * self._e).tolist())

    @property
    def relative_velocity(self) -> tuple[float, ...]:
        """Rate of the eccentricity at the last `add_force`, m/s."""
        return tuple(self._relative.tolist())

    @property
    def force(self) -> tuple[float, ...]:
        """Force on the ball at the last `add_force`, N."""
        force = self._normal_force + self._drag
        if self._film is not None:
            force = force + self._film.force
        return tuple(force.tolist())

    @property
    def state(self) -> JointState:
        """The joint's state at the last `add_force`."""
        reach, pressed, elastic, energy = self._radius + self._e, 0.0, 0.0, 0.0
        if self._contact is not None:
            pressed = self._e - self.contact_onset - self.path.drift
            elastic = self._contact.stiffness.force(pressed)[0] if pressed > 0.0 else 0.0
            energy = self._contact.elastic_energy(pressed)
        couple = _cross(self._n, self._drag)
        moments = np.concatenate([couple * self._radius, couple * -reach])
        if self._film is not None:
            moments = moments + self._film.moments.ravel()
        return JointState(
            eccentricity=self.eccentricity,
            force=self.force,
            velocity=self.relative_velocity,
            moments=tuple(moments.tolist()),
            angular_velocities=tuple(self._omegas.tolist()),
            gap=self.clearance - self._e,
            stored_energy=energy + self._in_bristles + self._into_bristles(),
            stored_power=elastic * float(self._n @ self._relative) + self._power_of_bristles(),
        )

    def _into_bristles(self) -> float:
        """Return the energy that bristles took up in the last step at its mean normal force, J."""
        if not isinstance(self._friction, LuGre):
            return 0.0
        start, end = (
            self._friction.stored_energy(float(np.linalg.norm(z)))
            for z in (self._bristle, self._next_bristle)
        )
        return 0.5 * (self._normal + self._normal_before) * (end - start)

    def _power_of_bristles(self) -> float:
        """Return the rate of the bristles' energy, W."""
        if not isinstance(self._friction, LuGre) or self._sliding is None:
            return 0.0
        z, speed = self._next_bristle, float(np.linalg.norm(self._sliding))
        relaxes = self._friction.rate(speed, 1.0) - speed
        rate = self._sliding + z * relaxes
        return self._normal * self._friction.sigma_0 * float(z @ rate)

    def _move(self, q: list[float], q_t: list[float]) -> None:
        """Find eccentricity, velocities and forces."""
        ball, socket = self.ball, self.socket
        ball.move(q, q_t)
        socket.move(q, q_t)
        apart = np.subtract(ball.position, socket.position)
        self._e = e = float(np.sqrt(apart @ apart))
        self._n = n = apart / e if e > 0.0 else np.array([1.0, 0.0, 0.0])
        self._relative = np.subtract(ball.velocity, socket.velocity)
        self._omegas = np.concatenate([ball.angular_velocity, socket.angular_velocity])
        if self._film is not None:
            self._film.move(e, n, self._relative, self._omegas)
        self._normal_force = self._drag = np.zeros(3)
        self._normal = 0.0
        penetration = e - self.contact_onset - self.path.drift
        self._touching = penetration > 0.0
        if not self._touching and not self._stateful:
            return
        reach = self._radius + e
        self._swirl = self._omegas[:3] * self._radius - self._omegas[3:] * reach
        self._surface = self._relative + _cross(self._swirl, n)
        sliding = self._surface - n * (n @ self._surface)
        rate = float(n @ self._relative)
        self._mu, by_sliding, bristle = self._coefficient(sliding)
        self._sliding = sliding
        self._next_bristle = bristle
        speed = self._approach.speed(penetration, rate)
        if self._touching and self._contact is not None:
            self._law = self._contact.force(penetration, rate, speed)
            self._normal = self._law[0]
            self._normal_force = n * -self._normal
            self._drag = self._mu * -self._law[0]
            self._drag_by_sliding = by_sliding * -self._law[0]

    def _rates(self) -> tuple[Array, Array]:
        """Return velocities of the centres and of the surfaces past each other by all rates."""
        ball, ball_omega = self.ball.rates()
        socket, socket_omega = self.socket.rates()
        outward = cross_matrix(self._n)
        centre = np.hstack([ball, -socket])
        reach = self._radius + self._e
        omegas = np.hstack([outward * -self._radius @ ball_omega, outward * reach @ socket_omega])
        return centre, centre + omegas

    def _coefficient(self, sliding: Array) -> tuple[Array, Array, Array]:
        """Return the friction coefficient as a vector, its derivative and the bristle's end.

        A bristle deflects in the plane of contact; its length along the sliding follows the law of
        the plane, the rest of it relaxes with the same time constant.
        """
        speed = float(np.sqrt(sliding @ sliding))
        along = sliding / speed if speed > 0.0 else np.zeros(3)
        if not isinstance(self._friction, LuGre):
            mu, slope = self._friction(speed)
            secant = mu / speed if speed > 0.0 else slope
            turning = np.eye(3) - np.outer(along, along)
            return along * mu, np.outer(along, along) * slope + turning * secant, self._bristle
        friction, step = self._friction, self._step
        bristle = self._bristle - self._n * (self._n @ self._bristle)
        deflection = float(along @ bristle)
        start = float(along @ self._sliding_before) if self._sliding_before is not None else None
        mu, slope, end = friction.advance(speed, deflection, step, start)
        _, _, decay = friction.advance(speed, 1.0, step, start)
        _, _, rest = friction.advance(speed, 0.0, step, start)
        aside = (bristle - along * deflection) * (decay - rest)
        rate = aside * (friction.rate(speed, 1.0) - speed)
        vector = along * mu + aside * friction.sigma_0 + rate * friction.damping(speed)[0]
        return vector, np.eye(3) * slope, along * end + aside


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return x, y, z


def _cross(v: Array, w: Array) -> Array:
    """Return v x w; a tenth of numpy's time for two vectors."""
    return np.array(cross(_vector(v), _vector(w)))
