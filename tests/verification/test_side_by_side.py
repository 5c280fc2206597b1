"""Runs of several scenes beside each other."""

import pytest

from exu_press import InputError, Scene
from exu_press.verification.run import simulate_with_errors
from exu_press.verification.side_by_side import simulate_side_by_side

SCENES = {
    kind: Scene(mechanism="slider_crank", joints={"crank_pin": kind}, revolutions=0.01)
    for kind in ("dry", "lubricated")
}


def test_results_are_those_of_one_run_after_the_other():
    """In all digits, with their errors."""
    results = dict(simulate_side_by_side(SCENES))
    assert results.keys() == SCENES.keys()
    for label, scene in SCENES.items():
        alone = simulate_with_errors(scene, beside=False)
        assert results[label].info["errors"] == alone.info["errors"] != {}
        assert (results[label]["slider_velocity"] == alone["slider_velocity"]).all()


def test_a_scene_that_cannot_be_run_is_refused():
    off = SCENES["dry"].replace({"output.channels": ["no_such_channel"]})
    with pytest.raises(InputError, match="no_such_channel"):
        dict(simulate_side_by_side({"a": off}, errors=False))
