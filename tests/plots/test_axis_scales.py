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


CENTRES = {"TDC": 0.0, "BDC": 180.0}


@pytest.mark.parametrize("width", [6.0, 8.0])
@pytest.mark.parametrize("bottom", [104.5, 158.0, 203.85, 337.6])
def test_labels_of_dead_centres_touch_no_others(width, bottom):
    """Six inches: as narrow as the panels beside the animated mechanism."""
    figure = Figure(figsize=(width, 2.0))
    axes = figure.subplots()
    crank_angle_axis([axes], 0.0, 360.0, {"TDC": 24.48, "BDC": bottom})
    figure.draw_without_rendering()
    boxes = [label.get_window_extent() for label in axes.get_xticklabels()]
    boxes = sorted((box.x0, box.x1) for box in boxes)
    assert all(end < begin for (_, end), (begin, _) in pairwise(boxes))


def test_dead_centres_are_marked_and_named():
    figure = Figure()
    axes = figure.subplots()
    crank_angle_axis([axes], 0.0, 400.0, CENTRES)
    figure.draw_without_rendering()
    labels = [label.get_text() for label in axes.get_xticklabels()]
    assert "0\nTDC" in labels
    assert "180\nBDC" in labels
    (lines,) = axes.collections
    assert sorted(segment[0, 0] for segment in lines.get_segments()) == [0.0, 180.0, 360.0]


def test_an_axis_without_impacts_stays_linear():
    axes, angle = Figure().subplots(), np.linspace(0, 720, 1000)
    assert impact_scale(axes, [(angle, np.sin(angle))], signed=True) == ""
    assert axes.get_yscale() == "linear"


@pytest.mark.parametrize("signed", [True, False])
def test_an_axis_with_impacts_says_where_it_is_linear(signed):
    axes, angle = Figure().subplots(), np.linspace(0, 720, 10_001)
    values = 8.0 * np.abs(np.sin(np.radians(angle)))
    values[5000] = 900.0
    assert impact_scale(axes, [(angle, values)], signed=signed) == "logarithmic beyond 10"
    low, high = axes.get_ylim()
    assert low == (-high if signed else 0.0)
    assert high > 900.0
    assert {0.0, 10.0, 100.0} <= set(axes.get_yticks())


def test_ticks_of_a_signed_axis_with_impacts_keep_apart():
    axes, angle = Figure().subplots(), np.linspace(0, 720, 10_001)
    values = 16.0 * np.sin(np.radians(angle))
    values[5000] = 195.0
    impact_scale(axes, [(angle, values)], signed=True)
    assert [tick for tick in axes.get_yticks() if tick > 20.0] == [200.0]


@pytest.mark.parametrize(("low", "high", "ticks"), [(3.0, 40.0, [5, 10, 20]), (20.0, 80.0, 5)])
def test_a_logarithmic_axis_has_few_ticks_written_out(low, high, ticks):
    axes = Figure().subplots()
    log_axis(axes, "y", np.array([low, np.nan, high]))
    found = [tick for tick in axes.get_yticks() if low <= tick <= high]
    assert found == ticks if isinstance(ticks, list) else len(found) == ticks
    assert all("e" not in axes.yaxis.get_major_formatter()(tick) for tick in found)
    assert axes.get_yscale() == "log"
