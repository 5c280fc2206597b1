"""Validation: what a scene allows, what it refuses and what it says; what it fills in."""

import math
from functools import partial

import pytest
from refused import refused

from exu_press import Scene
from exu_press.scene.solver import Solver
from exu_press.schema.table import plain, table_from

PRESS = {"mechanism": "press"}
CRANK = {"mechanism": "slider_crank"}
IDEAL = {"mechanism": "press", "joints": {}}
DRY = {"mechanism": "press", "joints": {"crank_pin": "dry", "balls": "dry"}}

NUMBER_OF_EVERY_TABLE = [
    ("speed_rpm", PRESS),
    ("revolutions", PRESS),
    ("gravity", PRESS),
    ("start_angle_deg", PRESS),
    ("contact.damping_max", DRY),
    ("friction.mu_kinetic", DRY),
    ("film.viscosity", PRESS),
    ("solver.step", PRESS),
    ("press.slider_mass", PRESS),
    ("press.crank_radius", PRESS),
    ("slider_crank.rod_length", CRANK),
    ("slider_crank.slider_mass", CRANK),
]
MAY_BE_ABSENT = ("solver.step", "contact.damping_max", "film.viscosity")
NOT_A_NUMBER = [math.nan, math.inf, -math.inf, True, "1.0", [1.0], {}, None]


def with_key(base, key, value):
    table, _, inner = key.rpartition(".")
    return {**base, table: {inner: value}} if table else {**base, key: value}


refusal = partial(refused, Scene.from_dict)


@pytest.mark.parametrize(
    ("key", "base", "value"),
    [
        (key, base, value)
        for key, base in NUMBER_OF_EVERY_TABLE
        for value in NOT_A_NUMBER
        if not (value is None and key in MAY_BE_ABSENT)
    ],
)
def test_what_is_not_a_finite_number_is_refused(key, base, value):
    """NaN, infinity, true, a text, a list, a table; the message names key, value and what is."""
    message = refusal(with_key(base, key, value))
    assert f"{key} = {value!r}: allowed is a number" in message


def test_a_whole_number_too_large_for_a_float_is_refused():
    message = refusal({"speed_rpm": 10**400})
    assert "speed_rpm" in message


@pytest.mark.parametrize(
    ("key", "base"), [case for case in NUMBER_OF_EVERY_TABLE if "angle" not in case[0]]
)
def test_negative_is_refused(key, base):
    """Lengths, masses, clearances, times, coefficients."""
    message = refusal(with_key(base, key, -1e-3))
    assert message.startswith(f"{key} = -0.001: allowed is a number >")


@pytest.mark.parametrize(
    ("key", "base"),
    [
        ("speed_rpm", PRESS),
        ("revolutions", PRESS),
        ("contact.stiffness", DRY),
        ("film.viscosity", PRESS),
        ("film.length", PRESS),
        ("solver.step", PRESS),
        ("press.plunger_mass", PRESS),
        ("slider_crank.rod_inertia", CRANK),
    ],
)
def test_zero_is_refused_where_it_has_no_meaning(key, base):
    assert "allowed is a number > 0" in refusal(with_key(base, key, 0))


def test_a_run_that_exudyn_would_cut_short_is_refused():
    data = {"mechanism": "press", "revolutions": 2e-4, "speed_rpm": 2.4e5}
    told = refusal(data)
    assert told.startswith(
        "revolutions = 0.0002 at speed_rpm = 240000 is a run of 5e-08 s: allowed"
    )


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [
        ("solver.spectral_radius", 1.0, ">= 0.5 and <= 0.95"),
        ("solver.spectral_radius", 0.3, ">= 0.5 and <= 0.95"),
        ("contact.exponent", 0.9, ">= 1"),
        ("contact.exponent", 3.1, "<= 3"),
    ],
)
def test_ranges(key, value, allowed):
    assert allowed in refusal(with_key(PRESS, key, value))


@pytest.mark.parametrize(
    ("key", "value", "choices"),
    [
        ("mechanism", "crank_slider", ("'press'", "'slider_crank'")),
        ("friction.law", "coulumb", ("'none'", "'lugre_steady'", "'lugre'")),
        ("film.law", "pinkus-sternlicht", ("'pinkus'", "'pi_film'")),
        ("contact.damping", "kelvin", ("'step'",)),
        ("mechanism", 1, ("'press'",)),
        ("film.law", [], ("'pinkus'",)),
    ],
)
def test_choices_are_shown(key, value, choices):
    message = refusal(with_key(PRESS, key, value))
    assert f"{key} = {value!r}: allowed is one of " in message
    assert all(choice in message for choice in choices)


@pytest.mark.parametrize("value", [0, 1, "true", None], ids=repr)
def test_a_switch_is_true_or_false(value):
    assert "allowed is true or false" in refusal({**DRY, "contact": {"tension": value}})


@pytest.mark.parametrize(
    ("key", "known"),
    [
        ("speed", "speed_rpm"),
        ("film.viscocity", "viscosity"),
        ("solver.stepsize", "step"),
        ("press.knuckle_length", "link_6_length"),
        ("", "mechanism"),
    ],
)
def test_unknown_key_shows_the_known_ones(key, known):
    message = refusal(with_key(PRESS, key, 3))
    assert message.startswith(f"{key} = ")
    assert "unknown key" in message
    assert known in message.partition("allowed are ")[2]


@pytest.mark.parametrize("name", ["contact", "friction", "film", "guide", "solver", "press"])
@pytest.mark.parametrize("value", [5, 0.5, "pinkus", True, [], [{"law": "pinkus"}]], ids=repr)
def test_a_table_must_be_a_table(name, value):
    message = refusal({**PRESS, name: value})
    assert message.startswith(f"{name} = {value!r}: allowed is a table")


