"""A joint whose surfaces are worn: journal and bearing with a clearance that changes by angle.

With w(a) = w_B(a - phi_B) + w_J(a - phi_J), what is worn off bearing and journal in a direction a,
the gap there is c + w(a) - e . n(a). The surfaces touch where it is least:

    delta = max over a of  e . n(a) - c - w(a),    e . t = w' there.

Forces act along n at this place, not along the eccentricity. As a change of the place does not
change delta, d delta = n . de + w_J' dphi_J + w_B' dphi_B: these factors turn the normal force F_N
into force and moments on both bodies, so that what the contact stores is given back, what it
dissipates is F_N's own law's, and force and angular momentum are kept. Friction acts as in a round
bearing. The place is unique where c + w + w'' > 0: there the journal follows the surface.

A film is that of a round bearing of the clearance in the eccentricity's direction, c + w, instant
by instant: Reynolds' equation is not solved anew. Whatever the clearance, such a film dissipates.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, cos, sin

import numpy as np

from exu_press.joints.interface import DryInterface, FilmInterface, InterfaceLaw, Load
from exu_press.joints.joint import JointState
from exu_press.joints.planar import PlanarEnd, PlanarJoint
from exu_press.laws.profile import Profile
from exu_press.numerics.arrays import Array

__all__ = ["WornJoint", "WornSurfaces"]

EXACT = 1e-13
"""rad: to which the place of contact is found."""

ITERATIONS = 50
FAR = 0.2
"""rad: Newton's method goes no further at once, and so far where it would go astray."""

Local = tuple[float, float, float, float, float, float, float]
"""n, and of both profiles together and of each what Newton's method needs: w, w_J', w_B', w_J'',
w_B''."""


@dataclass(frozen=True)
class WornSurfaces:
    """Depths worn off a joint's surfaces, less the mean, which is in its clearance.

    Attributes:
        journal: over the angle on it.
        bearing: likewise.
        journal_turned: angle of the frame in which the journal's angles count, in its item's, rad.
        bearing_turned: likewise.
    """

    journal: Profile
    bearing: Profile
    journal_turned: float = 0.0
    bearing_turned: float = 0.0


