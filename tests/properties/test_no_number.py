"""Every law answers what is no number with no number, and a state of any size without an error.

Newton's method may try any state on its way. Whatever a law says then, the step is repeated: but
an exception ends the run.
"""

import itertools
import math

import pytest

from exu_press.laws.contact import DAMPING_LAWS, cylindrical, hertz
from exu_press.laws.film import with_asperities
from exu_press.laws.friction import LuGre, coulomb, lugre_steady, no_friction, stribeck
from exu_press.laws.load_curve import LoadCurve, blanking_pulse, closing
from exu_press.laws.motor import kloss, torque_table
from exu_press.scene.film import Finite, PiFilm, Pinkus, Short

STIFFNESSES = {
    "point": hertz(2.5e10),
    "spring": hertz(1e9, 1.0),
    "steep": hertz(1e9, 10.0),
    "cylinder": cylindrical(1e11, 0.1, 1e-4),
}
CONTACTS = {
    f"{name} on a {shape}": law(stiffness, *parameters)
    for shape, stiffness in STIFFNESSES.items()
    for name, law in DAMPING_LAWS.items()
    for parameters in [(1e8, 1e-5) if name == "step" else (0.5,)]
}
FILMS = {kind.registered_name: kind().film(0.5) for kind in (Pinkus, PiFilm, Short, Finite)}
FILMS |= {f"{name}, mixed": with_asperities(law, 0.02) for name, law in FILMS.items()}
FRICTIONS = {
    "none": no_friction(),
    "coulomb": coulomb(0.1, 1e-3),
    "stribeck": stribeck(0.2, 0.1, 0.01, 10.0, 1e-4, 0.01),
    "lugre_steady": lugre_steady(0.2, 0.1, 0.01, 0.01, 2.0, 1e-4),
}
BRISTLE = LuGre(0.2, 0.1, 1e5, 100.0, 0.01, 0.01, 10.0)
LOADS = {
    "over time": LoadCurve([0.0, 0.1], [0.0, 1e3]),
    "over the crank angle": LoadCurve([0.0, 1.0, 2.0], [0.0, 1e3, 0.0], 2.0 * math.pi),
    "blanking": LoadCurve(*blanking_pulse(1e4, 1e-3, 5e-4), 1.0),
}
DRIVES = {
    "kloss": kloss(400.0, 0.05, 1e3, 25.0),
    "table": torque_table([0.0, 20.0, 25.0], [300.0, 400.0, 0.0]),
}

LAWS = (
    {f"contact, {name}": (law.force, (1e-6, 0.1, 0.2)) for name, law in CONTACTS.items()}
    | {f"energy, {name}": (law.elastic_energy, (1e-6,)) for name, law in CONTACTS.items()}
    | {f"loss, {name}": (law.dissipated_power, (1e-6, 0.1, 0.2)) for name, law in CONTACTS.items()}
    | {f"film, {name}": (law, (0.4, 3.0, -2.0)) for name, law in FILMS.items()}
    | {f"friction, {name}": (law, (0.1,)) for name, law in FRICTIONS.items()}
    | {"friction, lugre": (BRISTLE.advance, (0.1, 1e-6, 1e-4))}
    | {f"load, {name}": (law, (0.05,)) for name, law in LOADS.items()}
    | {"load, closing": (closing, (-1e-4, 1e-3))}
    | {f"drive, {name}": (law, (20.0,)) for name, law in DRIVES.items()}
)
NOT_READ = {  # the speed of impact
    (f"{what}, step on a {shape}", 2) for what in ("contact", "loss") for shape in STIFFNESSES
}


def first(response):
    """Return the force or the coefficient of a law's answer."""
    return response[0] if isinstance(response, tuple) else response


@pytest.mark.parametrize("name", LAWS)
def test_no_number_for_no_number(name):
    law, usual = LAWS[name]
    assert math.isfinite(first(law(*usual)))
    for place in range(len(usual)):
        if (name, place) not in NOT_READ:
            tried = [*usual]
            tried[place] = math.nan
            assert math.isnan(first(law(*tried))), f"argument {place + 1}"


def test_a_contact_that_is_open_tells_a_rate_that_is_none():
    for law in CONTACTS.values():
        assert law.force(-1e-6, 0.1, 0.2) == (0.0, 0.0, 0.0)
        assert math.isnan(law.force(-1e-6, math.nan, 0.2)[0])
        assert math.isnan(law.dissipated_power(-1e-6, math.nan, 0.2))


ANYTHING = [0.0, 5e-324, 0.9, 1.0, 20.0, 1e60, 1e154, 1e308, math.inf]
ANYTHING = [*ANYTHING, *(-value for value in ANYTHING), math.nan]


@pytest.mark.parametrize("name", LAWS)
def test_no_state_is_an_error(name):
    law, usual = LAWS[name]
    for state in itertools.product(ANYTHING, repeat=len(usual)):
        if name == "friction, lugre":
            state = (*state[:2], abs(state[2]))  # a step is not negative
        if name == "load, closing":
            state = (state[0], 1e-3)  # a parameter
        answer = law(*state)
        numbers = answer if isinstance(answer, tuple) else [answer]
        assert all(isinstance(x, float) for x in numbers), state
