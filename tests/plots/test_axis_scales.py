"""Axes, their ticks and scales, and the points of curves that are drawn."""

from itertools import pairwise

import numpy as np
import pytest
from matplotlib.figure import Figure

from exu_press.plots.decimate import decimate, visible_segments
from exu_press.plots.scales import angle_ticks, crank_angle_axis, impact_scale, log_axis


@pytest.mark.parametrize(
    ("low", "high"), [(0, 720), (0, 18), (0, 0.5), (90, 2250), (-180, 180), (0, 36_000)]
)
def test_angle_ticks_are_few_round_and_inside(low, high):
    ticks = angle_ticks(low, high)
    assert 2 <= len(ticks) <= 10
    assert low - 1e-6 <= ticks[0] < ticks[-1] <= high + 1e-6


@pytest.mark.parametrize("bottom", [104.5, 180.0, 337.6])
def test_dead_centres_are_marked_and_their_labels_touch_no_others(bottom):
    """Six inches: as narrow as the panels beside the animated mechanism."""
    figure = Figure(figsize=(6.0, 2.0))
    axes = figure.subplots()
    crank_angle_axis([axes], 0.0, 400.0, {"TDC": 24.48, "BDC": bottom})
    figure.draw_without_rendering()
    boxes = [label.get_window_extent() for label in axes.get_xticklabels()]
    boxes = sorted((box.x0, box.x1) for box in boxes)
    assert all(end < begin for (_, end), (begin, _) in pairwise(boxes))
    labels = {label.get_text().partition("\n")[2] for label in axes.get_xticklabels()}
    assert {"TDC", "BDC"} <= labels
    (lines,) = axes.collections
    assert sorted(segment[0, 0] for segment in lines.get_segments()) == [24.48, bottom, 384.48]


@pytest.mark.parametrize("signed", [True, False])
def test_an_axis_with_impacts_says_where_it_is_linear(signed):
    axes, angle = Figure().subplots(), np.linspace(0, 720, 10_001)
    values = 8.0 * np.abs(np.sin(np.radians(angle)))
    assert impact_scale(axes, [(angle, values)], signed=signed) == ""
    values[5000] = 900.0
    assert impact_scale(axes, [(angle, values)], signed=signed) == "logarithmic beyond 10"
    low, high = axes.get_ylim()
    assert low == (-high if signed else 0.0)
    assert high > 900.0
    assert {0.0, 10.0, 100.0} <= set(axes.get_yticks())


@pytest.mark.parametrize(("low", "high", "ticks"), [(3.0, 40.0, [5, 10, 20]), (20.0, 80.0, 5)])
def test_a_logarithmic_axis_has_few_ticks_written_out(low, high, ticks):
    axes = Figure().subplots()
    log_axis(axes, "y", np.array([low, np.nan, high]))
    found = [tick for tick in axes.get_yticks() if low <= tick <= high]
    assert found == ticks if isinstance(ticks, list) else len(found) == ticks
    assert all("e" not in axes.yaxis.get_major_formatter()(tick) for tick in found)
    assert axes.get_yscale() == "log"


@pytest.mark.parametrize("spacing", ["even", "uneven"])
def test_decimation_keeps_ends_and_the_extremes_of_every_bin(spacing):
    rng = np.random.default_rng(1)
    x = np.linspace(0.0, 1.0, 50_001)
    if spacing == "uneven":
        x = np.sort(rng.random(x.size) ** 3)
    curves = rng.standard_normal((2, x.size))
    curves[0, 31_415], curves[1, 27_182] = 50.0, -50.0
    bins = 200
    kept = decimate(x, *curves, bins=bins)
    assert kept.size <= bins * (2 + 2 * len(curves))
    assert (kept[0], kept[-1]) == (0, x.size - 1)
    assert np.all(np.diff(kept) > 0)
    width = (x[-1] - x[0]) / bins
    bin_of = np.minimum(((x - x[0]) / width).astype(int), bins - 1)
    for curve in curves:
        for number in np.unique(bin_of):
            inside = curve[bin_of == number]
            shown = curve[kept][bin_of[kept] == number]
            assert (shown.min(), shown.max()) == (inside.min(), inside.max())


def test_a_path_keeps_its_shape_and_its_last_turn():
    angle = np.linspace(0.0, 20 * np.pi, 100_001)
    points = np.column_stack([np.cos(angle), np.sin(angle)])
    segments = visible_segments(points, 0.01)
    assert len(segments) < 3_000
    drawn = points[segments]
    assert np.abs(np.linalg.norm(drawn, axis=2) - 1.0).max() < 1e-12
    assert np.linalg.norm(drawn[:, 1] - drawn[:, 0], axis=1).max() < 0.03
    assert np.all(np.diff(segments[:, 0]) > 0)
    assert segments[-1, 1] > 99_900
    assert np.ptp(drawn[..., 0]) > 1.98
