"""Journal and bearing in polar form: the interaction of a joint's surfaces in its plane.

With e = journal centre - bearing centre, n = e/|e| and t a quarter turn counter-clockwise from n,
an interface law turns (|e|, d|e|/dt, v_t, omega_J, omega_B) into the force on the journal
F = f_n n + f_t t, -F on the bearing, and the moments f_t a_J - S about the journal's centre and
f_t a_B + S about the bearing's. a_J + a_B + |e| = 0, so that momentum and angular momentum are
conserved exactly. S, which a film alone has, is the couple of its shear.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

from exu_press.errors import InputError
from exu_press.joints.joint import SHALLOW, ClearanceJoint, JointState
from exu_press.laws.contact import Approach, NormalContact
from exu_press.laws.film.contract import FilmLaw
from exu_press.laws.friction import Friction, LuGre

__all__ = [
    "Arms",
    "DryInterface",
    "FilmInterface",
    "FunctionInterface",
    "InterfaceJoint",
    "InterfaceLaw",
    "Load",
    "Motion",
    "Partials",
    "Response",
]

Partials = tuple[tuple[float, float, float, float, float], tuple[float, float, float, float, float]]
"""Derivatives of f_n and of f_t with respect to (|e|, d|e|/dt, v_t, omega_J, omega_B)."""

Arms = tuple[float, float, float, float]
"""a_J, a_B, m, and their derivatives with respect to |e|."""


Response = tuple[float, ...]
"""Values of an interface's laws, and their derivatives."""

Motion = tuple[float, float, float, float, float]
"""|e|, d|e|/dt, v_t, omega_J, omega_B."""

Load = tuple[float, float, float, float, Response]
"""f_n, f_t, the moments on journal and bearing, and the laws' response that they come from."""


class InterfaceLaw:
    """Base of interface laws: the action of two surfaces; `None` stands for no force at all.

    Attributes:
        clearance: distance of the centres at which the surfaces touch, m.
        stateful: whether the interface remembers something from step to step.
        needs_secant: whether Newton's method converges better with a secant: with a film,
            whose force is of first degree in the speeds but has a kink at rest.
        is_oriented: whether it depends on the angle of the eccentricity in the bearing.
        bears_at_rest: whether a film has a force without a motion.
        outside: eccentricity ratio where its law did not hold, if the last state was so.
        drift: correction of a penetration (`exu_press.joints.path`), m.
    """

    is_oriented = False
    bears_at_rest = False

    def __init__(self, clearance: float, stateful: bool, needs_secant: bool) -> None:
        self.drift = 0.0
        self.clearance = clearance
        self.stateful = stateful
        self.needs_secant = needs_secant
        self.outside: float | None = None

    def load(
        self, e: float, e_dot: float, v_t: float, omega_j: float, omega_b: float
    ) -> Load | None:
        """Return force and moments, SI."""
        raise NotImplementedError

    def partials(self, response: Response, e: float, omega_j: float, omega_b: float) -> Partials:
        """Return the derivatives of the force that goes with an response of the laws, SI."""
        raise NotImplementedError

    def normal_partials(
        self, response: Response, e: float, omega_j: float, omega_b: float
    ) -> tuple[float, float]:
        """Return the derivatives of f_n by |e| (N/m) and d|e|/dt (N s/m)."""
        by_e, by_e_dot = self.partials(response, e, omega_j, omega_b)[0][:2]
        return by_e, by_e_dot

    def orient(self, angle: float) -> None:
        """Take the angle of the eccentricity in the bearing, rad, before `load`."""

    @property
    def reach(self) -> float:
        """Eccentricity at which the surfaces touch, m, at the angle of the last `orient`."""
        return self.clearance

    def gap(self, e: float) -> float:
        """Return the least gap at an eccentricity, m, at the angle of the last `orient`."""
        return self.clearance - e

    @property
    def pump_power(self) -> float:
        """Power that oil under pressure puts in, W, at the last `load`."""
        return 0.0

    def arms(self, e: float) -> Arms:
        """Return a_J, a_B (m) and their derivatives; of the point half-way between the centres."""
        return -0.5 * e, -0.5 * e, -0.5, -0.5

    def shear_partials(
        self, response: Response, omega_j: float, omega_b: float
    ) -> tuple[float, float]:
        """Return the derivatives of the couple S by |e| (N) and by omega_J - omega_B (N m s)."""
        return 0.0, 0.0

    def stored_energy(self, e: float) -> float:
        """Return the elastic energy at an eccentricity, J; none unless the interface says so."""
        return 0.0

    def stored_power(self, e: float, e_dot: float) -> float:
        """Return the rate of the stored energy, W."""
        return 0.0

    def begin_step(self, step: float, accepted: bool) -> None:
        """Start a step of size `step` (s), after the last one was accepted or is repeated."""

    def reset(self) -> None:
        """Forget everything."""

    def memory(self) -> list[Any]:
        """Return the memory of the steps before; none unless the interface has one."""
        return []

    def recall(self, memory: list[Any]) -> None:
        """Take over the memory of another interface of its kind."""


