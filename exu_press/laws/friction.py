"""Friction coefficients: mu(v), signed like the sliding speed v of the two surfaces.

A joint applies the force -mu F_N along the sliding direction. A stateless law is a function
v [m/s] -> (mu, dmu/dv [s/m]); `LuGre` carries the bristle's deflection as a state besides.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import copysign, exp, expm1, sqrt, tanh

from exu_press.laws.parameters import demand, not_negative, positive

__all__ = ["Friction", "LuGre", "coulomb", "lugre_steady", "no_friction", "stribeck"]

PASSIVE = 4.0 * sqrt(2.0 * exp(1.0))
"""sigma_1 v_d / mu_k: the largest one with which LuGre's bristle makes no energy."""

Friction = Callable[[float], tuple[float, float]]


def no_friction() -> Friction:
    """No friction: mu = 0 at every speed.

    >>> no_friction()(0.1)
    (0.0, 0.0)
    """
    return lambda v: (0.0, 0.0) if v == v else (v, v)


def coulomb(mu_kinetic: float, regularisation_velocity: float) -> Friction:
    r"""Coulomb's friction, made smooth at rest, where it creeps.

    .. math::
        \mu = \mu_k \tanh(v / v_r)

    Parameters
    ----------
    mu_kinetic : mu_k [-], not negative
    regularisation_velocity : v_r [m/s], positive

    Returns
    -------
    The law: v [m/s] -> (mu [-], dmu/dv [s/m]).

    Raises
    ------
    InputError : an argument is outside its range

    Notes
    -----
    Range: any speed; from 3 v_r on mu is within 0.5 % of mu_k. It cannot stick.

    Examples
    --------
    >>> mu, slope = coulomb(0.1, regularisation_velocity=1e-3)(1e-3)
    >>> round(mu, 6), round(slope, 6)
    (0.076159, 41.997434)

    References
    ----------
    As of `stribeck`.
    """
    not_negative(mu_kinetic=mu_kinetic)
    positive(regularisation_velocity=regularisation_velocity)

    def friction(v: float) -> tuple[float, float]:
        direction = tanh(v / regularisation_velocity)
        slope = (1.0 - direction * direction) / regularisation_velocity
        return mu_kinetic * direction, mu_kinetic * slope

    return friction


def stribeck(
    mu_static: float,
    mu_kinetic: float,
    stribeck_velocity: float,
    stribeck_exponent: float,
    regularisation_velocity: float,
    sigma_2: float = 0.0,
) -> Friction:
    r"""Stribeck's curve, made smooth at rest, with viscous friction.

    .. math::
        \mu = \left[\mu_k + (\mu_s - \mu_k) e^{-|v / v_s|^\gamma}\right] \tanh(v / v_r)
        + \sigma_2 v

    Parameters
    ----------
    mu_static : mu_s [-], at least mu_kinetic
    mu_kinetic : mu_k [-], positive
    stribeck_velocity : v_s [m/s], positive
    stribeck_exponent : gamma [-], 0 < gamma <= 10; 0.5 to 2 in [1]_
    regularisation_velocity : v_r [m/s], positive
    sigma_2 : viscous friction [s/m], not negative

    Returns
    -------
    The law: v [m/s] -> (mu [-], dmu/dv [s/m]).

    Raises
    ------
    InputError : an argument is outside its range

    Notes
    -----
    Range: any speed. v_r has to be well below v_s, or the static peak is not reached.

    Examples
    --------
    >>> friction = stribeck(0.15, 0.1, 0.01, 2.0, regularisation_velocity=1e-4, sigma_2=0.02)
    >>> [round(friction(v)[0], 6) for v in (1e-3, 0.01, 1.0)]
    [0.149522, 0.118594, 0.12]

    References
    ----------
    .. [1] Armstrong-Helouvry, B., P. Dupont, and C. Canudas de Wit. "A Survey of Models, Analysis
       Tools and Compensation Methods for the Control of Machines with Friction." Automatica 30
       (1994): 1083-1138.
    """
    _demand_curve(mu_static, mu_kinetic, stribeck_velocity, stribeck_exponent)
    positive(regularisation_velocity=regularisation_velocity)
    not_negative(sigma_2=sigma_2)

    rise = mu_static - mu_kinetic

    def friction(v: float) -> tuple[float, float]:
        direction = tanh(v / regularisation_velocity)
        decay = _decay(abs(v) / stribeck_velocity, stribeck_exponent)
        peak = rise * exp(-decay)
        g, v_times_slope = mu_kinetic + peak, -stribeck_exponent * decay * peak  # as in LuGre
        slope = g * (1.0 - direction * direction) / regularisation_velocity + sigma_2
        if v != 0.0:
            slope += v_times_slope * direction / v
        return g * direction + sigma_2 * v, slope

    return friction


