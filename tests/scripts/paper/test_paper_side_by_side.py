"""How far peaks lie from the paper's, and what a change makes of that."""

import math

import pytest

from exu_press import Scene
from paper.damping import DAMPINGS, directory_of, with_damping
from paper.published import published
from paper.settings import Setting
from paper.side_by_side import computed_peaks, distance, distances_by_setting, peaks_of

NUMBERS = computed_peaks(published().numbers)


def row(peak):
    """A run whose peak is the same under every model, and twice as large from the start on."""
    readings = [
        {"peak_acceleration": dict.fromkeys(("resolved", "mean_1ms", "differentiated_1khz"), value)}
        for value in (peak, 2.0 * peak)
    ]
    return {"status": "completed", "readings": readings[0], "whole": readings[1]}


def test_nine_peaks_are_computed_and_one_is_measured():
    assert len(NUMBERS) == 9
    assert 17.8 not in [number.published for number in NUMBERS]


def test_distance():
    assert distance([2.0, 0.5, 2.0], [1.0, 1.0, 1.0]) == pytest.approx(math.log(2.0))
    assert distance([3.0, 5.0], [3.0, 5.0]) == 0.0
    assert distance([3.0, None], [3.0, 5.0]) is None


def test_peaks_that_are_twice_the_papers_from_the_start_on():
    rows = {n.run: row(n.published) for n in NUMBERS}
    peaks = peaks_of("rigid", NUMBERS, rows, rows)
    assert set(peaks.distances(peaks.values).values()) == {0.0}
    whole = peaks.distances(peaks.whole)
    assert all(value == pytest.approx(math.log(2.0)) for value in whole.values())
    assert peaks.sampling() == 1.0


def test_a_setting_that_touches_one_peak_leaves_the_others():
    baselines = {number.run: row(number.published) for number in NUMBERS}
    oil, span = Setting("oil", "thin"), Setting("span", "all", whole_run=True)
    varied = {number.run: [(span, row(number.published))] for number in NUMBERS}
    varied[NUMBERS[0].run].append((oil, row(3.0 * NUMBERS[0].published)))
    found = distances_by_setting(NUMBERS, baselines, varied)
    assert found["oil = thin"] == pytest.approx(math.log(3.0) / 3.0)  # one of nine
    assert found["span = all"] == pytest.approx(math.log(2.0))
    assert found["as they are"] == 0.0


def test_the_default_scene_is_the_dimensional_reading(tmp_path):
    scene = Scene()
    assert with_damping(scene, "2.5545e8") == scene
    assert with_damping(scene, "0.01").contact.damping_max == 0.01
    ideal = Scene(joints={})
    assert all(with_damping(ideal, damping) == ideal for damping in DAMPINGS)
    assert directory_of(tmp_path, "2.5545e8") == tmp_path
