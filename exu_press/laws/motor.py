"""The torque of a motor over its speed, reduced to the crank.

A law is a function: angular speed [rad/s] -> (torque [N m], its slope [N m s/rad]), at any speed.
"""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from math import sqrt

from exu_press.laws.parameters import demand, positive

__all__ = ["MotorLaw", "kloss", "torque_table"]

MotorLaw = Callable[[float], tuple[float, float]]


def kloss(
    rated_torque: float, slip: float, breakdown_torque: float, no_load_speed: float
) -> MotorLaw:
    r"""Torque of an induction motor: Kloss' formula.

    .. math::
        T = \frac{2 T_b}{s / s_b + s_b / s}, \qquad s = 1 - \frac{\omega}{\omega_0}, \qquad
        s_b = s_r \left(\lambda + \sqrt{\lambda^2 - 1}\right), \qquad
        \lambda = \frac{T_b}{T_r}

    The breakdown slip s_b is the one with which the curve passes through the rated point.

    Parameters
    ----------
    rated_torque : T_r [N m], positive
    slip : s_r [-] at the rated torque, positive
    breakdown_torque : T_b [N m], the largest one, at least rated_torque
    no_load_speed : omega_0 [rad/s], the synchronous speed, positive

    Returns
    -------
    The law: omega [rad/s] -> (T [N m], dT/domega [N m s/rad]).

    Raises
    ------
    InputError : an argument is outside its range

    Notes
    -----
    Range: any speed. Backwards (s > 1) the torque brakes, and above the synchronous speed (s < 0)
    the motor is a generator; in both T_b is the largest magnitude. The stator's resistance and what
    happens within the first periods of the supply are left out, and so is the skew of currents in
    the bars, which makes the torque at standstill of some motors larger.

    Examples
    --------
    >>> motor = kloss(100.0, slip=0.05, breakdown_torque=250.0, no_load_speed=100.0)
    >>> [round(motor(speed)[0], 6) for speed in (100.0, 95.0, 105.0)]
    [0.0, 100.0, -100.0]
    >>> round(motor(0.0)[0], 3)
    113.281

    References
    ----------
    .. [1] Kloss, M. "Drehmoment und Schluepfung des Drehstrommotors." Archiv fuer Elektrotechnik 5
       (1916): 59-87.
    """
    positive(rated_torque=rated_torque, slip=slip, no_load_speed=no_load_speed)
    demand(
        rated_torque <= breakdown_torque < float("inf"),
        "breakdown_torque",
        breakdown_torque,
        f"rated_torque = {rated_torque!r} <= breakdown_torque < inf",
    )
    ratio = breakdown_torque / rated_torque
    breakdown_slip = slip * (ratio + sqrt(ratio * ratio - 1.0))
    twice = 2.0 * breakdown_torque
    per_speed = -1.0 / (no_load_speed * breakdown_slip)

    def torque(speed: float) -> tuple[float, float]:
        relative_slip = (1.0 - speed / no_load_speed) / breakdown_slip
        denominator = 1.0 + relative_slip * relative_slip
        return twice * (relative_slip / denominator), twice * per_speed * (
            1.0 - relative_slip * relative_slip
        ) / denominator / denominator

    return torque


def torque_table(speeds: Sequence[float], torques: Sequence[float]) -> MotorLaw:
    r"""Torque of any motor: straight lines between points, whose first and last torques go on.

    Parameters
    ----------
    speeds : of the points [rad/s], increasing
    torques : at the points [N m]

    Returns
    -------
    The law: omega [rad/s] -> (T [N m], dT/domega [N m s/rad]).

    Notes
    -----
    Range: any speed. The torque at a standstill and backwards is the table's own where it begins
    below zero, and else its first one.

    Examples
    --------
    >>> motor = torque_table([0.0, 20.0, 25.0], [300.0, 400.0, 0.0])
    >>> [motor(speed)[0] for speed in (-5.0, 10.0, 22.5, 30.0)]
    [300.0, 350.0, 200.0, 0.0]
    """
    x, y = tuple(speeds), tuple(torques)

    def torque(speed: float) -> tuple[float, float]:
        if speed != speed:
            return speed, speed
        if speed < x[0]:
            return y[0], 0.0
        if speed >= x[-1]:
            return y[-1], 0.0
        after = bisect_right(x, speed)
        slope = (y[after] - y[after - 1]) / (x[after] - x[after - 1])
        return y[after - 1] + slope * (speed - x[after - 1]), slope

    return torque