class DryInterface(InterfaceLaw):
    """Contact with friction: journal (or ball) and bearing (or socket) touch where |e| > c.

    The friction force acts at the contact point on the journal's surface, with the sliding velocity
    of the two surfaces there: v_T = v_t + R omega_J - (R + |e|) omega_B.

    Attributes:
        bristle: deflection of the friction's bristle at the start of the step, m.
        approach: the rate at the first touch of this contact.
    """

    def __init__(
        self, contact: NormalContact, friction: Friction | LuGre, radius: float, clearance: float
    ) -> None:
        """Let two surfaces touch.

        Args:
            contact: normal force of a penetration.
            friction: friction coefficient of a sliding velocity, with or without a bristle.
            radius: R of the journal, m.
            clearance: c, m.
        """
        stateful = isinstance(friction, LuGre) or contact.needs_impact_speed
        super().__init__(clearance, stateful, needs_secant=False)
        self.contact = contact
        self.friction = friction
        self.radius = radius
        self.bristle = 0.0
        self.approach = Approach()
        self._step = 0.0
        self._next_bristle = 0.0
        self._normal = self._normal_before = 0.0
        self._in_bristles = 0.0
        self._sliding: float | None = None
        self._sliding_before: float | None = None

    def load(
        self, e: float, e_dot: float, v_t: float, omega_j: float, omega_b: float
    ) -> Load | None:
        """Return force and moments, or None in free flight."""
        penetration = e - self.clearance - self.drift
        if penetration <= 0.0 and not self.stateful:
            return None
        sliding = v_t + self.radius * omega_j - (self.radius + e) * omega_b
        friction = self.friction
        if isinstance(friction, LuGre):
            mu, slope, bristle = friction.advance(
                sliding, self.bristle, self._step, self._sliding_before
            )
        else:
            mu, slope = friction(sliding)
            bristle = 0.0
        speed = 0.0
        if self.stateful:
            self._next_bristle = bristle
            self._sliding = sliding
            self._normal = 0.0
            speed = self.approach.speed(penetration, e_dot)
            if penetration <= 0.0:
                return None
        normal, stiffness, damping = self.contact.force(penetration, e_dot, speed)
        self._normal = normal
        return self._film_load(e, normal, (mu, slope, normal, stiffness, damping))

    def _film_load(self, e: float, normal: float, response: Response) -> Load:
        drag = -response[0] * normal
        return -normal, drag, self.radius * drag, -(self.radius + e) * drag, response

    def partials(self, response: Response, e: float, omega_j: float, omega_b: float) -> Partials:
        """Return the derivatives of the force."""
        mu, slope, normal, stiffness, damping = response
        drag = slope * normal
        return (
            (-stiffness, -damping, 0.0, 0.0, 0.0),
            (
                -mu * stiffness + drag * omega_b,
                -mu * damping,
                -drag,
                -drag * self.radius,
                drag * (self.radius + e),
            ),
        )

    def normal_partials(
        self, response: Response, e: float, omega_j: float, omega_b: float
    ) -> tuple[float, float]:
        """Return the derivatives of f_n by |e| and d|e|/dt, which the contact law gave."""
        return -response[3], -response[4]

    def arms(self, e: float) -> Arms:
        """Return the moment arms of the contact point about the two centres."""
        return self.radius, -(self.radius + e), 0.0, -1.0

    def stored_energy(self, e: float) -> float:
        """Return the elastic energy of penetration and bristles."""
        return (
            self.contact.elastic_energy(e - self.clearance - self.drift)
            + self._in_bristles
            + self._into_bristles()
        )

    def _into_bristles(self) -> float:
        """Return the energy that bristles took up in the last step at its mean normal force, J."""
        if not isinstance(self.friction, LuGre):
            return 0.0
        bent = self.friction.stored_energy(self._next_bristle) - self.friction.stored_energy(
            self.bristle
        )
        return 0.5 * (self._normal + self._normal_before) * bent

    def stored_power(self, e: float, e_dot: float) -> float:
        """Return the power into the elastic part of the contact, and into the bristles."""
        depth = e - self.clearance - self.drift
        power = self.contact.stiffness.force(depth)[0] * e_dot if depth > 0.0 else 0.0
        if isinstance(self.friction, LuGre) and self._sliding is not None:
            rate = self.friction.stored_power(self._sliding, self._next_bristle)
            power += self._normal * rate
        return power

    def begin_step(self, step: float, accepted: bool) -> None:
        """Keep bristle deflection and approach speed of the last step if it was accepted."""
        if accepted:
            self._in_bristles += self._into_bristles()
            self.bristle = self._next_bristle
            self._sliding_before = self._sliding
            self._normal_before = self._normal
            self.approach.accept()
        self._step = step

    def reset(self) -> None:
        """Relax the bristle."""
        self.bristle = self._next_bristle = self._in_bristles = 0.0
        self._normal = self._normal_before = 0.0
        self._sliding = self._sliding_before = None
        self.approach = Approach()

    def memory(self) -> list[Any]:
        """Return bristle, sliding velocities and approach speed."""
        sliding = self._sliding, self._sliding_before
        return [self.bristle, self._next_bristle, *sliding, self.approach.memory()]

    def recall(self, memory: list[Any]) -> None:
        """Take over the memory of another interface."""
        self.bristle, self._next_bristle = memory[0], memory[1]
        self._sliding, self._sliding_before = memory[2], memory[3]
        self.approach.recall(memory[4])