def lugre_steady(
    mu_static: float,
    mu_kinetic: float,
    sigma_2: float,
    stribeck_velocity: float,
    stribeck_exponent: float,
    regularisation_velocity: float,
) -> Friction:
    r"""Steady sliding of the LuGre bristle (Eq. 33).

    .. math::
        \mu = \mathrm{sgn}(v)\, g(v) + \sigma_2 v, \qquad
        g = \mu_k + (\mu_s - \mu_k) e^{-|v / v_s|^\gamma}

    The printed sign jumps by 2 mu_s at v = 0, where Newton's method would chatter for ever; here
    sgn(v) is tanh(v / v_r). This is `stribeck` with sigma_2 as its viscous part; arguments, what is
    returned and errors are as there.

    Notes
    -----
    Range: any speed; from |v| = 19 v_r on it equals the printed equation to rounding.

    Examples
    --------
    0.1 + 0.1 exp(-1/4):

    >>> mu, _ = lugre_steady(0.2, 0.1, 0.0, 0.01, 2.0, regularisation_velocity=1e-4)(0.005)
    >>> round(mu, 6)
    0.17788

    References
    ----------
    .. [1] Canudas de Wit, C., H. Olsson, K. J. Astrom, and P. Lischinsky. "A New Model for Control
       of Systems with Friction." IEEE Trans. Autom. Control 40 (1995): 419-425.
    """
    return stribeck(
        mu_static,
        mu_kinetic,
        stribeck_velocity,
        stribeck_exponent,
        regularisation_velocity,
        sigma_2,
    )


