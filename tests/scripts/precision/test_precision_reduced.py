"""The package's hand-reduced slider-crank against the tests' own one, which shares no code."""

import numpy as np
import pytest
from independent.reduced_slider_crank import ReducedSliderCrank

from exu_press import Scene
from exu_press.mechanism.press import PAPER_LAWS
from precision.reduced import numbers_of, rate_of, start_of

PINS = {"dry": "lugre_steady", "lubricated": "pinkus"}


def scene(pin, **changes):
    dry = PAPER_LAWS
    laws = {"film": {"law": "pinkus"}} if pin == "lubricated" else dry
    joints = {"crank_pin": pin}
    return Scene(
        mechanism="slider_crank",
        joints=joints,
        revolutions=1.0,
        **{"start": "centred", **laws, **changes},
    )


def states(pin, count=40):
    """States around the start: in free flight, in the film and in contact."""
    reach = 2e-4 if pin == "dry" else 2e-5
    noise = np.random.default_rng(1).normal(size=(count, 4))
    return np.array(start_of(numbers_of(scene(pin)))) + noise * [reach, reach, 1e-2, 1e-3]


@pytest.mark.parametrize("pin", PINS)
def test_rates_equal_those_of_the_independent_model(pin):
    rate = rate_of(scene(pin))
    other = ReducedSliderCrank(PINS[pin])
    for x in states(pin):
        assert rate(1e-5, *x.tolist()) == pytest.approx(other.rate(1e-5, x.tolist()), rel=1e-9)
