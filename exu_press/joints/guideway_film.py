"""The oil films between a guided body and its guideways: a pad on either side.

The gaps at the body's two ends follow from how far these lie beside the guideway's middle, and the
films' forces act at the ends, across the guideway and along it, and their opposite at the same
points on the body that has the guideway, with which it turns. The sliding velocity is that of the
body's face, half a width beside its middle.
"""

import math

import numpy as np

from exu_press.joints.ends import BodyEnd, Vector, cross, rotate
from exu_press.joints.joint import ClearanceJoint, JointState
from exu_press.laws.film.plane_pad import PadFilm, PadLaw
from exu_press.numerics.arrays import Array

__all__ = ["GuidewayFilm"]


class GuidewayFilm(ClearanceJoint):
    """Two films in a body's guideway; contacts are joints beside it."""

    def __init__(
        self,
        rear: BodyEnd,
        front: BodyEnd,
        line: BodyEnd,
        along: tuple[float, float],
        *,
        law: PadLaw,
        viscosity: float,
        clearance: float,
        contact_onset: float,
        length: float,
        half_width: float,
    ) -> None:
        """Fill the gaps.

        Args:
            rear: end of the body that lies behind in the direction of the guideway.
            front: the other end, of the same body.
            line: a point in the middle of the guideway, of the body that has it or of the frame.
            along: unit vector along it, in that body's frame.
            law: of a pad, that goes on where the surfaces touch.
            viscosity: dynamic, Pa s.
            clearance: on each side, m.
            contact_onset: displacement at which surfaces touch, m.
            length: distance of the ends, m.
            half_width: of the body across the guideway, m.
        """
        assert rear.indices == front.indices
        super().__init__(
            [*rear.indices, *line.indices], clearance, contact_onset, math.inf, lubricated=True
        )
        self._ends, self._line = (rear, front), line
        self._drawn: Vector = (along[0], along[1], 0.0)
        self._along: Vector = self._drawn
        self._across: Vector = (along[1], -along[0], 0.0)
        self._law, self._viscosity = law, viscosity
        self._length, self._half_width = length, half_width
        self._places = self._rates = 0.0, 0.0
        self._sliding = self._turning = 0.0
        self._loads = 0.0, 0.0, 0.0, 0.0
        self._films: list[tuple[float, PadFilm]] = []

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the generalised forces to `out`."""
        rear, front = self._ends
        for end in (rear, front, self._line):
            end.move(q, q_t)
        self._along = along_x, along_y, _ = rotate(self._line.rotation, self._drawn)
        self._across = along_y, -along_x, 0.0
        velocities = self._relative_velocity(rear), self._relative_velocity(front)
        self._places = beside_1, beside_2 = (
            self._lateral_displacement(rear),
            self._lateral_displacement(front),
        )
        self._rates = rate_1, rate_2 = (
            _in(velocities[0], self._across),
            _in(velocities[1], self._across),
        )
        moving = _in(velocities[0], self._along), _in(velocities[1], self._along)
        self._sliding = sliding = 0.5 * (moving[0] + moving[1])
        turning = rear.angular_velocity[2] - self._line.angular_velocity[2]
        self._turning = turning
        across_1 = across_2 = along = moment = 0.0
        self._films = []
        for side in (1.0, -1.0):
            film = self._law(
                self.clearance - side * beside_1,
                self.clearance - side * beside_2,
                -side * rate_1,
                -side * rate_2,
                sliding + side * self._half_width * turning,
            )
            self._films.append((side, film))
            across_1 -= side * film[0]
            across_2 -= side * film[1]
            along += film[2]
            moment += side * self._half_width * film[2]
        mu = self._viscosity
        self._loads = mu * across_1, mu * across_2, mu * along, mu * moment
        for end, across, turn in zip(self._ends, self._loads[:2], (mu * moment, 0.0), strict=True):
            x, y = self._in_plane(across, 0.5 * mu * along)
            end.add_forces((x, y, 0.0), (0.0, 0.0, turn), out)
            arm_x, arm_y, _ = self._arm(end)
            opposite = arm_y * x - arm_x * y - turn
            self._line.add_forces((-x, -y, 0.0), (0.0, 0.0, opposite), out)

    def jacobian(self, by_q: float, by_q_t: float) -> Array:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t), less the terms of turning arms, by rows."""
        # both ends' forces across, the force along and the moment, by the gaps, rates and U
        partials = [[0.0] * 4 for _ in range(4)]
        for side, film in self._films:
            lever = side * self._half_width
            for row, factor, first in (
                (partials[0], -side, 3),
                (partials[1], -side, 8),
                (partials[2], 1.0, 13),
                (partials[3], lever, 13),
            ):
                gap_1, gap_2, rate_1, rate_2, sliding = film[first : first + 5]
                row[0] -= side * factor * (by_q * gap_1 + by_q_t * rate_1)
                row[1] -= side * factor * (by_q * gap_2 + by_q_t * rate_2)
                row[2] += factor * by_q_t * sliding
                row[3] += factor * lever * by_q_t * sliding
        nowhere, axis = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
        n, t = self._across, self._along
        rear, front = (
            np.hstack(
                [
                    end.rates_along(n, t, axis, nowhere),
                    -self._line.rates_along(n, t, axis, self._arm(end)),
                ]
            )
            for end in self._ends
        )
        rates = np.array((rear[0], front[0], 0.5 * (rear[1] + front[1]), rear[2]))
        return np.asarray(rates.T @ (-self._viscosity * np.array(partials) @ rates)).ravel()

    @property
    def state(self) -> JointState:
        """The films' state; the moments are the couple of the ends' forces and the drag's.

        The force acts in the middle between the ends.
        """
        across_1, across_2, _, moment = self._loads
        rate_1, rate_2 = self._rates
        couple, tilting = 0.5 * self._length * (across_1 - across_2), (rate_1 - rate_2)
        return JointState(
            eccentricity=self.eccentricity,
            force=self.force,
            velocity=self._in_plane(0.5 * (rate_1 + rate_2), self._sliding),
            moments=(couple, moment),
            angular_velocities=(tilting / self._length, self._turning),
            gap=self.clearance - max(abs(displacement) for displacement in self._places),
            stored_energy=0.0,
            stored_power=0.0,
        )

    @property
    def eccentricity(self) -> tuple[float, ...]:
        """Displacement of the body's middle from the guideway's at the last `add_force`, m."""
        return self._in_plane(0.5 * (self._places[0] + self._places[1]), 0.0)

    @property
    def relative_velocity(self) -> tuple[float, ...]:
        """Rate of the eccentricity at the last `add_force`, m/s; the guideway turns it."""
        middle = 0.5 * (self._places[0] + self._places[1])
        x, y = self._in_plane(0.5 * (self._rates[0] + self._rates[1]), 0.0)
        a, b, _ = cross(self._line.angular_velocity, self._across)
        return x + middle * a, y + middle * b

    @property
    def force(self) -> tuple[float, ...]:
        """Force on the body at the last `add_force`, N."""
        across_1, across_2, along, _ = self._loads
        return self._in_plane(across_1 + across_2, along)

    def _in_plane(self, across: float, along: float) -> tuple[float, float]:
        """Return a vector across and along the guideway in the global frame."""
        n, t = self._across, self._along
        return across * n[0] + along * t[0], across * n[1] + along * t[1]

    def _lateral_displacement(self, end: BodyEnd) -> float:
        """Return the displacement of an end from the guideway's middle, m."""
        return _in(self._arm(end), self._across)

    def _arm(self, end: BodyEnd) -> Vector:
        """Return the vector from the middle of the guideway to an end, m."""
        (x, y, z), (line_x, line_y, line_z) = end.position, self._line.position
        return x - line_x, y - line_y, z - line_z

    def _relative_velocity(self, end: BodyEnd) -> Vector:
        """Return the velocity of an end as seen from the body that has the guideway, m/s."""
        u, v, w = self._line.velocity
        a, b, c = cross(self._line.angular_velocity, self._arm(end))
        x, y, z = end.velocity
        return x - u - a, y - v - b, z - w - c


def _in(v: Vector, direction: Vector) -> float:
    return v[0] * direction[0] + v[1] * direction[1]
