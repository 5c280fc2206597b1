"""Laws refuse parameters outside their range by name."""

import math

import pytest

from exu_press.laws.contact import (
    DAMPING_LAWS,
    cylindrical,
    delivered_restitution,
    flores,
    hertz,
    hertz_stiffness,
    hysteretic,
    restitution_of,
    step_damping,
)
from exu_press.laws.film import (
    film_scale,
    finite,
    pad_with_asperities,
    pi_film,
    short,
    with_asperities,
)
from exu_press.laws.film.plane_pad import plane_pad
from exu_press.laws.friction import LuGre, coulomb, lugre_steady, stribeck

CURVE = {"mu_static": 0.2, "mu_kinetic": 0.1, "stribeck_velocity": 0.01, "stribeck_exponent": 2.0}
COULOMB = {"mu_kinetic": 0.1, "regularisation_velocity": 1e-3}
SMOOTH = {**CURVE, "regularisation_velocity": 1e-3}
BRISTLE = {**CURVE, "sigma_0": 1e5, "sigma_1": 400.0, "sigma_2": 0.0}
LAW = flores(hertz(1e8), 0.5)


@pytest.mark.parametrize(
    ("law", "good", "name", "value"),
    [
        (coulomb, COULOMB, "mu_kinetic", -0.1),
        (coulomb, COULOMB, "regularisation_velocity", 0.0),
        (stribeck, SMOOTH, "mu_static", 0.05),
        (stribeck, SMOOTH, "mu_kinetic", 0.0),
        (stribeck, SMOOTH, "stribeck_velocity", 0.0),
        (stribeck, SMOOTH, "stribeck_exponent", 0.0),
        (stribeck, SMOOTH, "regularisation_velocity", math.nan),
        (stribeck, SMOOTH, "sigma_2", -1.0),
        (lugre_steady, {**SMOOTH, "sigma_2": 0.0}, "sigma_2", -1.0),
        (LuGre, BRISTLE, "mu_static", math.inf),
        (LuGre, BRISTLE, "sigma_0", 0.0),
        (LuGre, BRISTLE, "sigma_1", -1.0),
        (LuGre, BRISTLE, "sigma_2", math.nan),
    ],
)
def test_friction(law, good, name, value):
    law(**good)
    with pytest.raises(ValueError, match=rf"^{name} = {value!r}: allowed .*{name}"):
        law(**{**good, name: value})


@pytest.mark.parametrize("law", sorted({*DAMPING_LAWS} - {"step"}))
@pytest.mark.parametrize("restitution", [0.0, -0.1, 1.01, math.nan])
def test_restitution(law, restitution):
    message = rf"restitution = {restitution!r}: allowed 0 < restitution <= 1"
    with pytest.raises(ValueError, match=message):
        DAMPING_LAWS[law](hertz(1e8), restitution)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: step_damping(hertz(1e8), -1.0, 1e-5), "damping_max"),
        (lambda: step_damping(hertz(1e8), 1e3, 0.0), "damping_depth"),
        (lambda: hysteretic(hertz(1e8), 0.5, float, slowest_impact=0.0), "slowest_impact"),
        (lambda: restitution_of(-1.0), "chi"),
        (lambda: delivered_restitution(LAW, 0.0, 1.0), "mass"),
        (lambda: delivered_restitution(LAW, 1.0, 0.0), "speed"),
        (lambda: hertz(0.0), "stiffness"),
        (lambda: hertz(math.inf), "stiffness"),
        (lambda: hertz(1e8, 0.5), "exponent"),
        (lambda: hertz_stiffness(-1.0, 1e11), "radius"),
        (lambda: hertz_stiffness(1.0, 0.0), "modulus"),
        (lambda: cylindrical(1e11, 0.0, 1e-5), "length"),
        (lambda: cylindrical(1e11, 0.1, 0.0), "clearance"),
        (lambda: short(0.0), "length_to_diameter"),
        (lambda: short(math.nan), "length_to_diameter"),
        (lambda: finite(0.05), "length_to_diameter"),
        (lambda: finite(5.0), "length_to_diameter"),
        (lambda: with_asperities(pi_film(), 1.0), "onset_ratio"),
        (lambda: film_scale(0.4, -0.1, 0.07, 1e-4), "length"),
        (lambda: plane_pad(1.0, 1e-3), "width / length"),
        (lambda: plane_pad(0.0, 0.1), "length"),
        (lambda: pad_with_asperities(plane_pad(1.0, 0.1), 0.0), "onset"),
    ],
)
def test_contact_and_film(make, name):
    with pytest.raises(ValueError, match=rf"{name}\S* = .*: allowed"):
        make()
