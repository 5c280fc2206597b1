"""The slider-crank with clearance in its crank pin, by hand: two coordinates, plain floats.

Lagrange's equations for the rod's angle phi (direction from its crank end to its slider end) and
the slider's height y; the crank turns at constant speed. The functions take and return plain
floats, so that an integrator can call them as they are or compiled.
"""

import math
from collections.abc import Callable
from math import cos, exp, hypot, nan, pi, sin, sqrt, tanh
from typing import Any, NamedTuple

from exu_press.errors import InputError
from exu_press.scene import DryJoint, LubricatedJoint, Scene
from exu_press.schema.table import plain

__all__ = ["Jit", "Numbers", "ScalarFunction", "is_reducible", "numbers_of", "rate_of", "start_of"]

State = tuple[float, float, float, float]
PinForce = tuple[float, float, float, float]
ScalarFunction = Callable[..., Any]
"""Floats in, a tuple of floats out; Any, as a compiled one has no signature to check."""
Jit = Callable[[ScalarFunction], ScalarFunction]


class Numbers(NamedTuple):
    """Sizes and law parameters, SI; a key that the pin does not use is zero."""

    crank_radius: float
    rod_length: float
    rod_mass: float
    rod_inertia: float
    slider_mass: float
    gravity: float
    speed: float
    start_angle: float
    clearance: float
    radius: float
    stiffness: float
    exponent: float
    damping_max: float
    damping_depth: float
    mu_static: float
    mu_kinetic: float
    sigma_2: float
    stribeck_velocity: float
    stribeck_exponent: float
    regularisation_velocity: float
    film_scale: float


def numbers_of(scene: Scene) -> Numbers:
    """Return the numbers of a slider-crank's scene.

    Raises:
        InputError: the scene is not a slider-crank with a pin that is reduced here.
    """
    if not is_reducible(scene):
        raise InputError(
            "the reduced model is a rigid slider-crank without load that starts centred, with a "
            "dry pin (point contact, step damping, lugre_steady) or with the film law 'pinkus'"
        )
    size, pin = scene.slider_crank, scene.joints["crank_pin"]
    assert size is not None and isinstance(pin, DryJoint | LubricatedJoint)
    contact = {} if pin.contact is None else plain(pin.contact)
    friction = {} if pin.friction is None else plain(pin.friction)
    return Numbers(
        crank_radius=size.crank_radius,
        rod_length=size.rod_length,
        rod_mass=size.rod_mass,
        rod_inertia=size.rod_inertia,
        slider_mass=size.slider_mass,
        gravity=scene.gravity,
        speed=scene.angular_speed,
        start_angle=scene.start_angle,
        clearance=pin.clearance,
        radius=pin.radius,
        stiffness=contact.get("stiffness", 1.0),
        exponent=contact.get("exponent", 1.0),
        damping_max=contact.get("damping_max", 0.0),
        damping_depth=contact.get("damping_depth", 1.0),
        mu_static=friction.get("mu_static", 0.0),
        mu_kinetic=friction.get("mu_kinetic", 0.0),
        sigma_2=friction.get("sigma_2", 0.0),
        stribeck_velocity=friction.get("stribeck_velocity", 1.0),
        stribeck_exponent=friction.get("stribeck_exponent", 1.0),
        regularisation_velocity=friction.get("regularisation_velocity", 1.0),
        film_scale=pin.film_scale if isinstance(pin, LubricatedJoint) else 0.0,
    )


def is_reducible(scene: Scene) -> bool:
    """Return whether the reduced model holds a scene's mechanism and laws."""
    if scene.mechanism != "slider_crank" or scene.bodies or scene.load or scene.start != "centred":
        return False
    if set(scene.joints.with_clearance) != {"crank_pin"}:
        return False
    pin = scene.joints["crank_pin"]
    if isinstance(pin, LubricatedJoint):
        film = plain(pin.film)
        return (film["law"], film["at_contact"]) == ("pinkus", "stop")
    assert isinstance(pin, DryJoint) and pin.contact is not None and pin.friction is not None
    keys = {**plain(pin.contact), **plain(pin.friction)}
    required = {"shape": "point", "damping": "step", "tension": False, "law": "lugre_steady"}
    return required.items() <= keys.items()


def start_of(numbers: Numbers) -> State:
    """Return phi (rad), y (m) and their rates of the ideal mechanism at the start."""
    n = numbers
    across, up = n.crank_radius * sin(n.start_angle), n.crank_radius * cos(n.start_angle)
    phi = -math.acos(across / n.rod_length)  # from the pin down to the guide at x = 0
    phi_t = n.speed * up / (-n.rod_length * sin(phi))
    y = up + n.rod_length * sin(phi)
    return phi, y, phi_t, -n.speed * across + n.rod_length * cos(phi) * phi_t


