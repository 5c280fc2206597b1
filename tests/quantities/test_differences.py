"""A difference is real where the errors of the two values do not explain it."""

from dataclasses import replace

import pytest

from exu_press import Scene, simulate
from exu_press.quantities.table import difference_lines


@pytest.fixture(scope="module")
def bare():
    return simulate(Scene(joints={}, revolutions=0.01))


def told(low, high):
    return {"error": (high - low) / 2.0, "determined": True, "low": low, "high": high}


def runs(bare, **errors):
    return {
        label: replace(bare, info={**bare.info, "errors": each}) for label, each in errors.items()
    }


def test_only_what_errors_leave_open_is_named(bare):
    dry = {"stroke": told(1.0, 1.1), "peak_velocity": told(2.0, 2.5)}
    oil = {"stroke": told(1.2, 1.3), "peak_velocity": told(2.4, 2.6)}
    (line,) = difference_lines(runs(bare, dry=dry, oil=oil))
    assert "peak_velocity" in line and "stroke" not in line


def test_nothing_is_said_without_errors(bare):
    assert difference_lines({"dry": bare, "oil": bare}) == []


def test_a_run_without_errors_is_named(bare):
    (line,) = difference_lines(runs(bare, dry={"stroke": told(1.0, 1.1)}) | {"old": bare})
    assert "old has no errors" in line


def test_many_names_are_wrapped(bare):
    names = [f"joints.knuckle_{n}.peak_force" for n in range(20)]
    one = {name: told(1.0, 2.0) for name in names}
    other = {name: told(1.5, 2.5) for name in names}
    lines = difference_lines(runs(bare, dry=one, oil=other))
    assert max(map(len, lines)) <= 100
    assert " ".join(line.strip() for line in lines).count("knuckle") == 20