class FilmInterface(InterfaceLaw):
    """A lubricant film between journal and bearing.

    The resultant acts half-way between the two centres, as the shear of the pressure flow divides
    the couple e x F. The shear of the rotation drags the journal with S = P c j (omega_J - omega_B)
    and takes the bearing along (Petroff 1883; j: `FilmForce`). Then the film's power is
    P c (f_r eps_dot - f_t eps W / 2 - j (omega_J - omega_B)^2), never positive.
    """

    def __init__(self, law: FilmLaw, scale: float, clearance: float) -> None:
        """Fill the gap between two surfaces.

        Args:
            law: film law in eps, d eps/dt and eps W.
            scale: P = mu L R^3 / c^2, N s.
            clearance: c, m.
        """
        super().__init__(clearance, stateful=False, needs_secant=True)
        self.law = law
        self.scale = scale

    def load(
        self, e: float, e_dot: float, v_t: float, omega_j: float, omega_b: float
    ) -> Load | None:
        """Return force and moments; NaN where the law does not hold."""
        c, p = self.clearance, self.scale
        eps_w = (e * (omega_j + omega_b) - 2.0 * v_t) / c
        response = self.law(e / c, e_dot / c, eps_w)
        f_r = p * response[0]
        if f_r == f_r:
            self.outside = None
        elif e == e:  # after such a force there may be no place at all
            self.outside = e / c
        f_t = p * response[1]
        if e_dot == 0.0 and eps_w == 0.0 and f_r == f_r and not self.bears_at_rest:
            f_r = f_t = 0.0  # a law may take a speed for one at rest, to have partials there
        moment = -0.5 * e * f_t
        shear = p * c * response[8] * (omega_j - omega_b)
        return f_r, f_t, moment - shear, moment + shear, response

    def partials(self, response: Response, e: float, omega_j: float, omega_b: float) -> Partials:
        """Return the derivatives of the force."""
        _, _, r_eps, r_dot, r_w, t_eps, t_dot, t_w, _, _ = response
        turning = omega_j + omega_b
        q = self.scale / self.clearance
        r_w *= q
        t_w *= q
        r_turn, t_turn = r_w * e, t_w * e
        return (
            (q * r_eps + r_w * turning, q * r_dot, -2.0 * r_w, r_turn, r_turn),
            (q * t_eps + t_w * turning, q * t_dot, -2.0 * t_w, t_turn, t_turn),
        )

    def shear_partials(
        self, response: Response, omega_j: float, omega_b: float
    ) -> tuple[float, float]:
        """Return the derivatives of Petroff's couple."""
        p = self.scale
        return p * response[9] * (omega_j - omega_b), p * self.clearance * response[8]


