"""Springs in drawings: their laws, their energies, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from exu_press import InputError
from exu_press.mechanism import mechanism_from_dict, mechanism_to_dict, shipped_mechanism
from exu_press.mechanism.examine import examine
from exu_press.mechanism.spring_motion import spring_motion
from exu_press.mechanism.springs import GasSpring, LinearSpring
from exu_press.mechanism.turning import require_turning

ENDS = ("ram", "frame"), ((0.1, 0.2), (0.1, 0.9))
PRESS = shipped_mechanism("cycloidal_press")
LINEAR = {"stiffness": 1e4, "preload": -500.0, "damping": 20.0}
GAS = {"area": -0.01, "pressure": 6e5, "volume": 0.02, "exponent": 1.4}


def sprung(**keys):
    kind = GasSpring if "area" in keys else LinearSpring
    ends = {"between": ("ram", "frame"), "at": ((0.0, -0.4), (0.0, 0.3))}
    return replace(PRESS, springs=(kind("balance", **{**ends, **keys}),))


@pytest.mark.parametrize(
    "spring",
    [
        LinearSpring("s", *ENDS, stiffness=2e3, free_length=0.5),
        *(
            GasSpring("s", *ENDS, area=area, pressure=5e5, volume=0.02, exponent=n)
            for area, n in ((0.01, 1.4), (0.01, 1.0), (-0.01, 1.2), (0.02, 0.0))
        ),
    ],
    ids=lambda spring: type(spring).__name__,
)
def test_force_is_the_slope_of_the_energy(spring):
    """Work from the drawn length to another one, by quadrature."""
    stored = np.diff(spring.energy(np.array([0.7, 0.4])))[0]
    assert -quad(spring.static_force, 0.7, 0.4)[0] == pytest.approx(stored, rel=1e-9)


@pytest.mark.validation(
    "closed form", "gas spring, compressed to half its volume", "p V^n constant", "equation"
)
def test_gas_follows_its_polytropic(compare):
    """Half the volume: 2^n times the pressure, and for n = 1 the work p V ln 2."""
    gas = GasSpring("s", *ENDS, area=0.01, pressure=5e5, volume=0.006, exponent=1.4, ambient=0.0)
    assert gas.gas_volume(0.4) == pytest.approx(0.003)
    force = 0.01 * 5e5 * 2.0**1.4
    compare("force, n = 1.4", force, gas.static_force(0.4), error=0.0, rel=1e-12, unit="N")
    work = replace(gas, exponent=1.0).energy(np.array([0.4]))
    compare("work, n = 1", 3e3 * np.log(2.0), work, error=0.0, rel=1e-12, unit="J")
    nearly = replace(gas, exponent=1.0 + 1e-9)
    assert nearly.energy(np.array([0.4]))[0] == pytest.approx(3e3 * np.log(2.0), rel=1e-8)


def test_lengths_follow_the_bodies():
    """Between the planet and the ram: rate and acceleration are derivatives of the length."""
    mechanism = replace(
        PRESS,
        springs=(
            LinearSpring("s", ("planet", "ram"), ((0.02, 0.09), (0.1, -0.4)), 1e3, preload=0.0),
        ),
    )
    angles = np.linspace(0.0, 2.0 * np.pi, 1001)
    motion = spring_motion(mechanism, mechanism.springs[0], mechanism.motion(angles, 1.0))
    differences = np.gradient(motion.length, angles, edge_order=2)
    assert motion.rate == pytest.approx(differences, abs=1e-5)
    assert motion.velocity[1:-1] == pytest.approx(
        np.gradient(motion.position, angles, axis=0)[1:-1], abs=1e-5
    )


@pytest.mark.parametrize("keys", [LINEAR, GAS, {"stiffness": 1.0, "free_length": 0.0}])
def test_a_file_has_its_springs(keys):
    mechanism = sprung(**keys)
    assert mechanism_from_dict(mechanism_to_dict(mechanism)) == mechanism
    if "preload" in keys:  # the force in the drawing
        (spring,) = mechanism.springs
        assert spring.static_force(spring.drawn_length) == pytest.approx(-500.0)
        assert spring.force(0.7, 2.0) == pytest.approx(-540.0)


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        ({"stiffness": 1e4, "free_length": -0.1}, r"free_length = -0\.1: .* length >= 0"),
        ({"stiffness": 1e3, "preload": -1e3}, r"preload = -1000\.0: its free length"),
        ({"stiffness": 1e4}, r"has neither free_length and preload"),
        ({**LINEAR, "free_length": 0.1}, r"has both free_length and preload"),
        ({**LINEAR, "between": ("ram", "ram")}, r"joins 'ram' to itself"),
        ({**LINEAR, "at": ((0.0, 0.1), (0.0, 0.1))}, r"its ends coincide"),
        ({**LINEAR, "at": ((0.0, 0.1),)}, r"allowed are two points"),
    ],
)
def test_refused(keys, text):
    with pytest.raises(InputError, match=rf"springs\.balance.*{text}"):
        sprung(**keys)


@pytest.mark.parametrize(
    ("keys", "angle", "text"),
    [
        ({**LINEAR, "at": ((0.1, -0.4924), (0.1, -0.6))}, None, "has no length"),
        ({**GAS, "volume": 1e-3}, 180.0, r"has a volume of -0\.0006 m\^3"),
    ],
)
def test_impossible_somewhere_is_told_with_the_angle(keys, angle, text):
    """A ram that passes the foot of its spring, and a gas that has no volume at the bottom."""
    mechanism = sprung(**keys)
    with pytest.raises(
        InputError, match=rf"at crank angle .* deg springs\.balance {text}"
    ) as raised:
        require_turning(mechanism)
    assert examine(mechanism).stroke is None
    ram = mechanism.ideal_slider(np.array([raised.value.angle]), 1.0)[0][0]
    if angle is None:
        assert ram == pytest.approx(-0.6, abs=1e-9)
    else:
        assert np.degrees(raised.value.angle) == pytest.approx(angle, abs=1e-6)
