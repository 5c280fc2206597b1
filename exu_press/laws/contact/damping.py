"""Normal contact force: an elastic part and one of the damping laws.

`step_damping` is that of ADAMS. The others share `hysteretic` and differ in chi alone.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from exu_press.laws.contact.stiffness import Stiffness
from exu_press.laws.parameters import demand, not_negative, positive

__all__ = [
    "DAMPING_LAWS",
    "Approach",
    "NormalContact",
    "flores",
    "gonthier",
    "hu_guo",
    "hunt_crossley",
    "hysteretic",
    "lankarani_nikravesh",
    "step",
    "step_damping",
]

SLOWEST_IMPACT = 1e-3
"""m/s, unless one is given, as scenes do (`exu_press.scene.contact.Restitution`)."""


def step(x: float, x0: float, h0: float, x1: float, h1: float) -> tuple[float, float]:
    r"""STEP of ADAMS (Eq. 25): a cubic between two constant values.

    .. math::
        h = h_0 + (h_1 - h_0)\, t^2 (3 - 2t), \qquad t = \frac{x - x_0}{x_1 - x_0}

    Parameters
    ----------
    x : where [any unit]
    x0, x1 : ends of the cubic, x0 < x1 [that of x]
    h0, h1 : values up to x0 and from x1 on

    Returns
    -------
    The value, and its derivative by x.

    Examples
    --------
    >>> step(0.25, 0.0, 0.0, 1.0, 2.0)
    (0.3125, 2.25)
    """
    if x <= x0:
        return h0, 0.0
    if x >= x1:
        return h1, 0.0
    t, rise = (x - x0) / (x1 - x0), h1 - h0
    return h0 + rise * t * t * (3.0 - 2.0 * t), 6.0 * rise * t * (1.0 - t) / (x1 - x0)


@dataclass(frozen=True, slots=True)
class NormalContact:
    """Normal force of one contact: F_N = elastic + damping.

    Attributes:
        stiffness: the elastic part.
        damping: (penetration [m], rate [m/s], impact_speed [m/s], elastic force [N], its slope
            [N/m]) -> (damping force [N], d/dpenetration [N/m], d/drate [N s/m]).
        needs_impact_speed: the law divides by the approach speed at first touch.
        tension: False (A-10) lets the surfaces part where the sum would pull; True keeps the pull.
    """

    stiffness: Stiffness
    damping: Callable[[float, float, float, float, float], tuple[float, float, float]]
    needs_impact_speed: bool
    tension: bool = False

    def force(
        self, penetration: float, rate: float, impact_speed: float
    ) -> tuple[float, float, float]:
        """(F_N [N], dF_N/dpenetration [N/m], dF_N/drate [N s/m]); zeros where apart.

        penetration [m]; rate [m/s], positive when closing; impact_speed [m/s]: the rate at first
        touch of this contact, kept until it is over; not read unless `needs_impact_speed`.
        """
        if penetration <= 0.0:
            return (0.0, 0.0, 0.0) if rate == rate else (rate, rate, rate)
        elastic, slope = self.stiffness.force(penetration)
        damping, by_penetration, by_rate = self.damping(
            penetration, rate, impact_speed, elastic, slope
        )
        force = elastic + damping
        if force < 0.0 and not self.tension:
            return 0.0, 0.0, 0.0
        return force, slope + by_penetration, by_rate

    def elastic_energy(self, penetration: float) -> float:
        """Energy [J] stored at this penetration [m]."""
        return 0.0 if penetration <= 0.0 else self.stiffness.energy(penetration)

    def dissipated_power(self, penetration: float, rate: float, impact_speed: float) -> float:
        """Power [W] lost: rate (F_N - elastic force); never negative in any law of this module."""
        if penetration <= 0.0:
            return 0.0 if rate == rate else rate
        force, _, _ = self.force(penetration, rate, impact_speed)
        return rate * (force - self.stiffness.force(penetration)[0])


class Approach:
    """The rate at which two surfaces first touched, kept until they part.

    Between two instants the rate's square changes evenly with the way, as under an even force: a
    rate taken at the last instant apart would be off by the change of a whole step.
    """

    def __init__(self) -> None:
        self._speed, self._gap = 0.0, 0.0  # at the last accepted instant; no gap in contact
        self._next = 0.0, 0.0

    def speed(self, penetration: float, rate: float) -> float:
        """Return the rate at first touch, m/s, for a state (m, m/s) that is tried now."""
        speed, gap = self._speed, self._gap
        if penetration <= 0.0:
            speed, gap = rate, -penetration
        elif gap > 0.0:
            if rate > 0.0:  # else it has turned already
                fraction = gap / (gap + penetration)
                speed = math.sqrt(speed * speed + fraction * (rate * rate - speed * speed))
            gap = 0.0
        self._next = speed, gap
        return speed

    def accept(self) -> None:
        """Keep the last try."""
        self._speed, self._gap = self._next

    def memory(self) -> list[float]:
        """Return its memory."""
        return [self._speed, self._gap, *self._next]

    def recall(self, memory: list[float]) -> None:
        """Take over another's memory."""
        self._speed, self._gap = memory[0], memory[1]
        self._next = memory[2], memory[3]