class WornJoint(PlanarJoint):
    """A planar joint whose clearance changes by angle; see the module.

    `contact_onset` is that in the direction of the last eccentricity.
    """

    def __init__(
        self,
        journal: PlanarEnd,
        bearing: PlanarEnd,
        interfaces: Sequence[InterfaceLaw],
        worn: WornSurfaces,
    ) -> None:
        """Join the two ends by interfaces of the mean clearance."""
        super().__init__(journal, bearing, interfaces)
        self.worn = worn
        self._turned_j = journal.reference[2] + worn.journal_turned
        self._turned_b = bearing.reference[2] + worn.bearing_turned
        self._dry = any(isinstance(interface, DryInterface) for interface in interfaces)
        self._round = self.contact_onset
        self._facing = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        self._touched = self._facing
        self._touch = self._motion
        self._gap = self.clearance
        self._moving = (0.0, 0.0, 0.0, 0.0)
        self._sum = (0.0, 0.0, 0.0, 0.0)

    def add_force(self, q: list[float], q_t: list[float], out: list[float]) -> None:
        """Add the joint's generalised forces to `out`."""
        x, y, u, v, motion = self._move(q, q_t)
        self._motion_before, self._loads_before = self._motion, self._loads
        self._motion = motion
        e, _, _, w_j, w_b = motion
        self._moving = u, v, w_j, w_b
        turned_j = self._turned_j + q[self.indices[2]]
        turned_b = self._turned_b + q[self.indices[5]]
        self._facing = self._local(atan2(y, x), turned_j, turned_b)
        gap = self.clearance + self._facing[2] - e
        if self._dry:
            self._touched = t = self._contact_direction(x, y, turned_j, turned_b)
            beside = x * t[0] + y * t[1]
            gap = self.clearance + t[2] - beside
            self.contact_onset = self._round + (e - beside) + t[2]
            closing = u * t[0] + v * t[1] + w_j * t[3] + w_b * t[4]
            self._touch = beside, closing, v * t[0] - u * t[1], w_j, w_b
        self._gap = gap
        f_x = f_y = m_j = m_b = 0.0
        loads: list[Load | None] = []
        for interface in self.interfaces:
            if isinstance(interface, FilmInterface):
                at, motion = self._facing, self._motion
                scale = self._open(interface, at[2])
                load = interface.load(motion[0], motion[1], motion[2], w_j, w_b)
                self._close(interface, scale)
            else:
                at, motion = self._touched, self._touch
                interface.drift = self.path.drift + at[2]
                load = interface.load(motion[0], motion[1], motion[2], w_j, w_b)
            loads.append(load)
            if load is not None:
                f_n, f_t = load[0], load[1]
                f_x += f_n * at[0] - f_t * at[1]
                f_y += f_n * at[1] + f_t * at[0]
                m_j += load[2]
                m_b += load[3]
                if not isinstance(interface, FilmInterface):
                    m_j += f_n * at[3]
                    m_b += f_n * at[4]
        self._loads = loads
        self._sum = f_x, f_y, m_j, m_b
        self._exert(f_x, f_y, m_j, m_b, out)

    def _open(self, film: FilmInterface, worn: float) -> float:
        """Give a film the local clearance, and return its scale for `_close`."""
        scale, local = film.scale, self.clearance + worn
        film.clearance, film.scale = local, scale * (self.clearance / local) ** 2
        return scale

    def _close(self, film: FilmInterface, scale: float) -> None:
        """Give a film the mean clearance again, with which others know it."""
        film.clearance, film.scale = self.clearance, scale

    def _local(self, angle: float, turned_j: float, turned_b: float) -> Local:
        """Return the direction of an angle and the wear there."""
        j, j_1, j_2 = self.worn.journal.derivatives(angle - turned_j)
        b, b_1, b_2 = self.worn.bearing.derivatives(angle - turned_b)
        return cos(angle), sin(angle), j + b, j_1, b_1, j_2, b_2

    def _contact_direction(self, x: float, y: float, turned_j: float, turned_b: float) -> Local:
        """Return where the surfaces are nearest to each other, next to the eccentricity."""
        angle = atan2(y, x)
        at = self._facing
        for _ in range(ITERATIONS):
            uphill = y * at[0] - x * at[1] - at[3] - at[4]
            curved = x * at[0] + y * at[1] + at[5] + at[6]
            step = uphill / curved if curved > 0.0 else FAR if uphill > 0.0 else -FAR
            step = min(max(step, -FAR), FAR)
            angle += step
            at = self._local(angle, turned_j, turned_b)
            if not abs(step) > EXACT:
                break
        return at

    def jacobian(self, by_q: float, by_q_t: float) -> list[float] | None:
        """Return -(by_q dQ/dq + by_q_t dQ/dq_t) at the state of the last `add_force`, by rows."""
        by_place, by_rate = np.zeros((4, 4)), np.zeros((4, 4))
        acting = False
        for i, load in enumerate(self._loads):
            if load is not None:
                acting = True
                stiffness, damping = self._response(i, load)
                by_place += stiffness
                by_rate += damping
        if not acting:
            return None
        _, _, j_x, j_y, b_x, b_y = self._directions
        f_x, f_y, _, _ = self._sum
        _, _, w_j, w_b = self._moving
        moves = np.array(
            [
                [1.0, 0.0, -j_y, -1.0, 0.0, b_y],
                [0.0, 1.0, j_x, 0.0, -1.0, -b_x],
                [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            ]
        )
        turns = np.zeros((4, 6))  # the velocities, by the angles
        turns[0, 2], turns[1, 2] = -w_j * j_x, -w_j * j_y
        turns[0, 5], turns[1, 5] = w_b * b_x, w_b * b_y
        both = by_q * (by_place @ moves + by_rate @ turns) + by_q_t * (by_rate @ moves)
        matrix = -(moves.T @ both)
        matrix[2, 2] += by_q * (j_x * f_x + j_y * f_y)
        matrix[5, 5] -= by_q * (b_x * f_x + b_y * f_y)
        return [float(value) for value in matrix.ravel()]

    def _response(self, i: int, load: Load) -> tuple[Array, Array]:
        """Return an interface's force and moments by s = (x, y, phi_J, phi_B) and by its rates.

        Q = f_n G + f_t L and a film's couple, with G = d delta / ds and L the levers of friction.
        """
        interface = self.interfaces[i]
        film = interface if isinstance(interface, FilmInterface) else None
        at, motion = (self._facing, self._motion) if film else (self._touched, self._touch)
        n_x, n_y, _, j_1, b_1, j_2, b_2 = at
        e, _, _, w_j, w_b = motion
        f_n, f_t, _, _, response = load
        rates = np.array(self._moving)
        across = np.array([-n_y, n_x, 0.0, 0.0])
        own = np.array([0.0, 0.0, j_1, b_1])
        by_e = by_turn = 0.0
        if film is not None:
            normal, turned = np.array([n_x, n_y, 0.0, 0.0]), across
            angle_gradient = across / e if e > 0.0 else 0.0 * across
            bent = np.outer(across, angle_gradient)
            scale = self._open(film, at[2])
            partials = self._partials(i, load)
            by_e, by_turn = film.shear_partials(response, w_j, w_b)
            self._close(film, scale)
        else:
            normal, turned = np.array([n_x, n_y, j_1, b_1]), np.array([-n_y, n_x, j_2, b_2])
            angle_gradient = turned / (e + j_2 + b_2)  # the angle at which they touch, by s
            bent = np.outer(turned, angle_gradient) - np.diag([0.0, 0.0, j_2, b_2])
            partials = interface.partials(response, e, w_j, w_b)
        (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = partials
        worn = (j_1 + b_1) * angle_gradient - own
        closing = rates @ bent
        sliding = -(rates[0] * n_x + rates[1] * n_y) * angle_gradient
        along_n = n_e * normal + n_r * closing + n_v * sliding
        along_t = t_e * normal + t_r * closing + t_v * sliding
        rate_n = n_r * normal + n_v * across + [0.0, 0.0, n_wj, n_wb]
        rate_t = t_r * normal + t_v * across + [0.0, 0.0, t_wj, t_wb]
        couple, couple_rate = np.zeros(4), np.zeros(4)
        further = normal
        if film is not None:
            c, e_dot, v_t = self.clearance + at[2], motion[1], motion[2]
            along_n = along_n - (2.0 * f_n + e * n_e + e_dot * n_r + v_t * n_v) / c * worn
            along_t = along_t - (2.0 * f_t + e * t_e + e_dot * t_r + v_t * t_v) / c * worn
            shear = by_turn * (w_j - w_b)
            couple = by_e * normal - (shear + e * by_e) / c * worn
            couple_rate = by_turn * np.array([0.0, 0.0, 1.0, -1.0])
        else:
            further = normal + worn  # e by s, which friction's lever has; delta's is the normal
            along_t = along_t - t_v * w_b * worn
        lever_j, lever_b, slope_j, slope_b = interface.arms(e)
        levers = np.array([-n_y, n_x, lever_j, lever_b])
        leaning = np.outer(np.array([-n_x, -n_y, 0.0, 0.0]), angle_gradient)
        leaning[2] += slope_j * further
        leaning[3] += slope_b * further
        by_place = (
            np.outer(normal, along_n) + np.outer(levers, along_t) + f_n * bent + f_t * leaning
        )
        by_rate = np.outer(normal, rate_n) + np.outer(levers, rate_t)
        for row, sign in ((2, -1.0), (3, 1.0)):
            by_place[row] += sign * couple
            by_rate[row] += sign * couple_rate
        return by_place, by_rate

    @property
    def state(self) -> JointState:
        """The joint's state at the last `add_force`."""
        u, v, w_j, w_b = self._moving
        f_x, f_y, m_j, m_b = self._sum
        beside, closing = self._touch[0], self._touch[1]
        return JointState(
            eccentricity=self.eccentricity,
            force=(f_x, f_y),
            velocity=(u, v),
            moments=(m_j, m_b),
            angular_velocities=(w_j, w_b),
            gap=self._gap,
            stored_energy=sum(interface.stored_energy(beside) for interface in self.interfaces),
            stored_power=sum(
                interface.stored_power(beside, closing) for interface in self.interfaces
            ),
        )

    @property
    def rubbing(self) -> tuple[float, float]:
        """Normal force, N, and sliding velocity, m/s, where the surfaces touch."""
        return self._rubbing(self._touch)
