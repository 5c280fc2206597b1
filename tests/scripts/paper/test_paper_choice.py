"""The clearance of least cost, where it is known."""

import pytest

from exu_press import Scene
from paper.choice import cost, least, radii, separate
from paper.runs import clearance
from paper.value import Value

SIZES = (1e-5, 2.5e-5, 5e-5, 1e-4, 1.5e-4, 2e-4, 3e-4, 4e-4)
LINE = [clearance(Scene(), size) for size in SIZES]


def measure(error):
    """Return power b / c + c and acceleration c^1/2, whose product is least at c = 1.2e-4 m."""

    def of(scene, name):
        size = radii(scene)[1]
        value = size**0.5 if "acceleration" in name else 3.0 * 1.2e-4**2 / size + size
        return Value(value, value * (1.0 - error), value * (1.0 + error))

    return of


def test_the_least_of_a_known_cost_lies_between_its_neighbours():
    found = least(measure(1e-4), LINE, 1.0)
    assert (found.low, found.value, found.high) == (5e-5, 1e-4, 1.5e-4)
    narrower, wider = (least(measure(1e-4), LINE, weight) for weight in (2.0, 0.5))
    assert narrower.value < found.value < wider.value  # less acceleration: narrower


def test_errors_widen_where_it_may_be():
    found = least(measure(0.1), LINE, 1.0)
    assert found.low < 5e-5 and found.high > 1.5e-4


def test_a_run_that_stopped_is_left_out():
    assert least(lambda scene, name: None, LINE, 1.0) is None
    assert cost(lambda scene, name: None, LINE[0]) is None


def test_pin_and_balls_by_themselves():
    found = {radii(scene) for scene in separate(Scene(), (1e-5, 1e-4))}
    assert found == {(1e-5, 1e-5), (1e-5, 1e-4), (1e-4, 1e-5), (1e-4, 1e-4)}
    assert cost(measure(0.0), LINE[3]).value == pytest.approx(0.01 * (3 * 1.44e-4 + 1e-4))
