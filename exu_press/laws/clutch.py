"""A friction clutch or brake: it slips at its capacity, and sticks below it."""

from dataclasses import dataclass

__all__ = ["Coupling", "coupling_torque"]


def coupling_torque(
    twist: float, rate: float, capacity: float, stiffness: float, damping: float
) -> float:
    r"""Torque between two shafts that surfaces press together.

    .. math::
        T = \min(T_c, \max(-T_c, k x + d \dot x))

    Below the capacity the surfaces stick, and the shafts twist against each other by x. A torque
    that lasts holds them where they are: nothing creeps. At the capacity they slip.

    Parameters
    ----------
    twist : x, if all of the relative motion were twist [rad]
    rate : its rate, the relative angular velocity [rad/s]
    capacity : T_c, friction coefficient times normal force times mean radius [N m], not negative
    stiffness : k of shafts and linings [N m/rad]
    damping : d of these [N m s/rad]

    Returns
    -------
    T [N m], against the relative motion.

    Notes
    -----
    Range: a coefficient of friction that does not change with speed. Heat and fading are left out.

    Examples
    --------
    >>> [coupling_torque(x, 0.0, 100.0, 1e6, 0.0) for x in (5e-5, 1e-3, -1e-3)]
    [50.0, 100.0, -100.0]

    References
    ----------
    .. [1] Orthwein, W. C. Clutches and Brakes: Design and Selection. Marcel Dekker, 2004.
    """
    elastic = stiffness * twist + damping * rate
    if elastic > capacity:
        return capacity
    return -capacity if elastic < -capacity else elastic


@dataclass
class Coupling:
    """Memory of the surfaces from step to step: the twist behind their torque.

    >>> brake = Coupling(stiffness=1e6, damping=1e3)
    >>> brake.begin(0.0, 0.0)
    >>> brake.torque(0.01, 2.0, 100.0)  # turned by 0.01 rad, and at 2 rad/s: slips
    100.0
    >>> brake.accept(1.0, 0.01, 2.0, 100.0)
    >>> round(brake.torque(0.01, 0.0, 100.0), 1)
    99.9
    >>> brake.excess_torque(0.00995, 0.0, 100.0) < 0.0  # it sticks
    True
    """

    stiffness: float
    damping: float
    _twist: float = 0.0
    _angle: float = 0.0

    def begin(self, angle: float, torque: float) -> None:
        """Start at a relative angle, rad, with a torque, N m."""
        self._angle, self._twist = angle, torque / self.stiffness

    def torque(self, angle: float, rate: float, capacity: float) -> float:
        """Return the torque against the relative motion, N m.

        Args:
            angle: relative, rad.
            rate: of it, rad/s.
            capacity: N m.
        """
        twist = self._twist + angle - self._angle
        return coupling_torque(twist, rate, capacity, self.stiffness, self.damping)

    def excess_torque(self, angle: float, rate: float, capacity: float) -> float:
        """Return by how much sticking would ask for more than the capacity, N m: then it slips."""
        twist = self._twist + angle - self._angle
        return abs(self.stiffness * twist + self.damping * rate) - capacity

    def accept(self, step: float, angle: float, rate: float, capacity: float) -> None:
        """Keep the state at the end of a step, s: surfaces that slip twist no further."""
        torque = self.torque(angle, rate, capacity)
        if self.excess_torque(angle, rate, capacity) <= 0.0:
            self._twist += angle - self._angle
        elif step > 0.0:  # k x + d (x - x_before) / h is the torque
            slow = self.damping / step
            self._twist = (torque + slow * self._twist) / (self.stiffness + slow)
        self._angle = angle

    def memory(self) -> tuple[float, float]:
        """Return twist and relative angle, rad."""
        return self._twist, self._angle

    def recall(self, memory: tuple[float, float]) -> None:
        """Take over another's memory."""
        self._twist, self._angle = memory
