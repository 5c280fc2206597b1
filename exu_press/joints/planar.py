"""A clearance joint between two planar bodies: from coordinates to interface laws and back."""

from collections.abc import Sequence
from math import atan2, cos, degrees, hypot, sin, sqrt

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.joints.ends import BodyPoint, FlexiblePoint
from exu_press.joints.interface import InterfaceJoint, InterfaceLaw, Load, Motion
from exu_press.joints.user_force import user_force_of

__all__ = ["PlanarEnd", "PlanarJoint", "in_plane", "planar_end"]


class PlanarEnd:
    """A point of a planar body.

    Attributes:
        indices: where the body's x, y and angle lie among the coordinates of the joint's item; what
            is held still lies where the ground's do.
        reference: their reference values, m and rad.
        point: the point in the body's frame, m.
        length: its distance from the body's origin, m.
        direction: of the point from there in the reference, rad.
    """

    def __init__(
        self,
        indices: tuple[int, int, int],
        reference: tuple[float, float, float],
        point: tuple[float, float],
    ) -> None:
        self.indices, self.reference, self.point = indices, reference, point
        x, y = point
        self.length, self.direction = hypot(x, y), atan2(y, x) + reference[2]


def in_plane(mbs: exu.MainSystem, point: BodyPoint) -> bool:
    """Return whether a point belongs to a planar body or, in the plane, to the ground."""
    if isinstance(point, FlexiblePoint):
        return False
    kind = mbs.GetObject(point[0])["objectType"]
    planar = kind in ("RigidBody2D", "Mass1D", "RotationalMass1D")
    return planar or (kind == "Ground" and (len(point[1]) < 3 or point[1][2] == 0))


def planar_end(mbs: exu.MainSystem, point: BodyPoint) -> PlanarEnd:
    """Return the end on a planar body or the ground.

    Raises:
        InputError: a body of one coordinate is tilted, or moves neither along x nor along y.
    """
    assert not isinstance(point, FlexiblePoint)
    body, centre = point
    item = mbs.GetObject(body)
    local = (float(centre[0]), float(centre[1]))
    user_force = user_force_of(mbs)
    still = user_force.index_of(None)
    indices = still, still + 1, still + 2
    if item["objectType"] == "Ground":
        x, y, _ = (float(value) for value in item["referencePosition"])
        return PlanarEnd(indices, (x, y, 0.0), local)
    node = int(item["nodeNumber"])
    first = user_force.index_of(node)
    start = [float(v) for v in mbs.GetNodeParameter(node, "referenceCoordinates")]
    if item["objectType"] == "RigidBody2D":
        x, y, angle = start
        return PlanarEnd((first, first + 1, first + 2), (x, y, angle), local)
    rotation = np.array(item["referenceRotation"])
    if rotation[2, 2] != 1.0:
        raise InputError(f"body {body} is tilted: allowed in the plane is its z along the global z")
    x, y, _ = (float(value) for value in item["referencePosition"])
    angle = atan2(rotation[1, 0], rotation[0, 0])
    if item["objectType"] == "RotationalMass1D":
        return PlanarEnd((indices[0], indices[1], first), (x, y, angle + start[0]), local)
    reference = x + start[0] * float(rotation[0, 0]), y + start[0] * float(rotation[1, 0]), angle
    if tuple(rotation[:2, 0]) == (1.0, 0.0):
        return PlanarEnd((first, indices[1], indices[2]), reference, local)
    if tuple(rotation[:2, 0]) == (0.0, 1.0):
        return PlanarEnd((indices[0], first, indices[2]), reference, local)
    raise InputError(f"body {body} moves at {degrees(angle):g} deg: allowed are 0 (x), 90 (y)")


