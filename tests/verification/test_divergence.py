"""From when on two runs of a scene have nothing in common."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of
from exu_press.verification.divergence import APART, divergence

PLAY = 1e-4
LOOSE = Scene(
    mechanism="slider_crank", joints={}, revolutions=0.2, guide={"clearance": PLAY, "length": 0.2}
)


@pytest.fixture(scope="module")
def run():
    return simulate(LOOSE)


def moved(result, column, amount):
    """Return a run whose slider moves away, from next to nothing on to `amount` at its end."""
    values = result["body_position"].copy()
    values[:, result.bodies.index("slider"), column] += amount * np.geomspace(
        1e-6, 1.0, len(values)
    )
    return result.with_values({"body_position": values})


def test_a_body_that_is_elsewhere_between_its_ways_has_parted(run):
    across = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].across)))
    assert divergence(run, moved(run, across, 0.9 * APART * PLAY / 2**0.5), 2.0).horizon is None
    found = divergence(run, moved(run, across, APART * PLAY), 2.0)
    assert 0.9 * run.time[-1] < found.horizon <= run.time[-1]


def test_one_that_tilts_has_too(run):
    tilt = APART * PLAY / 0.1  # about half the length, its ends are so far away
    assert divergence(run, moved(run, 2, 0.9 * tilt / 2**0.5), 2.0).horizon is None
    assert divergence(run, moved(run, 2, tilt), 2.0).horizon is not None


def test_one_that_is_ahead_has_not(run):
    along = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].direction)))
    assert divergence(run, moved(run, along, PLAY), 2.0).horizon is None


@pytest.mark.parametrize(("ratio", "horizon"), [(0.5, True), (0.25, False), (8.0, False)])
def test_a_run_at_half_the_tolerance_is_half_way_to_the_truth(run, ratio, horizon):
    across = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].across)))
    found = divergence(run, moved(run, across, 0.5 * APART * PLAY), ratio)
    assert (found.horizon is not None) is horizon