def step_damping(
    stiffness: Stiffness, damping_max: float, damping_depth: float, tension: bool = False
) -> NormalContact:
    r"""Contact with the damping of ADAMS' IMPACT (Eqs. 23-25).

    .. math::
        F = f(\delta) + \mathrm{STEP}(\delta, 0, 0, d_{max}, c_{max})\, \dot\delta

    Parameters
    ----------
    stiffness : the elastic part f(delta)
    damping_max : c_max [N s/m], not negative
    damping_depth : d_max [m], positive: the penetration from which c_max is reached
    tension : True keeps the force where it would pull; False lets the surfaces part there (A-10)

    Returns
    -------
    The normal force; it does not depend on the approach speed.

    Raises
    ------
    InputError : damping_max or damping_depth is outside its range

    Notes
    -----
    Range: no restitution is given; the one delivered depends on mass and speed
    (`exu_press.laws.contact.restitution.delivered_restitution`).

    Examples
    --------
    285.602 N elastic, and c_max / 2 * 1e-5 m/s of damping:

    >>> from exu_press.laws.contact.stiffness import hertz
    >>> contact = step_damping(hertz(2.5545e10), damping_max=2.5545e8, damping_depth=1e-5)
    >>> round(contact.force(5e-6, 1e-5, 0.0)[0], 3)
    1562.852

    References
    ----------
    .. [1] MSC Software. Adams/Solver, functions IMPACT and STEP.
    """
    not_negative(damping_max=damping_max)
    positive(damping_depth=damping_depth)

    def damping(
        penetration: float, rate: float, _impact_speed: float, _elastic: float, _slope: float
    ) -> tuple[float, float, float]:
        coefficient, slope = step(penetration, 0.0, 0.0, damping_depth, damping_max)
        return coefficient * rate, slope * rate, coefficient

    return NormalContact(stiffness, damping, needs_impact_speed=False, tension=tension)


