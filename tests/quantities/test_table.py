"""What a person reads of a run, with as many digits as errors leave."""

import random
import re
from dataclasses import replace

import pytest

from exu_press import Scene, simulate
from exu_press.quantities.law_errors import eccentricity_error
from exu_press.quantities.quantity import Owner
from exu_press.quantities.remarks import difference_lines
from exu_press.quantities.table import SINGULAR, lines_by_heading
from exu_press.quantities.uncertain import CELL, bracket_text, uncertain
from exu_press.scene.film import BallFilm, Finite


def test_every_owner_has_its_quantities_under_its_name():
    drawing = Scene(mechanism="six_bar", joints={}).replace({"mechanism.bodies.ram.mass": 1.0})
    spring = {
        "between": ["ram", "frame"],
        "at": [[0, -1], [0, 1]],
        "stiffness": 1.0,
        "preload": 9.0,
    }
    mechanism = {**drawing.to_dict()["mechanism"], "springs": {"counter_balance": spring}}
    scene = drawing.replace({"mechanism": mechanism, "speed_rpm": 60.0, "revolutions": 0.01})
    lines = lines_by_heading({"": simulate(scene)})["spring counter balance"]
    assert any(line.title.startswith("spring force, max") for line in lines)
    assert {*SINGULAR, Owner.RUN} == set(Owner)


@pytest.fixture(scope="module")
def bare():
    return simulate(Scene(joints={}, revolutions=0.01))


def stated(low, high):
    return {"error": (high - low) / 2.0, "determined": True, "low": low, "high": high}


def runs(bare, **errors):
    return {
        label: replace(bare, info={**bare.info, "errors": entries})
        for label, entries in errors.items()
    }


def test_only_what_errors_leave_open_is_named(bare):
    dry = {"stroke": stated(1.0, 1.1), "peak_velocity": stated(2.0, 2.5)}
    oil = {"stroke": stated(1.2, 1.3), "peak_velocity": stated(2.4, 2.6)}
    (line,) = difference_lines(runs(bare, dry=dry, oil=oil))
    assert line.endswith("except in peak velocity")
    assert difference_lines(runs(bare, dry=dry, again=dry)) == ["dry, again: no figure differs"]
    (line,) = difference_lines(runs(bare, dry=dry) | {"old": bare})
    assert "old has no errors" in line
    assert difference_lines({"dry": bare, "oil": bare}) == []


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (856.937, 0.304, "856.94 +- 0.30"),
        (0.00012345, 1.2e-6, "0.0001234 +- 0.0000012"),
        (5, 0.0, "5 exact"),
        (12, 1.0, "12 +- 1"),
        (-0.0002, 0.049, "0.000 +- 0.049"),
        (26.28, 1e-9, "26.2800000 +- 0.0000001"),
        (1234.56, None, "1235"),
        (None, None, "-"),
    ],
)
def test_an_error_says_how_many_digits(value, error, text):
    stated = None
    if error is not None:
        stated = {"error": error, "determined": True, "low": value - error, "high": value + error}
    assert uncertain(value, stated) == text


@pytest.mark.parametrize(
    ("value", "low", "high", "text"),
    [(900.0, 0.0, 1084.6, "0 to 1080, not determined"), (5, 3, 7, "5 (3 to 7, not determined)")],
)
def test_without_determination_there_are_bounds(value, low, high, text):
    stated = {"error": 1.0, "determined": False, "low": low, "high": high}
    assert uncertain(value, stated) == text


@pytest.mark.parametrize(
    ("value", "error", "determined", "text"),
    [
        (857.31, 0.83, True, "857.3(9)"),
        (470.0, 5e-7, True, "470.000(1)"),
        (0.02, 0.28, True, "0.0(3)"),
        (19943.2, 21.0, True, "19940(30)"),
        (1.2345e-7, 3e-10, True, "1.235(4)e-7"),
        (0.0, 0.0, True, "=0"),
        (5, 2.0, False, "3..7"),
        (0.01, 0.00234, False, "76..124e-4"),
        (857.31, None, True, "857.3"),
        (None, None, True, "-"),
    ],
)
def test_a_narrow_cell_has_one_digit_of_the_error(value, error, determined, text):
    stated = None
    if error is not None:
        bounds = {"low": value - error, "high": value + error}
        stated = {"error": error, "determined": determined, **bounds}
    assert bracket_text(value, stated) == text


def test_no_narrow_cell_states_less_than_the_error():
    """Figures of all sizes fit, and their brackets and ranges hold what the error holds."""
    draw = random.Random(1)
    for _ in range(2000):
        value = draw.choice([-1, 1]) * 10.0 ** draw.uniform(-9, 9)
        error = abs(value) * 10.0 ** draw.uniform(-10, 3)
        low, high = value - error, value + error
        for determined in (True, False):
            stated = {"error": error, "determined": determined, "low": low, "high": high}
            text = bracket_text(value, stated)
            assert len(text) <= CELL
            if determined:
                mantissa, last, power = re.fullmatch(r"(.+)\((\d+)\)(?:e(.+))?", text).groups()
                places = len(mantissa.partition(".")[2])
                scale = 10.0 ** int(power or 0)
                middle, half = float(mantissa) * scale, int(last) * 10.0**-places * scale
                shown = middle - half, middle + half
            else:
                first, last, power = re.fullmatch(r"(.+)\.\.(.+?)(?:e(.+))?", text).groups()
                shown = (float(end) * 10.0 ** int(power or 0) for end in (first, last))
            least, largest = shown
            margin = 1e-6 * (high - low) + 1e-9 * abs(value)
            assert least <= low + margin and high - margin <= largest, (stated, text)


BALLS = Scene(
    mechanism="eccentric_press", speed_rpm=60.0, revolutions=0.3, joints={"balls": "lubricated"}
)
PIN = Scene(mechanism="slider_crank", revolutions=0.3, joints={"crank_pin": "lubricated"})
FIGURES = ("min_film", "dissipated", "max_eccentricity_ratio", "peak_force")


@pytest.mark.parametrize(
    ("scene", "joint", "part"),
    [(BALLS, "ball_left", BallFilm.law.error), (PIN, "crank_pin", Finite.error)],
    ids=["ball", "journal"],
)
def test_the_error_of_a_table_covers_a_film_that_is_as_much_stronger(scene, joint, part):
    """The film of a ball was 7.8 nm off for a stated 1.8 nm: the table's 0.2 % were left out."""
    run = simulate(scene, errors=True, beside=False)
    stronger = scene.replace({"film.viscosity": scene.film["viscosity"] * (1.0 + part)})
    other = simulate(stronger)
    for name in FIGURES:
        figure = run.quantity(f"joints.{joint}.{name}")
        moved = abs(other.quantity(f"joints.{joint}.{name}").value - figure.value)
        assert moved < figure.error, name
    assert eccentricity_error(scene, joint, 0.9) == pytest.approx(0.1 * part)
    film = run.quantity(f"joints.{joint}.min_film")
    assert 7.8e-9 < part * film.value <= film.error
