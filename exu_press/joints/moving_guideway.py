"""A point of a body in a guideway or a slot of another moving body: they touch on either wall.

The point lies beside the middle between the walls by s, measured in the frame of the body that has
them, straight across or, in a circular slot, from its circle. They touch where |s| > c. Forces act
on both bodies at the one point of contact, so that momentum is kept; the normal turns with the body
that has the walls.

With the rows A_n and A_t that give the rate of |s| and the sliding velocity by all rates, the
generalised forces are Q = f_n A_n + f_t A_t.
"""

from math import cos, hypot, sin

from exu_press.joints.interface import DryInterface, InterfaceJoint, Load
from exu_press.joints.planar import PlanarEnd

__all__ = ["MovingGuidewayContact"]


class MovingGuidewayContact(InterfaceJoint):
    """A point of a planar body between the walls of another one, or of the frame."""

    def __init__(
        self,
        end: PlanarEnd,
        line: PlanarEnd,
        across: float,
        interface: DryInterface,
        radius: float | None = None,
    ) -> None:
        """Let a body touch the walls.

        Args:
            end: the point of the body.
            line: a point in the middle between straight walls, or the centre of a circular slot.
            across: angle of the normal of straight walls in the frame of the line's body, rad.
            interface: of surfaces; its radius is the lever of friction, m.
            radius: of the circle of a circular slot, m; None: straight.
        """
        super().__init__([*end.indices, *line.indices], [interface], turns=False)
        self.end, self.line = end, line
        self._length_j, self._angle_j = end.length, end.direction
        self._length_b, self._angle_b = line.length, line.direction
        self._across, self._radius = across + line.reference[2], radius
        self._far = end.reference[0] - line.reference[0]
        self._high = end.reference[1] - line.reference[1]
        self._normal, self._turning_rate = (1.0, 0.0), 0.0  # and how fast it turns, rad/s
        self._rows: tuple[list[float], list[float]] = [0.0] * 6, [0.0] * 6

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the generalised forces to `out`."""
        x_j, y_j, phi_j, x_b, y_b, phi_b = self.indices
        angle_j, angle_b = self._angle_j + q[phi_j], self._angle_b + q[phi_b]
        j_x, j_y = self._length_j * cos(angle_j), self._length_j * sin(angle_j)
        # from the centre of the body with the walls to the point
        r_x, r_y = q[x_j] - q[x_b] + self._far + j_x, q[y_j] - q[y_b] + self._high + j_y
        b_x, b_y = self._length_b * cos(angle_b), self._length_b * sin(angle_b)
        x, y = r_x - b_x, r_y - b_y
        curvature = 0.0
        if self._radius is None:
            angle = self._across + q[phi_b]
            n_x, n_y = cos(angle), sin(angle)
            beside = x * n_x + y * n_y
        else:
            distance = hypot(x, y)
            n_x, n_y = x / distance, y / distance
            beside, curvature = distance - self._radius, 1.0 / distance
        if beside < 0.0:
            n_x, n_y, beside, curvature = -n_x, -n_y, -beside, -curvature
        self._normal = n_x, n_y
        lever = self.interfaces[0].arms(beside)[0]
        turn_j, turn_b = j_x * n_y - j_y * n_x, r_x * n_y - r_y * n_x
        side_j, side_b = j_x * n_x + j_y * n_y + lever, r_x * n_x + r_y * n_y + lever
        normal = [n_x, n_y, turn_j, -n_x, -n_y, -turn_b]
        along = [-n_y, n_x, side_j, n_y, -n_x, -side_b]
        self._rows = normal, along
        rate = sliding = 0.0
        for i, a, b in zip(self.indices, normal, along, strict=True):
            rate += a * q_t[i]
            sliding += b * q_t[i]
        turning = q_t[phi_j] - q_t[phi_b]
        v_t = sliding - lever * turning
        self._turning_rate = q_t[phi_b] + curvature * v_t
        (load,) = self._load((beside, rate, v_t, turning, 0.0))
        if load is not None:
            for i, a, b in zip(self.indices, normal, along, strict=True):
                out[i] += load[0] * a + load[1] * b

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t), less the terms of turning arms, by rows."""
        load: Load | None = self._loads[0]
        if load is None:
            return None
        (n_e, n_r, n_v, _, _), (t_e, t_r, t_v, _, _) = self._partials(0, load)
        normal, along = self._rows
        by_normal, by_along = by_q * n_e + by_q_t * n_r, by_q_t * n_v
        drag_by_normal, drag_by_along = by_q * t_e + by_q_t * t_r, by_q_t * t_v
        return [
            -a * (by_normal * c + by_along * d) - b * (drag_by_normal * c + drag_by_along * d)
            for a, b in zip(normal, along, strict=True)
            for c, d in zip(normal, along, strict=True)
        ]

    @property
    def relative_velocity(self) -> tuple[float, ...]:
        """Rate of the eccentricity at the last `add_force`, m/s; the walls turn its normal."""
        return self.in_frame(self._motion[1], self._motion[0] * self._turning_rate)

    def in_frame(self, along_n: float, along_t: float) -> tuple[float, ...]:
        """Return a vector across and along the walls in the global frame."""
        n_x, n_y = self._normal
        return along_n * n_x - along_t * n_y, along_n * n_y + along_t * n_x
