"""A planar joint whose film depends on where in its bearing the journal is, as with grooves."""

from collections.abc import Sequence
from math import atan2

from exu_press.joints.interface import FilmInterface, InterfaceLaw, Load
from exu_press.joints.planar import PlanarEnd, PlanarJoint
from exu_press.laws.film.grooved_table import GroovedFilm

__all__ = ["GroovedInterface", "OrientedJoint"]

TURNED = 1e-5
"""rad, over which the force's change with the angle is differenced."""


class GroovedInterface(FilmInterface):
    """A film in a bearing with grooves; `law` has the angle of the eccentricity in the bearing."""

    is_oriented = True
    law: GroovedFilm

    def __init__(self, law: GroovedFilm, scale: float, clearance: float) -> None:
        """Fill the gap between two surfaces; arguments as of `FilmInterface`."""
        super().__init__(law, scale, clearance)

    def orient(self, angle: float) -> None:
        """Take the angle of the eccentricity in the bearing, rad, before `load`."""
        self.law.angle = angle

    def turn_partials(
        self, load: Load, motion: tuple[float, float, float, float, float]
    ) -> tuple[float, float, float, float]:
        """Return the derivatives of f_n, f_t and both moments by the angle, by a difference."""
        angle = self.law.angle
        self.law.angle = angle + TURNED
        ahead = self.load(*motion)
        self.law.angle = angle
        assert ahead is not None
        (f_n, f_t, m_j, m_b, _), (n_0, t_0, j_0, b_0, _) = ahead, load
        changes = f_n - n_0, f_t - t_0, m_j - j_0, m_b - b_0
        by_n, by_t, by_j, by_b = (change / TURNED for change in changes)
        return by_n, by_t, by_j, by_b


class OrientedJoint(PlanarJoint):
    """A planar joint that tells its grooved film where in the bearing the journal is.

    Attributes:
        orientation: angle of the eccentricity in the bearing at the last `add_force`, rad.
    """

    def __init__(
        self,
        journal: PlanarEnd,
        bearing: PlanarEnd,
        interfaces: Sequence[InterfaceLaw],
        bearing_turned: float = 0.0,
    ) -> None:
        """Join the two ends.

        Args:
            journal, bearing, interfaces: as of `PlanarJoint`.
            bearing_turned: angle of the frame in which the grooves' angles count, in that of the
                bearing's item, rad.
        """
        super().__init__(journal, bearing, interfaces)
        self.orientation = (0.0,)
        self._turned = bearing.reference[2] + bearing_turned

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        x, y, _, _, motion = self._move(q, q_t)
        angle = atan2(y, x) - self._turned - q[self.indices[5]]
        self.orientation = (angle,)
        for interface in self.interfaces:
            interface.orient(angle)
        n_x, n_y = self._directions[0], self._directions[1]
        for load in self._load(motion):
            if load is not None:
                f_n, f_t, m_j, m_b, _ = load
                self._exert(f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x, m_j, m_b, out)

    def _jacobian_of(self, i: int, load: Load, by_q: float, by_q_t: float) -> list[float]:
        """Return one interface's part of the Jacobian, with the change over the angle."""
        matrix = super()._jacobian_of(i, load, by_q, by_q_t)
        interface, e = self.interfaces[i], self._motion[0]
        if not isinstance(interface, GroovedInterface) or e == 0.0:
            return matrix
        f_n, f_t, m_j, m_b = interface.turn_partials(load, self._motion)
        n_x, n_y, j_x, j_y, b_x, b_y = self._directions
        f_x, f_y = f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x
        forces = (
            f_x, f_y, m_j + j_x * f_y - j_y * f_x,
            -f_x, -f_y, m_b - b_x * f_y + b_y * f_x,
        )  # fmt: skip
        t_x, t_y = -n_y / e, n_x / e  # the angle's derivatives by the eccentricity
        angles = (
            t_x, t_y, t_y * j_x - t_x * j_y,
            -t_x, -t_y, t_x * b_y - t_y * b_x - 1.0,
        )  # fmt: skip
        for row, force in enumerate(forces):
            for column, angle in enumerate(angles):
                matrix[6 * row + column] -= by_q * force * angle
        return matrix
