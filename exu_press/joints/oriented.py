"""A planar joint whose film depends on where in its bearing the journal is: grooves, a tilt."""

from collections.abc import Sequence
from math import atan2

from exu_press.joints.interface import (
    FilmInterface,
    InterfaceLaw,
    Load,
    Motion,
    Partials,
    Response,
)
from exu_press.joints.planar import PlanarEnd, PlanarJoint
from exu_press.laws.film.grooved_table import GroovedFilm
from exu_press.laws.film.pressurized import PressurizedFilm
from exu_press.laws.film.tilted import TiltedFilm
from exu_press.numerics.arrays import Array

__all__ = ["GroovedInterface", "OrientedJoint", "PressurizedInterface", "TiltedInterface"]

TURNED = 1e-5
"""rad, over which the force's change with the angle is differenced."""


class GroovedInterface(FilmInterface):
    """A film in a bearing with grooves; `law` has the angle of the eccentricity in the bearing."""

    is_oriented = True
    law: GroovedFilm | TiltedFilm

    def __init__(self, law: GroovedFilm | TiltedFilm, scale: float, clearance: float) -> None:
        """Fill the gap between two surfaces; arguments as of `FilmInterface`."""
        super().__init__(law, scale, clearance)

    def orient(self, angle: float) -> None:
        """Take the angle of the eccentricity in the bearing, rad, before `load`."""
        self.law.angle = angle

    def side_flow(
        self, eps: Array, eps_dot: Array, eps_w: Array, angle: Array, spin: Array
    ) -> Array:
        """Return the side flow over L R c, (n,), 1/s, of states of the film."""
        assert isinstance(self.law, GroovedFilm)
        return self.law.side_flow(eps, eps_dot, eps_w, angle)

    def turn_partials(self, load: Load, motion: Motion) -> tuple[float, float, float, float]:
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


class PressurizedInterface(GroovedInterface):
    """A film between journal and bearing that a pump feeds, and which bears a journal at rest.

    Its power is that of `FilmInterface`, and the pump's beside it.
    """

    bears_at_rest = True
    law: PressurizedFilm

    def __init__(
        self, law: PressurizedFilm, scale: float, clearance: float, supply_force: float
    ) -> None:
        """Fill the gap between two surfaces.

        Args:
            law, scale, clearance: as of `FilmInterface`.
            supply_force: largest pressure of the grooves times length times radius, N.
        """
        super().__init__(law, scale, clearance)
        self._supply_force = supply_force

    def orient(self, angle: float) -> None:
        """Take the angle of the eccentricity in the bearing, rad, before `load`."""
        self.law.angle = angle
        self.law.supply = self._supply_force / (12.0 * self.scale)

    @property
    def pump_power(self) -> float:
        """Power that the pump puts in, W, at the last `load`."""
        return self.scale * self.clearance * self.law.pump_power


class TiltedInterface(GroovedInterface):
    """The film of an inclined journal, whose rotation in its bearing makes pressure by itself.

    The couple of the inclination, which `TiltedFilm` has, is part of the shear's. Newton's method
    has its derivatives by |e| and by the spin.
    """

    law: TiltedFilm

    @property
    def reach(self) -> float:
        """Eccentricity at which the journal touches an end of the bearing, m."""
        return self.clearance * self.law.largest_ratio(self.law.angle)

    def gap(self, e: float) -> float:
        """Return the least thickness of the film, at an end, m."""
        return self.clearance * self.law.least_gap(e / self.clearance, self.law.angle)

    def load(
        self, e: float, e_dot: float, v_t: float, omega_j: float, omega_b: float
    ) -> Load | None:
        """Return force and moments; NaN where the journal touches."""
        c, p, spin = self.clearance, self.scale, omega_j - omega_b
        eps_w = (e * (omega_j + omega_b) - 2.0 * v_t) / c
        self.law.spin = spin
        response = self.law.respond(e / c, e_dot / c, eps_w)
        f_r, f_t, couple = p * response[0], p * response[1], 0.5 * p * c * response[10]
        if f_r == f_r:
            self.outside = None
        elif e == e:
            self.outside = e / c
        if e_dot == 0.0 and eps_w == 0.0 and spin == 0.0 and f_r == f_r:
            f_r = f_t = couple = 0.0
        moment = -0.5 * e * f_t
        shear = p * c * response[8] * spin + couple
        return f_r, f_t, moment - shear, moment + shear, response

    def partials(self, response: Response, e: float, omega_j: float, omega_b: float) -> Partials:
        """Return the derivatives of the force, also by the spin."""
        of_n, of_t = super().partials(response[:10], e, omega_j, omega_b)
        n_spin, t_spin = -0.5 * self.scale * response[13], 0.5 * self.scale * response[14]
        return (
            (*of_n[:3], of_n[3] + n_spin, of_n[4] - n_spin),
            (*of_t[:3], of_t[3] + t_spin, of_t[4] - t_spin),
        )

    def shear_partials(
        self, response: Response, omega_j: float, omega_b: float
    ) -> tuple[float, float]:
        """Return the derivatives of both couples by |e| and by the spin."""
        by_e, by_spin = super().shear_partials(response[:10], omega_j, omega_b)
        p = self.scale
        by_e += 0.5 * p * (response[11] + 0.5 * response[14] * (omega_j + omega_b))
        return by_e, by_spin + 0.25 * p * self.clearance * response[12]

    def turn_partials(self, load: Load, motion: Motion) -> tuple[float, float, float, float]:
        """Return the derivatives of f_n, f_t and both moments by the angle."""
        by_n, by_t, by_couple, by_shear = load[4][15:]
        e, p = motion[0], self.scale
        moment = -0.5 * e * p * by_t
        shear = p * self.clearance * (by_shear * (motion[3] - motion[4]) + 0.5 * by_couple)
        return p * by_n, p * by_t, moment - shear, moment + shear

    def side_flow(
        self, eps: Array, eps_dot: Array, eps_w: Array, angle: Array, spin: Array
    ) -> Array:
        """Return the side flow over L R c, (n,), 1/s, of states of the film."""
        return self.law.side_flow(eps, eps_dot, eps_w, angle, spin)


class OrientedJoint(PlanarJoint):
    """A planar joint that tells its grooved film where in the bearing the journal is."""

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
        self._angle = 0.0  # of the eccentricity in the bearing, rad
        self._turned = bearing.reference[2] + bearing_turned

    def _move(self, q: list[float], q_t: list[float]) -> tuple[float, float, float, float, Motion]:
        """Turn the arms, and tell the films the angle; return what `PlanarJoint` does."""
        moved = super()._move(q, q_t)
        self._angle = atan2(moved[1], moved[0]) - self._turned - q[self.indices[5]]
        for interface in self.interfaces:
            interface.orient(self._angle)
        return moved

    @property
    def orientation(self) -> tuple[float, ...]:
        """The angle of the eccentricity in the bearing, rad, and the pump's power, W."""
        return self._angle, sum([interface.pump_power for interface in self.interfaces])

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
