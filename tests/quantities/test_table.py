"""What a person reads of a run."""

from dataclasses import replace

import pytest

from exu_press import Scene, simulate
from exu_press.quantities.quantity import Owner
from exu_press.quantities.table import SINGULAR, difference_lines, lines_by_heading


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
    assert "peak_velocity" in line and "stroke" not in line
    assert difference_lines(runs(bare, dry=dry, again=dry)) == ["dry, again: no figure differs"]
    (line,) = difference_lines(runs(bare, dry=dry) | {"old": bare})
    assert "old has no errors" in line
    assert difference_lines({"dry": bare, "oil": bare}) == []
