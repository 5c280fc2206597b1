import numpy as np
import pytest

from exu_press.plots import slider_figure
from exu_press.plots.slider import sliding_mean

LABELS = ["ideal", "dry", "lubricated", "slider_crank", "stopped"]


@pytest.mark.parametrize(
    "label",
    [
        pytest.param(
            n, marks=[pytest.mark.long] * (n not in ("lubricated", "slider_crank", "stopped"))
        )
        for n in LABELS
    ],
)
def test_six_panels_with_units(results, label):
    figure = slider_figure({label: results[label]})
    units = [axes.get_ylabel().partition(", ")[2] for axes in figure.axes]
    assert units == ["mm", "µm", "m/s", "mm/s", "m/s²", "m/s²"]
    assert figure.axes[-1].get_xlabel().endswith("deg")
    words = figure.get_suptitle()
    assert "rpm" in words
    assert ("stopped early" in words) == label.startswith("stopped")


def test_the_deviation_is_what_the_clearance_allows(results):
    figure = slider_figure({"dry": results["dry"]})
    deviation = figure.axes[1].lines[0].get_ydata()
    assert 50.0 < np.abs(deviation).max() < 300.0  # um, of twice 100 um and penetration


def test_ideal_joints_do_not_deviate(results):
    figure = slider_figure({"ideal": results["ideal"]})
    assert np.abs(figure.axes[1].lines[0].get_ydata()).max() < 1e-3  # um
    assert figure.axes[1].get_ylim() == (-1.0, 1.0)


def test_averaging_keeps_the_change_of_velocity():
    time = np.linspace(0.0, 0.01, 1001)
    mean = sliding_mean(time, np.where(time > 0.005, 0.04, 0.0))
    assert mean.max() == pytest.approx(40.0, rel=1e-9)  # 0.04 m/s in 1 ms
    assert np.count_nonzero(mean > 1.0) == pytest.approx(101, abs=2)
    assert np.all(np.isfinite(sliding_mean(np.zeros(1), np.zeros(1))))


def test_a_crank_that_falls_back_is_in_the_picture(results):
    run = results["stopped"]
    figure = slider_figure({"": run.with_values({"crank_angle": 1.0 - run["crank_angle"]})})
    for axes in figure.axes:
        (low, high), drawn = axes.get_xlim(), axes.lines[0].get_xdata()
        assert low <= drawn.min() < drawn.max() <= high