class PlanarJoint(InterfaceJoint):
    """One journal in one bearing, acting through one interface or several in parallel."""

    def __init__(
        self, journal: PlanarEnd, bearing: PlanarEnd, interfaces: Sequence[InterfaceLaw]
    ) -> None:
        super().__init__([*journal.indices, *bearing.indices], interfaces)
        self.journal = journal
        self.bearing = bearing
        self._length_j, self._angle_j = journal.length, journal.direction
        self._length_b, self._angle_b = bearing.length, bearing.direction
        self._far = journal.reference[0] - bearing.reference[0]
        self._high = journal.reference[1] - bearing.reference[1]
        # the direction from centre to centre, and both arms
        self._directions = 1.0, 0.0, 0.0, 0.0, 0.0, 0.0

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        motion = self._move(q, q_t)[4]
        n_x, n_y = self._directions[0], self._directions[1]
        for load in self._load(motion):
            if load is not None:
                f_n, f_t, m_j, m_b, _ = load
                self._exert(f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x, m_j, m_b, out)

    def _move(self, q: list[float], q_t: list[float]) -> tuple[float, float, float, float, Motion]:
        """Turn the arms; return eccentricity and rate in the global frame, and the motion."""
        x_j, y_j, phi_j, x_b, y_b, phi_b = self.indices
        angle_j, angle_b = self._angle_j + q[phi_j], self._angle_b + q[phi_b]
        j_x, j_y = self._length_j * cos(angle_j), self._length_j * sin(angle_j)
        b_x, b_y = self._length_b * cos(angle_b), self._length_b * sin(angle_b)
        w_j, w_b = q_t[phi_j], q_t[phi_b]
        x = q[x_j] - q[x_b] + self._far + j_x - b_x
        y = q[y_j] - q[y_b] + self._high + j_y - b_y
        u = q_t[x_j] - q_t[x_b] - w_j * j_y + w_b * b_y
        v = q_t[y_j] - q_t[y_b] + w_j * j_x - w_b * b_x
        e = sqrt(x * x + y * y)
        n_x, n_y = (x / e, y / e) if e > 0.0 else (1.0, 0.0)
        self._directions = n_x, n_y, j_x, j_y, b_x, b_y
        return x, y, u, v, (e, u * n_x + v * n_y, v * n_x - u * n_y, w_j, w_b)

    def _exert(self, f_x: float, f_y: float, m_j: float, m_b: float, out: list[float]) -> None:
        """Add the force on the journal, its opposite on the bearing and both moments to `out`."""
        x_j, y_j, phi_j, x_b, y_b, phi_b = self.indices
        _, _, j_x, j_y, b_x, b_y = self._directions
        out[x_j] += f_x
        out[y_j] += f_y
        out[phi_j] += m_j + j_x * f_y - j_y * f_x
        out[x_b] -= f_x
        out[y_b] -= f_y
        out[phi_b] += m_b - b_x * f_y + b_y * f_x

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t) at the state of the last `add_force`.

        Exact in the first state; then a film's dependence on its speeds is a secant.

        Q are the six generalised forces, q the journal's and the bearing's coordinates; 36 numbers,
        row by row. None where no interface acts.
        """
        matrix: list[float] | None = None
        for i, load in enumerate(self._loads):
            if load is not None:
                block = self._jacobian_of(i, load, by_q, by_q_t)
                if matrix is None:
                    matrix = block
                else:
                    for k, value in enumerate(block):
                        matrix[k] += value
        return matrix

    def _jacobian_of(self, i: int, load: Load, by_q: float, by_q_t: float) -> list[float]:
        """Return one interface's part of the Jacobian."""
        e, e_dot, v_t, w_j, w_b = self._motion
        n_x, n_y, j_x, j_y, b_x, b_y = self._directions
        f_n, f_t, _, _, response = load
        (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = self._partials(i, load)
        lever_j, lever_b, slope_j, slope_b = self.interfaces[i].arms(e)
        shear_e, shear_w = self.interfaces[i].shear_partials(response, w_j, w_b)
        slope_j = by_q * (slope_j * f_t - shear_e)
        slope_b = by_q * (slope_b * f_t + shear_e)
        shear_w *= by_q_t
        # the arms of the two points along n and along t
        j_n, j_t = j_x * n_x + j_y * n_y, j_y * n_x - j_x * n_y
        b_n, b_t = b_x * n_x + b_y * n_y, b_y * n_x - b_x * n_y
        # f_n and f_t by a motion along n and along t; the direction turns with the latter, and the
        # force with the direction, which has no derivative at e = 0
        turn = by_q / e if e > 0.0 else 0.0
        n_out = by_q * n_e + by_q_t * n_r
        n_side = by_q_t * n_v + turn * (n_r * v_t - n_v * e_dot - f_t)
        t_out = by_q * t_e + by_q_t * t_r
        t_side = by_q_t * t_v + turn * (t_r * v_t - t_v * e_dot)
        turn *= f_n
        # for each coordinate: f_n, f_t (the drag) and, with the force's turning, its part along t;
        # an angle moves its point along i arm and turns that point's velocity by -omega arm
        n_1, drag_1 = n_out * n_x - n_side * n_y, t_out * n_x - t_side * n_y
        n_2, drag_2 = n_out * n_y + n_side * n_x, t_out * n_y + t_side * n_x
        omega = by_q * w_j
        n_3 = by_q_t * n_wj + j_n * (n_side - omega * n_r) - j_t * (n_out + omega * n_v)
        drag_3 = by_q_t * t_wj + j_n * (t_side - omega * t_r) - j_t * (t_out + omega * t_v)
        omega = by_q * w_b
        n_4 = by_q_t * n_wb - b_n * (n_side - omega * n_r) + b_t * (n_out + omega * n_v)
        drag_4 = by_q_t * t_wb - b_n * (t_side - omega * t_r) + b_t * (t_out + omega * t_v)
        t_1, t_2 = drag_1 - turn * n_y, drag_2 + turn * n_x
        t_3, t_4 = drag_3 + turn * j_n, drag_4 - turn * b_n
        # force, moment on the journal's and moment on the bearing's body, by each coordinate
        x_1, x_2, x_3, x_4 = (
            n_x * n_1 - n_y * t_1,
            n_x * n_2 - n_y * t_2,
            n_x * n_3 - n_y * t_3,
            n_x * n_4 - n_y * t_4,
        )
        y_1, y_2, y_3, y_4 = (
            n_y * n_1 + n_x * t_1,
            n_y * n_2 + n_x * t_2,
            n_y * n_3 + n_x * t_3,
            n_y * n_4 + n_x * t_4,
        )
        j_1 = lever_j * drag_1 + slope_j * n_x - j_t * n_1 + j_n * t_1
        j_2 = lever_j * drag_2 + slope_j * n_y - j_t * n_2 + j_n * t_2
        j_3 = lever_j * drag_3 - (slope_j + n_3) * j_t + j_n * t_3
        j_4 = lever_j * drag_4 + slope_j * b_t - j_t * n_4 + j_n * t_4
        b_1 = lever_b * drag_1 + slope_b * n_x + b_t * n_1 - b_n * t_1
        b_2 = lever_b * drag_2 + slope_b * n_y + b_t * n_2 - b_n * t_2
        b_3 = lever_b * drag_3 - slope_b * j_t + b_t * n_3 - b_n * t_3
        b_4 = lever_b * drag_4 + (slope_b + n_4) * b_t - b_n * t_4
        j_3 -= by_q * (j_n * f_n + j_t * f_t) + shear_w
        j_4 += shear_w
        b_3 += shear_w
        b_4 += by_q * (b_n * f_n + b_t * f_t) - shear_w
        return [
            -x_1, -x_2, -x_3, x_1, x_2, -x_4,
            -y_1, -y_2, -y_3, y_1, y_2, -y_4,
            -j_1, -j_2, -j_3, j_1, j_2, -j_4,
            x_1, x_2, x_3, -x_1, -x_2, x_4,
            y_1, y_2, y_3, -y_1, -y_2, y_4,
            -b_1, -b_2, -b_3, b_1, b_2, -b_4,
        ]  # fmt: skip

    def in_frame(self, along_n: float, along_t: float) -> tuple[float, ...]:
        """Return a vector of the plane at the last `add_force` in the global frame."""
        n_x, n_y, _, _, _, _ = self._directions
        return along_n * n_x - along_t * n_y, along_n * n_y + along_t * n_x