def dry_force(
    n: Numbers, e: float, n_rate: float, t_rate: float, omega_j: float, omega_b: float, c: float
) -> PinForce:
    """Return f_n, f_t on the journal (N), the arm of -f_t on the bearing (m), and a couple on that.

    The couple (N m) is a film's shear.

    Hertz with STEP damping and no tension (Eqs. 23-26), steady LuGre friction (Eq. 33).

    Args:
        n: sizes and parameters.
        e: eccentricity, m.
        n_rate: its rate, m/s.
        t_rate: relative velocity across it, m/s.
        omega_j: angular velocity of the journal, rad/s.
        omega_b: angular velocity of the bearing, rad/s.
        c: clearance, m.
    """
    depth, reach = e - c, n.radius + e
    if depth <= 0.0:
        return 0.0, 0.0, reach, 0.0
    x = min(depth / n.damping_depth, 1.0)
    damping = n.damping_max * x * x * (3.0 - 2.0 * x)
    normal = max(0.0, n.stiffness * depth**n.exponent + damping * n_rate)
    v = t_rate + omega_j * n.radius - omega_b * reach
    stribeck = exp(-((abs(v) / n.stribeck_velocity) ** n.stribeck_exponent))
    mu = (n.mu_kinetic + (n.mu_static - n.mu_kinetic) * stribeck) * tanh(
        v / n.regularisation_velocity
    ) + n.sigma_2 * v
    return -normal, -mu * normal, reach, 0.0


def film_force(
    n: Numbers, e: float, n_rate: float, t_rate: float, omega_j: float, omega_b: float, c: float
) -> PinForce:
    """Return the same of Pinkus' film with |eps_dot| (Eq. 35); NaN at eccentricity ratio 1."""
    eps, eps_t = e / c, n_rate / c
    if eps >= 1.0:
        return nan, nan, nan, nan
    eps_w = eps * (omega_j + omega_b) - 2.0 * t_rate / c
    s2, two = 1.0 - eps * eps, 2.0 + eps * eps
    s, b = sqrt(s2), abs(eps_t) * eps
    big_s = s * hypot(0.5 * eps_w, eps_t)
    x = 1.0 + (3.0 * eps * eps_t / (2.0 * big_s + 3.0 * b) if b > 0.0 else 0.0)
    f_r = -(24.0 * eps * big_s / two + 6.0 * pi * x * eps_t) / (s2 * s)
    f_t = 6.0 * pi * x * eps_w / (two * s)
    shear = n.film_scale * c * 2.0 * pi / s * (omega_j - omega_b)
    return n.film_scale * f_r, n.film_scale * f_t, 0.5 * e, shear


def _pin_forces(law: ScalarFunction, jit: Jit) -> ScalarFunction:
    """Return the pin's force on the rod along y (N) and on phi (N m), of (numbers, t, phi, ...)."""
    law = jit(law)

    def pin(
        n: Any, t: float, phi: float, y: float, phi_t: float, y_t: float
    ) -> tuple[float, float]:
        angle, r, big_l = n.start_angle + n.speed * t, n.crank_radius, n.rod_length
        cos_a, sin_a, cos_p, sin_p = cos(angle), sin(angle), cos(phi), sin(phi)
        e_x = -r * sin_a + big_l * cos_p  # journal on the crank less bearing on the rod
        e_y = r * cos_a - y + big_l * sin_p
        u = -r * n.speed * cos_a - big_l * sin_p * phi_t
        v = -r * n.speed * sin_a - y_t + big_l * cos_p * phi_t
        e = hypot(e_x, e_y)
        n_x, n_y = (e_x / e, e_y / e) if e > 0.0 else (1.0, 0.0)
        f_n, f_t, reach, couple = law(
            n, e, u * n_x + v * n_y, v * n_x - u * n_y, n.speed, phi_t, n.clearance
        )
        f_x, f_y = f_n * n_x - f_t * n_y, f_n * n_y + f_t * n_x
        on_phi = big_l * (f_y * cos_p - f_x * sin_p) - reach * f_t + couple
        return -f_y, on_phi

    return jit(pin)


def rate_of(scene: Scene, jit: Jit | None = None) -> ScalarFunction:
    """Return the equations of motion of a scene.

    They are (t, phi, y, phi_t, y_t) -> (phi_t, y_t, phi_tt, y_tt), SI.

    Args:
        scene: a slider-crank with a dry pin or a film.
        jit: compiles a function, as numba.njit does; None leaves them as they are.
    """
    jit = jit or _as_it_is
    n = numbers_of(scene)
    forces = _pin_forces(dry_force if scene.joints["crank_pin"].kind == "dry" else film_force, jit)

    def rate(
        t: float, phi: float, y: float, phi_t: float, y_t: float
    ) -> tuple[float, float, float, float]:
        q_y, q_phi = forces(n, t, phi, y, phi_t, y_t)
        half, cos_p, sin_p = 0.5 * n.rod_length, cos(phi), sin(phi)
        a, b = n.rod_inertia + n.rod_mass * half * half, -n.rod_mass * half * cos_p
        d = n.rod_mass + n.slider_mass
        rhs_phi = q_phi + n.rod_mass * n.gravity * half * cos_p
        rhs_y = q_y - d * n.gravity - n.rod_mass * half * sin_p * phi_t * phi_t
        det = a * d - b * b
        return phi_t, y_t, (d * rhs_phi - b * rhs_y) / det, (a * rhs_y - b * rhs_phi) / det

    return jit(rate)


def _as_it_is(function: ScalarFunction) -> ScalarFunction:
    return function
