"""Equilibrium of a loaded journal that turns in a bearing at rest, and its linearization."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from exu_press.errors import InputError
from exu_press.laws.film.oil import HOTTEST
from exu_press.numerics.arrays import Array
from exu_press.scene import LubricatedJoint, Scene
from exu_press.scene.film import JournalFilm
from exu_press.studies.bearing.journal import Journal

__all__ = ["BearingCoefficients", "bearing_coefficients", "critical_mass", "journal_joint"]

HALVINGS = 12
"""Of the range of temperatures, where the film of the hottest oil does not bear the load."""


@dataclass(frozen=True)
class BearingCoefficients:
    """A bearing in the equilibrium of a load, in the drawing's axes.

    Attributes:
        load: on the journal, N.
        speed_rpm: of the journal, counter-clockwise.
        eccentricity: journal's centre - bearing's centre, m.
        eccentricity_ratio: its length over the clearance.
        min_film: least gap of the surfaces, at an end where the journal is inclined, m.
        attitude_angle: from the load to the eccentricity, in the sense of rotation, rad.
        stiffness: -dF/dx of the force on the journal, (2, 2), N/m.
        damping: -dF/dv, (2, 2), N s/m.
        side_flow: of oil out of both ends, m^3/s; None for a long bearing, which has no ends.
        power: that the journal loses, W.
        pump_power: that the pump of grooves under pressure puts in, W; None without them.
        viscosity: of the oil in the film, Pa s.
        temperature: of the film, deg C; None without [film.oil].
        critical_mass: of a rigid journal, above which it whirls, kg; infinite where none does.
    """

    joint: str
    load: tuple[float, float]
    speed_rpm: float
    eccentricity: tuple[float, float]
    eccentricity_ratio: float
    min_film: float
    attitude_angle: float
    stiffness: Array
    damping: Array
    side_flow: float | None
    power: float
    pump_power: float | None
    viscosity: float
    temperature: float | None
    critical_mass: float

    def to_dict(self) -> dict[str, Any]:
        """Return the contents as plain numbers; an infinite mass is None."""
        data = asdict(self)
        data |= {name: data[name].tolist() for name in ("stiffness", "damping")}
        stable = math.isinf(self.critical_mass)
        return data | {"critical_mass": None if stable else self.critical_mass}


def bearing_coefficients(
    scene: Scene | Mapping[str, Any], joint: str, *, load: tuple[float, float], speed_rpm: float
) -> BearingCoefficients:
    """Return the equilibrium of a load, and the linear coefficients about it.

    The force is that of the interface laws that a run of the scene has, also with a mixed film.
    An oil that warms has the temperature of its heat balance in the equilibrium.

    Args:
        joint: name of a lubricated journal; its bearing is at rest as it is drawn.
        load: on the journal, x and y of the drawing, N.
        speed_rpm: of the journal, counter-clockwise.

    Raises:
        InputError: the joint is no lubricated journal, or its surfaces are worn; load or speed are
            0 or no numbers; the film does not bear the load, or gets too hot.
    """
    scene = scene if isinstance(scene, Scene) else Scene.from_dict(scene)
    journal_joint(scene, joint)
    if not 0.0 < math.hypot(*load) < math.inf:
        raise InputError(f"load = {tuple(load)!r}: allowed is a force on the journal, not 0, in N")
    if not 0.0 < abs(speed_rpm) < math.inf:
        raise InputError(f"speed_rpm = {speed_rpm!r}: allowed is a number, not 0 (rpm)")
    journal = Journal(scene, joint, speed_rpm * math.tau / 60.0)
    temperature = _balance_heat(journal, load) if journal.oil is not None else None
    e = journal.equilibrium(load)
    stiffness, damping = journal.matrices(e)
    turn = math.copysign(1.0, speed_rpm)
    attitude = turn * (math.atan2(e[1], e[0]) - math.atan2(load[1], load[0]))
    return BearingCoefficients(
        joint=joint,
        load=(float(load[0]), float(load[1])),
        speed_rpm=float(speed_rpm),
        eccentricity=e,
        eccentricity_ratio=math.hypot(*e) / journal.clearance,
        min_film=journal.least_gap(e),
        attitude_angle=math.remainder(attitude, math.tau),
        stiffness=stiffness,
        damping=damping,
        side_flow=journal.side_flow(e),
        power=journal.power(e),
        pump_power=journal.pump_power(e),
        viscosity=journal.viscosity,
        temperature=temperature,
        critical_mass=critical_mass(stiffness, damping),
    )


def critical_mass(stiffness: Array, damping: Array) -> float:
    r"""Return the mass above which a rigid journal whirls.

    The motion m x'' + C x' + K x = 0 has the characteristic polynomial

    .. math::
        m^2 s^4 + m\, \mathrm{tr} C\, s^3 + (\det C + m\, \mathrm{tr} K)\, s^2 + B s + \det K,
        \qquad B = c_{xx} k_{yy} + c_{yy} k_{xx} - c_{xy} k_{yx} - c_{yx} k_{xy}

    and by Hurwitz' criterion it is damped below

    .. math::
        m = \frac{\mathrm{tr} C \det C\, B}{B^2 + \mathrm{tr}^2 C \det K - \mathrm{tr} C\,
        \mathrm{tr} K\, B}

    Parameters
    ----------
    stiffness : K [N/m], (2, 2)
    damping : C [N s/m], (2, 2)

    Returns
    -------
    m [kg]; infinity where no mass whirls, 0 where each is unstable.

    Examples
    --------
    With a direct stiffness k_0, a cross-coupling k and a damping c it is c^2 k_0 / k^2:

    >>> import numpy as np
    >>> critical_mass(np.array([[1.0, 2.0], [-2.0, 1.0]]), 4.0 * np.eye(2))
    4.0

    References
    ----------
    .. [1] Lund, J. W. "Review of the Concept of Dynamic Coefficients for Fluid Film Journal
       Bearings." J. Tribology 109 (1987): 37-41.
    """
    (k_xx, k_xy), (k_yx, k_yy) = stiffness.tolist()
    (c_xx, c_xy), (c_yx, c_yy) = damping.tolist()
    of_c, of_k = c_xx + c_yy, k_xx + k_yy
    det_c, det_k = c_xx * c_yy - c_xy * c_yx, k_xx * k_yy - k_xy * k_yx
    b = c_xx * k_yy + c_yy * k_xx - c_xy * k_yx - c_yx * k_xy
    if min(of_c, det_c, det_k, b) <= 0.0:
        return 0.0
    excess = b * b + of_c * of_c * det_k - of_c * of_k * b
    return of_c * det_c * b / excess if excess > 0.0 else math.inf


def journal_joint(scene: Scene, name: str) -> tuple[LubricatedJoint, JournalFilm]:
    """Return a scene's joint that is a lubricated journal of round surfaces, and its film.

    Raises:
        InputError: it is none; the message says which are.
    """
    kind = scene.joints[name]
    if isinstance(kind, LubricatedJoint) and isinstance(kind.film, JournalFilm):
        if kind.worn is not None and kind.worn.profiles() is not None:
            raise InputError(f"joints.{name}.worn: allowed are round surfaces, of an even depth")
        return kind, kind.film
    lubricated = [
        journal
        for journal, joint in scene.joints.items()
        if isinstance(joint, LubricatedJoint) and isinstance(joint.film, JournalFilm)
    ]
    allowed = ", ".join(lubricated) or "none here: --set joints.NAME=lubricated makes one"
    raise InputError(f"{name}: is no lubricated journal; allowed: {allowed}")


def _balance_heat(journal: Journal, load: tuple[float, float]) -> float:
    """Give the film the temperature at which it gets rid of its heat, and return it, deg C."""
    oil = journal.oil
    assert oil is not None

    def excess(temperature: float) -> float:
        journal.set_temperature(temperature, math.hypot(*load))
        e = journal.equilibrium(load)
        flow = journal.side_flow(e) or 0.0
        carried = oil.heat_capacity * flow * (temperature - oil.supply_celsius)
        heat = journal.power(e) + (journal.pump_power(e) or 0.0)
        return heat - carried - oil.conductance * (temperature - oil.frame)

    low, high, beyond = min(oil.supply_celsius, oil.frame), HOTTEST, HOTTEST
    for _ in range(HALVINGS):
        try:
            if excess(high) <= 0.0:
                break
        except InputError:  # so hot, the film does not bear the load
            beyond = high
        else:
            low = high
            if high == HOTTEST:
                raise InputError(
                    f"film.oil: the film would be hotter than {HOTTEST:g} deg C; allowed is less "
                    "load or speed, or more film.oil.conductance"
                )
        high = 0.5 * (low + beyond)
    else:
        excess(beyond)
    from scipy.optimize import brentq

    temperature = float(brentq(excess, low, high, xtol=1e-6))
    excess(temperature)
    return temperature
