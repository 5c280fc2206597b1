"""Stated errors beside true ones."""

import dataclasses

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.verification.stated_errors import NOTHING, compare_errors

STROKE = "stroke"


@pytest.fixture(scope="module")
def run():
    return simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.2))


def of_stroke(run, reference, error):
    """Return the stroke of both, of which the run states this error over the stroke."""
    value = run.quantity(STROKE).value
    told = {
        "error": error * value,
        "determined": True,
        "low": value * (1.0 - error),
        "high": value * (1.0 + error),
    }
    stating = dataclasses.replace(run, info={**run.info, "errors": {STROKE: told}})
    (found,) = compare_errors(stating, reference)
    return found


def longer(run, part):
    """Return a run whose slider moves further, by this part."""
    place = run["slider_position"]
    return run.with_values({"slider_position": place[0] + (place - place[0]) * (1.0 + part)})


@pytest.mark.parametrize("part", [0.01, -0.01])
def test_a_stated_error_covers_what_is_within_it(run, part):
    reference = longer(run, part)
    stated = of_stroke(run, reference, 0.011)
    assert stated.is_covered
    assert stated.true_error == pytest.approx(0.01 * stated.value)
    assert stated.ratio == pytest.approx(1.1)
    assert not of_stroke(run, reference, 0.009).is_covered
    nothing = of_stroke(run, longer(run, 0.5 * NOTHING), 0.0)
    assert nothing.is_covered and nothing.ratio is None


def test_what_alternates_in_the_reference_is_open(run):
    """Of a peak that alternates by 4 % from step to step, nobody knows more than that."""
    name = "joints.shaft.peak_force"
    value = run.quantity(name).value
    signs = np.where(np.arange(len(run.time)) % 2, 1.0, -1.0)[:, None]
    reference = run.with_values({"shaft_force": run["shaft_force"] * (1.0 + 0.04 * signs)})
    told = {"error": 0.0, "determined": True, "low": value, "high": value}
    stating = dataclasses.replace(run, info={**run.info, "errors": {name: told}})
    (found,) = compare_errors(stating, reference)
    assert found.reading_error == pytest.approx(0.04 * value, rel=0.3)
    assert found.is_covered
    assert found.ratio is None
