"""The integrator against numbers that nobody here made: Andrews' squeezer at 0.03 s."""

import numpy as np
import pytest
from independent.reduced_slider_crank import ReducedSliderCrank

from exu_press import Scene
from exu_press.mechanism.press import PAPER_LAWS
from precision.reduced import numbers_of, rate_of, start_of
from precision.squeezer import END, _start_places, squeezer_attempts, squeezer_errors


def angle_error(attempt):
    run = attempt.run()
    assert run.status == "completed", run.reason
    return squeezer_errors(run.trajectory).position


def test_the_published_start_closes_every_loop():
    from precision.squeezer import FRAME, JOINTS, POINTS, _turned

    places = _start_places()
    for name, *bodies in JOINTS:
        ends = []
        for body in bodies:
            x, y, angle = places[body - 1] if body else (0.0, 0.0, 0.0)
            along, across = _turned(POINTS[body][name], angle) if body else FRAME[name]
            ends.append((x + along, y + across))
        assert ends[0] == pytest.approx(ends[1], abs=1e-15), name


def test_fixed_steps_reach_the_published_endpoint_with_second_order():
    """15.8 rad of crank; 1.3e-4 rad off at 1e-5 s."""
    steps = (3e-5, 1.5e-5, 1e-5)
    errors = [angle_error(attempt) for attempt in squeezer_attempts(steps, ())]
    assert errors[-1] < 1.5e-4
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(2.0, abs=0.05)


@pytest.mark.validation(
    "table",
    "Andrews' squeezer, 0.03 s",
    "W. Schiehlen, Multibody Systems Handbook (1990); F. Mazzia, C. Magherini, Test Set for "
    "Initial Value Problem Solvers: Andrews' squeezing mechanism",
    "published numbers",
)
@pytest.mark.long
def test_the_error_follows_the_tolerance(compare):
    """At 1e-2 its largest step decides, half a degree of the crank's average speed."""
    attempts = squeezer_attempts((), (1e-2, 1e-4, 1e-5, 1e-6))
    errors = [angle_error(attempt) for attempt in attempts]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.1 * errors[0]
    angles = attempts[-1].run().trajectory.position[-1]
    name = "angles, tolerance 1e-6; the crank has turned by 15.8 rad"
    compare(name, END, angles, error=None, abs=3e-5, unit="rad")
    for attempt, error in zip(attempts[1:], errors[1:], strict=True):
        assert error < 30.0 * attempt.value, "rad, of 15.8"


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