def hysteretic(
    stiffness: Stiffness,
    restitution: float,
    chi: Callable[[float], float],
    tension: bool = False,
    slowest_impact: float = SLOWEST_IMPACT,
) -> NormalContact:
    r"""Hysteretic damping; the laws below differ in chi, a function of the wanted restitution.

    .. math::
        F = f(\delta) \left(1 + \chi(e) \frac{\dot\delta}{v_0}\right)

    Parameters
    ----------
    stiffness : the elastic part f(delta)
    restitution : the wanted coefficient of restitution e [-], 0 < e <= 1
    chi : e [-] -> chi [-]
    tension : True keeps the force where it would pull; False lets the surfaces part there (A-10)
    slowest_impact : [m/s], positive; chi / v_0 of slower impacts is taken at this speed

    Returns
    -------
    The normal force; it needs v_0 [m/s], the approach speed at first touch.

    Raises
    ------
    InputError : restitution or slowest_impact is outside its range

    Notes
    -----
    Range: any f and any mass; `exu_press.laws.contact.restitution.restitution_of` gives the
    restitution that chi delivers.
    A contact that begins at rest (v_0 = 0) has a finite, light damping through `slowest_impact`,
    and the restitution tends to one with the speed, as it does in reality.

    Examples
    --------
    807.804 N elastic, which closing at the speed of first touch raises by chi = 0.5:

    >>> from exu_press.laws.contact.stiffness import hertz
    >>> contact = hysteretic(hertz(2.5545e10), restitution=0.5, chi=lambda e: 1.0 - e)
    >>> round(contact.force(10e-6, 0.1, 0.1)[0], 3)
    1211.706

    What chi of the laws below, in their order, delivers where 0.5 is wanted:

    >>> from exu_press.laws.contact.restitution import restitution_of
    >>> e = 0.5
    >>> chis = 1.5 * (1 - e), 0.75 * (1 - e**2), 1.6 * (1 / e - 1), 1 / e - e, 1.5 * (1 / e - 1)
    >>> [round(restitution_of(chi), 3) for chi in chis]
    [0.663, 0.725, 0.47, 0.488, 0.488]
    """
    demand(
        0.0 < restitution <= 1.0,
        "restitution",
        restitution,
        "0 < restitution <= 1",
        "Flores et al. 2011: towards 0 chi grows without bound",
    )
    positive(slowest_impact=slowest_impact)
    damping_factor = chi(restitution)

    def damping(
        _penetration: float, rate: float, impact_speed: float, elastic: float, slope: float
    ) -> tuple[float, float, float]:
        per_rate = damping_factor / (
            slowest_impact if impact_speed <= slowest_impact else impact_speed
        )
        return elastic * per_rate * rate, slope * per_rate * rate, elastic * per_rate

    return NormalContact(stiffness, damping, needs_impact_speed=True, tension=tension)


def _with_chi(chi: Callable[[float], float]) -> Callable[..., NormalContact]:
    """Return the law of a chi; arguments and errors as of `hysteretic`, but for chi."""

    def law(
        stiffness: Stiffness,
        restitution: float,
        tension: bool = False,
        slowest_impact: float = SLOWEST_IMPACT,
    ) -> NormalContact:
        return hysteretic(stiffness, restitution, chi, tension, slowest_impact)

    return law


hunt_crossley = _with_chi(lambda e: 1.5 * (1.0 - e))
r"""chi = 3/2 (1 - e), derived for e near 1.

Hunt, K. H., and F. R. E. Crossley. "Coefficient of Restitution Interpreted as Damping in
Vibroimpact." J. Appl. Mech. 42 (1975): 440-445.
"""

lankarani_nikravesh = _with_chi(lambda e: 0.75 * (1.0 - e**2))
r"""chi = 3/4 (1 - e^2), derived for e near 1.

Lankarani, H. M., and P. E. Nikravesh. "A Contact Force Model with Hysteresis Damping for Impact
Analysis of Multibody Systems." J. Mech. Des. 112 (1990): 369-376.
"""

flores = _with_chi(lambda e: 1.6 * (1.0 - e) / e)
r"""chi = 8 (1 - e) / (5 e), for every e in (0, 1].

Flores, P., M. Machado, M. T. Silva, and J. M. Martins. "On the Continuous Contact Force Models for
Soft Materials in Multibody Dynamics." Multibody Syst. Dyn. 25 (2011): 357-375.
"""

gonthier = _with_chi(lambda e: (1.0 - e**2) / e)
r"""chi = (1 - e^2) / e, an approximation of its authors for every e in (0, 1].

Gonthier, Y., J. McPhee, C. Lange, and J.-C. Piedboeuf. "A Regularized Contact Model with Asymmetric
Damping and Dwell-Time Dependent Friction." Multibody Syst. Dyn. 11 (2004): 209-233.
"""

hu_guo = _with_chi(lambda e: 1.5 * (1.0 - e) / e)
r"""chi = 3 (1 - e) / (2 e), for every e in (0, 1].

Hu, S., and X. Guo. "A Dissipative Contact Force Model for Impact Analysis in Multibody Dynamics."
Multibody Syst. Dyn. 35 (2015): 131-151.
"""

DAMPING_LAWS: dict[str, Callable[..., NormalContact]] = {
    "step": step_damping,
    "hunt_crossley": hunt_crossley,
    "lankarani_nikravesh": lankarani_nikravesh,
    "flores": flores,
    "gonthier": gonthier,
    "hu_guo": hu_guo,
}