@dataclass(frozen=True, slots=True)
class LuGre:
    r"""LuGre friction, with the bristle's deflection z [m] as a state (Eqs. 27-32).

    .. math::
        \dot z = v - \frac{\sigma_0 |v|}{g(v)} z, \qquad
        g = \mu_k + (\mu_s - \mu_k) e^{-|v / v_s|^\gamma}

    .. math::
        \mu = \sigma_0 z + \sigma_1(v)\, \dot z + \sigma_2 v, \qquad
        \sigma_1(v) = \sigma_1 e^{-(v / v_d)^2}, \qquad
        v_d = 4 \sqrt{2 e}\, \mu_k / \sigma_1

    With a constant damping of the bristle, as printed, the model makes energy [2]_: a relaxed
    bristle gives mu = sigma_1 v at any speed. The published cure is a damping that falls with the
    speed [3]_. The power that is neither stored in the bristle nor viscous,

    .. math::
        \mu v - \frac{d}{dt} \frac{\sigma_0 z^2}{2} = |v| \left[ \frac{(\sigma_0 z)^2}{g}
        - \frac{\sigma_1(v) v \sigma_0 z}{g} + \sigma_1(v) |v| \right],

    is a square in sigma_0 z and not negative where sigma_1(v) |v| <= 4 g. The largest v_d for which
    this holds at every speed, with g at its least value mu_k, is the one above.

    Parameters
    ----------
    mu_static : mu_s [-], at least mu_kinetic
    mu_kinetic : mu_k [-], positive
    sigma_0 : stiffness of the bristle [1/m], positive
    sigma_1 : its damping [s/m] at rest, not negative
    sigma_2 : viscous friction [s/m], not negative
    stribeck_velocity : v_s [m/s], positive
    stribeck_exponent : gamma [-], 0 < gamma <= 10

    Raises
    ------
    InputError : an argument is outside its range

    Notes
    -----
    Range: any speed. In steady sliding mu is `lugre_steady`, for small displacements it is the
    spring sigma_0. At a constant normal force it is passive: in every state mu v is at least
    `stored_power`, and in every step, whatever the speeds at its ends, the bristle's
    force does at least the work that the bristle then stores. A normal force that grows stretches
    the bristles that it adds, as the model has it: that is work of nobody.

    Examples
    --------
    >>> friction = LuGre(1.5, 1.0, 1e5, 316.2, 0.4, 1e-3, 2.0)
    >>> mu, slope, z1 = friction.advance(v=1e-3, z0=0.0, h=1e-3)
    >>> round(mu, 6), round(z1 * 1e6, 6)
    (0.386549, 0.958932)

    References
    ----------
    .. [1] Canudas de Wit, C., H. Olsson, K. J. Astrom, and P. Lischinsky. "A New Model for Control
       of Systems with Friction." IEEE Trans. Autom. Control 40 (1995): 419-425.
    .. [2] Barabanov, N., and R. Ortega. "Necessary and Sufficient Conditions for Passivity of the
       LuGre Friction Model." IEEE Trans. Autom. Control 45 (2000): 830-832.
    .. [3] Olsson, H., K. J. Astrom, C. Canudas de Wit, M. Gafvert, and P. Lischinsky. "Friction
       Models and Friction Compensation." European Journal of Control 4 (1998): 176-195.
    """

    mu_static: float
    mu_kinetic: float
    sigma_0: float
    sigma_1: float
    sigma_2: float
    stribeck_velocity: float
    stribeck_exponent: float

    def __post_init__(self) -> None:
        _demand_curve(
            self.mu_static, self.mu_kinetic, self.stribeck_velocity, self.stribeck_exponent
        )
        positive(sigma_0=self.sigma_0)
        not_negative(sigma_1=self.sigma_1, sigma_2=self.sigma_2)

    def advance(
        self, v: float, z0: float, h: float, v_start: float | None = None
    ) -> tuple[float, float, float]:
        """One step: (mu, dmu/dv at fixed z0, h and v_start, z1).

        The speed goes linearly from start to end. Over the distance slid, the bristle's equation is
        linear, dz/ds = sgn(v) - sigma_0 z / g, so that a stretch in one direction gives its end in
        closed form, with g at the stretch's mean speed. A step in which the speed changes sign has
        two stretches. That is of second order where the speed is smooth, and stable however far the
        distance g / sigma_0 is below a stretch. On every stretch the bristle's force does at
        least the work that the bristle then stores. With h = 0 it is the value at z0 itself.
        Commit z1 only when the step is accepted. dmu/dv has a jump where the speed is zero; there
        it is the mean.

        Args:
            v: sliding speed at the end, m/s.
            z0: deflection at the start, m.
            h: size of the step, s.
            v_start: sliding speed at the start, m/s; v unless given.
        """
        if v_start is None:
            z1, by_stretch, by_mean, _ = self._slid(h * v, v, z0)
            z1_slope = by_stretch * h + by_mean
        elif v * v_start >= 0.0:
            mean = 0.5 * (v + v_start)
            z1, by_stretch, by_mean, _ = self._slid(h * mean, mean, z0)
            z1_slope = 0.5 * (by_stretch * h + by_mean)
        else:
            change = v - v_start
            there, back = -0.5 * h * v_start * v_start / change, 0.5 * h * v * v / change
            turned, by_there, _, _ = self._slid(there, 0.5 * v_start, z0)
            z1, by_back, by_mean, by_start = self._slid(back, 0.5 * v, turned)
            z1_slope = by_back * (h * v - back) / change + 0.5 * by_mean
            z1_slope -= by_start * by_there * there / change

        g, v_times_slope = self._curve(v)
        relaxation = self.sigma_0 * abs(v) / g
        z_dot = v - relaxation * z1
        relaxation_slope = _sign(v) * self.sigma_0 / g * (1.0 - v_times_slope / g)
        z_dot_slope = 1.0 - relaxation_slope * z1 - relaxation * z1_slope
        damping, damping_slope = self.damping(v)
        mu = self.sigma_0 * z1 + damping * z_dot + self.sigma_2 * v
        slope = self.sigma_0 * z1_slope + damping * z_dot_slope + self.sigma_2
        return mu, slope + damping_slope * z_dot, z1

    def _slid(self, stretch: float, mean: float, z0: float) -> tuple[float, float, float, float]:
        """Return z1 [m] after a stretch [m] at a mean speed [m/s], and its derivatives by all."""
        g, v_times_slope = self._curve(mean)
        direction = _sign(mean)
        over = self.sigma_0 * abs(stretch) / g
        decay = exp(-over)
        average = -expm1(-over) / over if over > 0.0 else 1.0
        bent = direction * self.sigma_0 * z0 / g
        z1 = z0 + stretch * average * (1.0 - bent)
        by_mean = 0.0
        if mean != 0.0:
            by_mean = v_times_slope / g * (stretch / mean) * (average - decay * (1.0 - bent))
        return z1, decay * (1.0 - bent), by_mean, decay

    def damping(self, v: float) -> tuple[float, float]:
        """sigma_1(v) [s/m] and its derivative [s^2/m^2]."""
        falling = self.sigma_1 / (PASSIVE * self.mu_kinetic)  # 1 / v_d
        scaled_velocity = falling * v
        coefficient = self.sigma_1 * exp(-scaled_velocity * scaled_velocity)
        return coefficient, -2.0 * falling * falling * v * coefficient

    def rate(self, v: float, z: float) -> float:
        """z_dot [m/s] of the bristle's differential equation."""
        return v - self.sigma_0 * abs(v) * z / self._curve(v)[0]

    def stored_energy(self, z: float) -> float:
        """Energy of a bristle per normal force, J/N."""
        return 0.5 * self.sigma_0 * z * z

    def stored_power(self, v: float, z: float) -> float:
        """Rate of `stored` in a state, W/N."""
        return self.sigma_0 * z * self.rate(v, z)

    def _curve(self, v: float) -> tuple[float, float]:
        """Stribeck's curve (g, v dg/dv); the product is finite at v = 0 for every exponent."""
        decay = _decay(abs(v) / self.stribeck_velocity, self.stribeck_exponent)
        peak = (self.mu_static - self.mu_kinetic) * exp(-decay)
        return self.mu_kinetic + peak, -self.stribeck_exponent * decay * peak


def _decay(ratio: float, exponent: float) -> float:
    """A power of a speed over Stribeck's, up to 1e30: no machine is faster, and it is a number."""
    return float(min(ratio, 1e30) ** exponent if ratio == ratio else ratio)


def _sign(v: float) -> float:
    return copysign(1.0, v) if v != 0.0 else 0.0


def _demand_curve(
    mu_static: float, mu_kinetic: float, stribeck_velocity: float, stribeck_exponent: float
) -> None:
    positive(mu_kinetic=mu_kinetic, stribeck_velocity=stribeck_velocity)
    demand(
        mu_kinetic <= mu_static < float("inf"),
        "mu_static",
        mu_static,
        f"mu_kinetic = {mu_kinetic!r} <= mu_static < inf",
        "Armstrong-Helouvry et al. 1994",
    )
    demand(
        0.0 < stribeck_exponent <= 10.0,
        "stribeck_exponent",
        stribeck_exponent,
        "0 < stribeck_exponent <= 10",
        "0.5 to 2 in Armstrong-Helouvry et al. 1994",
    )