class FunctionInterface(InterfaceLaw):
    """An interface law of your own, a function; its force acts half-way between the two centres."""

    def __init__(
        self,
        law: Callable[[float, float, float, float, float], Response],
        clearance: float,
        energy: Callable[[float], tuple[float, float]] | None = None,
    ) -> None:
        """Let a function be the law.

        Args:
            law: (|e|, d|e|/dt, v_t, omega_J, omega_B) -> f_n and f_t, N, the five derivatives of
                f_n by these, then those of f_t.
            clearance: eccentricity that others are compared with, m.
            energy: |e| -> elastic energy, J, and its derivative, N; None where nothing is stored.
        """
        super().__init__(clearance, stateful=False, needs_secant=False)
        self.law = law
        self.energy = energy

    def load(
        self, e: float, e_dot: float, v_t: float, omega_j: float, omega_b: float
    ) -> Load | None:
        """Return force and moments."""
        response = self.law(e, e_dot, v_t, omega_j, omega_b)
        moment = -0.5 * e * response[1]
        return response[0], response[1], moment, moment, response

    def partials(self, response: Response, e: float, omega_j: float, omega_b: float) -> Partials:
        """Return the derivatives that the law gives."""
        _, _, n_1, n_2, n_3, n_4, n_5, t_1, t_2, t_3, t_4, t_5 = response
        return (n_1, n_2, n_3, n_4, n_5), (t_1, t_2, t_3, t_4, t_5)

    def stored_energy(self, e: float) -> float:
        """Return the elastic energy, J."""
        return 0.0 if self.energy is None else self.energy(e)[0]

    def stored_power(self, e: float, e_dot: float) -> float:
        """Return the rate of the elastic energy, W."""
        return 0.0 if self.energy is None else self.energy(e)[1] * e_dot


