"""From when on two runs of a scene have nothing in common."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of
from exu_press.verification.divergence import DIVERGED, divergence
from exu_press.verification.estimate import single_difference_factor

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


def horizon(result, others):
    return divergence(result, others).growth.horizon


def test_a_body_that_is_elsewhere_between_its_ways_has_parted(run):
    across = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].normal)))
    assert horizon(run, {2.0: moved(run, across, 0.9 * DIVERGED * PLAY / 2**0.5)}) is None
    found = horizon(run, {2.0: moved(run, across, DIVERGED * PLAY)})
    assert 0.9 * run.time[-1] < found <= run.time[-1]


def test_one_that_tilts_has_too(run):
    tilt = DIVERGED * PLAY / 0.1  # about half the length, its ends are so far away
    assert horizon(run, {2.0: moved(run, 2, 0.9 * tilt / 2**0.5)}) is None
    assert horizon(run, {2.0: moved(run, 2, tilt)}) is not None


def test_one_that_is_ahead_has_not(run):
    along = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].direction)))
    assert horizon(run, {2.0: moved(run, along, PLAY)}) is None


@pytest.mark.parametrize(("ratio", "parted"), [(0.5, True), (0.25, False), (8.0, False)])
def test_a_run_at_half_the_tolerance_is_half_way_to_the_truth(run, ratio, parted):
    across = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].normal)))
    found = horizon(run, {ratio: moved(run, across, 0.5 * DIVERGED * PLAY)})
    assert (found is not None) is parted


def test_a_run_at_half_the_tolerance_vouches_for_less_where_a_coarser_one_has_diverged(run):
    """One difference is small by chance more often than two."""
    across = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].normal)))
    near = moved(run, across, 1.1 * DIVERGED * PLAY / single_difference_factor(0.5))
    beside, away = (moved(run, across, part * DIVERGED * PLAY) for part in (0.6, 1.5))
    found = divergence(run, {0.5: near, 8.0: beside})
    assert found.growth.horizon is None
    assert found.nearest == 0.0
    found = divergence(run, {0.5: near, 8.0: away})
    assert 0.9 * run.time[-1] < found.growth.horizon <= run.time[-1]
    assert found.nearest == single_difference_factor(0.5)
    assert found.distances[8.0] > found.distances[0.5] > 0.0


def test_a_run_that_was_beside_by_chance_vouches_for_less_still(run):
    """When the coarser one diverged, its distance told an error twelve times the other's."""
    across = int(np.argmax(np.abs(mechanism_of(LOOSE).guides[0].normal)))
    near, away = (moved(run, across, part * PLAY) for part in (0.035, 10.0 * DIVERGED))
    found = divergence(run, {0.5: near, 8.0: away})
    part = 0.035 / (10.0 * DIVERGED)  # of the coarser one's distance, at all times
    assert found.nearest == pytest.approx(1.0 / (7.0 * part), rel=0.1)
    assert found.growth.horizon is not None
