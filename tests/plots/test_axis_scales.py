from itertools import pairwise

import numpy as np
import pytest
from matplotlib.figure import Figure

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