class InterfaceJoint(ClearanceJoint):
    """Base of revolute joints in the plane and in space: interfaces acting in parallel.

    Attributes:
        interfaces: the first one has the joint's clearance.
    """

    def __init__(
        self, indices: list[int], interfaces: Sequence[InterfaceLaw], turns: bool = True
    ) -> None:
        """Let surfaces touch; their normal turns with the eccentricity, or a guideway's stays."""
        self.interfaces = list(interfaces)
        self._turns = turns
        dry = [interface for interface in self.interfaces if isinstance(interface, DryInterface)]
        clearance = self.interfaces[0].clearance
        shallow = [SHALLOW * interface.radius for interface in dry if turns]
        super().__init__(
            indices,
            clearance,
            contact_onset=min([interface.clearance for interface in dry], default=math.inf),
            largest_eccentricity=clearance + min(shallow, default=math.inf),
            lubricated=any(isinstance(interface, FilmInterface) for interface in self.interfaces),
        )
        self._motion: Motion = (0.0, 0.0, 0.0, 0.0, 0.0)
        self._loads: list[Load | None] = [None for _ in self.interfaces]
        self._motion_before = self._motion
        self._loads_before = self._loads

    @property
    def outside(self) -> float | None:
        """Eccentricity ratio of the last state if a film's law did not hold there."""
        for interface in self.interfaces:
            if interface.outside is not None:
                return interface.outside
        return None

    def in_frame(self, along_n: float, along_t: float) -> tuple[float, ...]:
        """Return a vector of the joint's plane at the last `add_force` in the global frame."""
        raise NotImplementedError

    @property
    def eccentricity(self) -> tuple[float, ...]:
        """Journal centre - bearing centre at the last `add_force`, m."""
        return self.in_frame(self._motion[0], 0.0)

    @property
    def relative_velocity(self) -> tuple[float, ...]:
        """Rate of the eccentricity at the last `add_force`, m/s."""
        return self.in_frame(self._motion[1], self._motion[2] if self._turns else 0.0)

    @property
    def force(self) -> tuple[float, ...]:
        """Force on the journal at the last `add_force`, N."""
        along_n = along_t = 0.0
        for load in self._loads:
            if load is not None:
                along_n += load[0]
                along_t += load[1]
        return self.in_frame(along_n, along_t)

    @property
    def rubbing(self) -> tuple[float, float]:
        """Normal force of the contact, N, and sliding velocity, m/s, at the last `add_force`."""
        return self._rubbing(self._motion)

    def _rubbing(self, motion: Motion) -> tuple[float, float]:
        """Return normal force and sliding velocity of surfaces that move so."""
        e, _, v_t, w_j, w_b = motion
        normal = sliding = 0.0
        for interface, load in zip(self.interfaces, self._loads, strict=True):
            if isinstance(interface, DryInterface) and load is not None:
                normal -= load[0]
                sliding = v_t + interface.radius * w_j - (interface.radius + e) * w_b
        return normal, sliding

    @property
    def state(self) -> JointState:
        """The joint's state at the last `add_force`."""
        e, e_dot, v_t, w_j, w_b = self._motion
        energy = power = 0.0
        for interface in self.interfaces:
            energy += interface.stored_energy(e)
            power += interface.stored_power(e, e_dot)
        return JointState(
            self.eccentricity,
            self.force,
            self.in_frame(e_dot, v_t),
            self._moments(),
            (w_j, w_b),
            self.interfaces[0].gap(e),
            energy,
            power,
        )

    def _moments(self) -> tuple[float, float]:
        """Return the moments on journal and bearing at the last `add_force`, N m."""
        m_j = m_b = 0.0
        for load in self._loads:
            if load is not None:
                m_j += load[2]
                m_b += load[3]
        return m_j, m_b if self._turns else 0.0  # a guideway takes any

    def begin_step(self, step: float, accepted: bool) -> None:
        """Start a step of size `step` (s), after the last one was accepted or is repeated."""
        super().begin_step(step, accepted)
        for interface in self.interfaces:
            interface.drift = self.path.drift
            interface.begin_step(step, accepted)

    def contact_depth(self) -> float:
        """Return the penetration at the last `add_force`, m; none where it is not positive."""
        return self._motion[0] - self.contact_onset

    def contact_memory(self) -> float:
        """Return damping over stiffness of the normal force at the last `add_force`, s."""
        e, _, _, w_j, w_b = self._motion
        stiffness = damping = 0.0
        for i, load in enumerate(self._loads):  # in each step, and faster than two lists at once
            if load is not None:
                by_e, by_e_dot = self.interfaces[i].normal_partials(load[4], e, w_j, w_b)
                stiffness -= by_e
                damping -= by_e_dot
        return damping / stiffness if stiffness > 0.0 else 0.0

    def reset(self) -> None:
        """Forget everything."""
        super().reset()
        self._loads = [None for _ in self.interfaces]
        for interface in self.interfaces:
            interface.drift = 0.0
            interface.reset()

    def memory(self) -> list[Any]:
        """Return the memory of the steps before, numbers in lists."""
        return [*super().memory(), [interface.memory() for interface in self.interfaces]]

    def recall(self, memory: list[Any]) -> None:
        """Take over the memory of another joint of its kind, in the state of the last forces.

        Raises:
            InputError: the joint is of another kind.
        """
        sizes = [len(numbers) for numbers in memory[2]]
        own_sizes = [len(interface.memory()) for interface in self.interfaces]
        if sizes != own_sizes:
            raise InputError(
                f"its surfaces and film remember {own_sizes} numbers, those of the state {sizes}; "
                "allowed is a joint of the same kind, with or without a mixed film"
            )
        super().recall(memory)
        for interface, interface_memory in zip(self.interfaces, memory[2], strict=True):
            interface.drift = self.path.drift
            interface.recall(interface_memory)

    def _load(self, motion: Motion) -> list[Load | None]:
        """Return each interface's load in a state; the one before is kept for the secant."""
        e, e_dot, v_t, w_j, w_b = motion
        self._motion_before, self._loads_before = self._motion, self._loads
        self._motion = motion
        loads: list[Load | None] = []
        for interface in self.interfaces:
            loads.append(interface.load(e, e_dot, v_t, w_j, w_b))
        self._loads = loads
        return loads

    def _partials(self, i: int, load: Load) -> Partials:
        """Return an interface's partials; a film's lead to the force of the state before, too.

        A secant (Broyden 1965): Exudyn starts each step without accelerations, so that the speeds
        across a film are off by as much as they are; the step then ends near where the last one
        ended. Newton's method gets there in one iteration along the secant, in two along the
        tangent.
        """
        e, e_dot, v_t, w_j, w_b = self._motion
        interface = self.interfaces[i]
        partials = interface.partials(load[4], e, w_j, w_b)
        previous = self._loads_before[i]
        if not interface.needs_secant or previous is None:
            return partials
        e_0, e_dot_0, v_t_0, w_j0, w_b0 = self._motion_before
        (n_e, n_r, n_v, n_wj, n_wb), (t_e, t_r, t_v, t_wj, t_wb) = partials
        r, v = e_dot_0 - e_dot, v_t_0 - v_t
        d_e, d_j, d_b = e_0 - e, w_j0 - w_j, w_b0 - w_b
        n_rest = previous[0] - load[0] - n_e * d_e - n_r * r - n_v * v - n_wj * d_j - n_wb * d_b
        t_rest = previous[1] - load[1] - t_e * d_e - t_r * r - t_v * v - t_wj * d_j - t_wb * d_b
        square = r * r + v * v
        size = n_r * n_r + n_v * n_v + t_r * t_r + t_v * t_v
        # a larger correction, or none that is a number, means that the two states lie apart
        if not n_rest * n_rest + t_rest * t_rest < size * square:
            return partials
        n_rest /= square
        t_rest /= square
        return (
            (n_e, n_r + n_rest * r, n_v + n_rest * v, n_wj, n_wb),
            (t_e, t_r + t_rest * r, t_v + t_rest * v, t_wj, t_wb),
        )
