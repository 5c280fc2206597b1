"""One end of a guided body in its guideway: they touch on either side, and rub.

The body's point lies beside the guideway's middle by s; they touch where |s| > c, on one side or
the other. The normal is the guideway's and does not turn, as a journal's does with its
eccentricity; all else is a dry interface's: the body's half width is its lever of friction, as the
radius is a journal's.
"""

from math import cos, sin

import numpy as np

from exu_press.joints.ends import BodyEnd, Vector
from exu_press.joints.interface import DryInterface, InterfaceJoint, Load
from exu_press.joints.planar import PlanarEnd
from exu_press.joints.spatial import SpatialRevolute

__all__ = ["GuidewayContact", "SpatialGuidewayContact"]


class GuidewayContact(InterfaceJoint):
    """A point of a planar body in a straight guideway of the frame."""

    def __init__(
        self,
        end: PlanarEnd,
        middle: tuple[float, float],
        across: tuple[float, float],
        interface: DryInterface,
    ) -> None:
        """Let a body touch its guideway.

        Args:
            end: the point of the body.
            middle: a point in the middle of the guideway, m.
            across: unit vector across it.
            interface: of surfaces; its radius is the body's half width, m.
        """
        super().__init__(list(end.indices), [interface], turns=False)
        self.end = end
        self._length, self._angle = end.length, end.direction
        self._x, self._y = end.reference[0] - middle[0], end.reference[1] - middle[1]
        self._across = across
        # the normal, and the arm of the point
        self._directions = across[0], across[1], 0.0, 0.0

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the generalised forces to `out`."""
        at_x, at_y, at_angle = self.indices
        angle = self._angle + q[at_angle]
        arm_x, arm_y = self._length * cos(angle), self._length * sin(angle)
        omega = q_t[at_angle]
        across_x, across_y = self._across
        beside = (q[at_x] + self._x + arm_x) * across_x
        beside += (q[at_y] + self._y + arm_y) * across_y
        side = 1.0 if beside >= 0.0 else -1.0
        n_x, n_y = side * across_x, side * across_y
        u, v = q_t[at_x] - omega * arm_y, q_t[at_y] + omega * arm_x
        self._directions = n_x, n_y, arm_x, arm_y
        motion = side * beside, u * n_x + v * n_y, v * n_x - u * n_y, omega, 0.0
        (load,) = self._load(motion)
        if load is not None:
            f_n, f_t, moment, _, _ = load
            f_x, f_y = f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x
            out[at_x] += f_x
            out[at_y] += f_y
            out[at_angle] += moment + arm_x * f_y - arm_y * f_x

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t) at the state of the last `add_force`, by rows."""
        load: Load | None = self._loads[0]
        if load is None:
            return None
        _, _, _, omega, _ = self._motion
        n_x, n_y, arm_x, arm_y = self._directions
        f_n, f_t, _, _, _ = load
        (n_e, n_r, n_v, n_w, _), (t_e, t_r, t_v, t_w, _) = self._partials(0, load)
        arm_n, arm_t = arm_x * n_x + arm_y * n_y, arm_y * n_x - arm_x * n_y
        # f_n and f_t by x, y and angle; the angle moves the point by -arm_t n + arm_n t, and turns
        # its velocity by -omega arm
        out_n, side_n = by_q * n_e + by_q_t * n_r, by_q_t * n_v
        out_t, side_t = by_q * t_e + by_q_t * t_r, by_q_t * t_v
        turning = by_q * omega
        n_1, n_2 = out_n * n_x - side_n * n_y, out_n * n_y + side_n * n_x
        t_1, t_2 = out_t * n_x - side_t * n_y, out_t * n_y + side_t * n_x
        n_3 = arm_n * side_n - arm_t * out_n - turning * (n_r * arm_n + n_v * arm_t)
        t_3 = arm_n * side_t - arm_t * out_t - turning * (t_r * arm_n + t_v * arm_t)
        n_3 += by_q_t * n_w
        t_3 += by_q_t * t_w
        lever = self.interfaces[0].arms(self._motion[0])[0]
        x_1, x_2, x_3 = n_x * n_1 - n_y * t_1, n_x * n_2 - n_y * t_2, n_x * n_3 - n_y * t_3
        y_1, y_2, y_3 = n_y * n_1 + n_x * t_1, n_y * n_2 + n_x * t_2, n_y * n_3 + n_x * t_3
        m_1 = lever * t_1 + arm_n * t_1 - arm_t * n_1
        m_2 = lever * t_2 + arm_n * t_2 - arm_t * n_2
        m_3 = lever * t_3 + arm_n * t_3 - arm_t * n_3 - by_q * (arm_n * f_n + arm_t * f_t)
        return [-x_1, -x_2, -x_3, -y_1, -y_2, -y_3, -m_1, -m_2, -m_3]

    def in_frame(self, along_n: float, along_t: float) -> tuple[float, ...]:
        """Return a vector across and along the guideway in the global frame."""
        n_x, n_y, _, _ = self._directions
        return along_n * n_x - along_t * n_y, along_n * n_y + along_t * n_x


class SpatialGuidewayContact(SpatialRevolute):
    """The same for bodies in space and flexible ones: a joint whose normal stays."""

    def __init__(
        self,
        end: BodyEnd,
        middle: tuple[float, float],
        across: tuple[float, float],
        interface: DryInterface,
    ) -> None:
        """Let a body touch its guideway in the plane z = 0; see `GuidewayContact`."""
        x, y = middle
        frame = BodyEnd("Ground", 0, np.zeros(0), np.array([x, y, 0.0]))
        super().__init__(end, frame, (0.0, 0.0, 1.0), [interface], turns=False)
        self._normal = across

    def _eccentricity_and_normal(self, apart: Vector) -> tuple[float, Vector]:
        """Return how far the point lies beside the middle, m, and the normal on that side."""
        x, y = self._normal
        beside = apart[0] * x + apart[1] * y
        return (beside, (x, y, 0.0)) if beside >= 0.0 else (-beside, (-x, -y, 0.0))