@pytest.mark.parametrize("data", [None, 3, [], "press"], ids=repr)
def test_a_scene_must_be_a_table(data):
    assert "allowed is a table" in refusal(data)


def test_step_and_tolerance_together_are_refused():
    message = refusal({**PRESS, "solver": {"step": 1e-5, "tolerance": 1e-3}})
    assert message.startswith("solver.tolerance = 0.001: not used by this scene (solver.step is")


def test_static_friction_is_at_least_kinetic_friction():
    message = refusal({**DRY, "friction": {"mu_static": 0.005}})
    assert message.startswith("friction.mu_static = 0.005: allowed is a number >= friction.mu_kin")


@pytest.mark.parametrize(
    ("key", "value", "names"),
    [
        ("linkage_length", 0.02, "linkage and slide lock"),
        ("counter_linkage_length", 0.01, "counter_linkage and counterweight lock"),
        ("link_5_length", 0.1, "press.link_5_length"),
        ("link_5_length", 0.1655, "press.link_5_length"),
        ("link_6_length", 0.01, "link_6_length"),
        ("link_7_length", 0.005, "press.link_7_length"),
        ("pivot_distance", 0.3, "press.link_5_length"),
        ("crank_radius", 0.25, "link"),
    ],
)
def test_links_that_cannot_be_assembled(key, value, names):
    message = refusal({**PRESS, "press": {key: value}})
    assert names in message
    assert " deg" in message, "says at which crank angle"


def test_slider_crank_that_cannot_be_assembled():
    message = refusal({**CRANK, "slider_crank": {"crank_radius": 0.5}})
    assert message.startswith("slider_crank: rod and slider lock")
    assert " deg" in message


@pytest.mark.parametrize(
    ("data", "name", "reason"),
    [
        ({**DRY, "film": {}}, "[film]", "no joint is 'lubricated'"),
        ({**DRY, "film": {"viscosity": 0.1}}, "[film]", "no joint is 'lubricated'"),
        ({**IDEAL, "film": {}}, "[film]", "no joint is 'lubricated'"),
        ({**IDEAL, "contact": {}}, "[contact]", "no joint is 'dry'"),
        ({**IDEAL, "friction": {}}, "[friction]", "no joint is 'dry'"),
        ({**CRANK, "contact": {}}, "[contact]", "no joint is 'dry'"),
        ({**CRANK, "press": {}}, "[press]", "mechanism is 'slider_crank'"),
        ({**PRESS, "slider_crank": {}}, "[slider_crank]", "mechanism is 'press'"),
    ],
)
def test_what_a_scene_does_not_use_is_refused(data, name, reason):
    message = refusal(data)
    assert message.startswith(name)
    assert "not used by this scene" in message
    assert reason in message


def test_defaults():
    """Table 2 and assumptions A-1 .. A-14, as the interface shows them."""
    scene = Scene()
    assert (scene.mechanism, scene.bodies) == ("press", {})
    assert (scene.speed_rpm, scene.revolutions, scene.start_angle_deg) == (240.0, 2.0, 0.0)
    assert {n: joint.kind for n, joint in scene.joints.with_clearance.items()} == {
        "crank_pin": "lubricated",
        "ball_left": "dry",
        "ball_right": "dry",
    }
    pin, ball = scene.joints["crank_pin"], scene.joints["ball_left"]
    assert pin.clearance == ball.clearance == 1e-4 and pin.radius == ball.radius == 0.07
    assert plain(pin.film) == scene.film
    assert (plain(ball.contact), plain(ball.friction)) == (scene.contact, scene.friction)
    assert (scene.contact["stiffness"], scene.contact["exponent"]) == (2.5545e10, 1.5)
    assert (scene.contact["damping_max"], scene.contact["damping_depth"]) == (2.5545e8, 1e-5)
    assert scene.contact["tension"] is False
    bristle = scene.replace({"friction.law": "lugre"}).friction
    assert (bristle["sigma_0"], bristle["sigma_1"], bristle["sigma_2"]) == (1e5, 400, 0)
    assert scene.friction["sigma_2"] == 0 and not {"sigma_0", "sigma_1"} & scene.friction.keys()
    assert (scene.film["viscosity"], scene.film["length"]) == (0.4, 0.1)
    assert scene.press.pivot_distance == 0.1655
    assert scene.press.counterweight.counter_eccentricity == 0.016
    assert scene.press.slide_mass == 60.0
    assert scene.press.bottom_dead_centre == 0.47
    assert not scene.load
    assert scene.slider_crank is None


def test_what_is_not_used_is_none():
    scene = Scene.from_dict(IDEAL)
    assert scene.contact is scene.friction is scene.film is None
    assert Scene.from_dict({**DRY}).film is None
    film_alone = Scene.from_dict(CRANK)
    assert film_alone.contact is film_alone.friction is None


def test_tables_may_be_dataclasses_or_mappings():
    by_mapping = Scene.from_dict({"film": {"viscosity": 0.1}, "solver": {"step": 1e-4}})
    solver = table_from(Solver, "solver", {"step": 1e-4})
    assert Scene(film={"viscosity": 0.1}, solver=solver) == by_mapping


def test_a_whole_number_is_taken_for_a_number():
    scene = Scene.from_dict({"speed_rpm": 300})
    assert type(scene.speed_rpm) is float


def test_a_scene_is_frozen():
    with pytest.raises(AttributeError):
        Scene().speed_rpm = 3.0


def test_derived_quantities():
    scene = Scene.from_dict({"speed_rpm": 120, "revolutions": 3, "start_angle_deg": 90})
    assert scene.angular_speed == pytest.approx(4 * math.pi)
    assert scene.duration == pytest.approx(1.5)
    assert scene.start_angle == pytest.approx(math.pi / 2)
