"""The long run's picture shows each revolution's point, its figures and its spectra."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.studies.attractor import Attractor, Exponent, period_of
from exu_press.studies.attractor.figure import attractor_figure
from exu_press.studies.attractor.report import AttractorReport

SCENE = Scene(mechanism="slider_crank", joints={}, revolutions=1.0)


@pytest.fixture(scope="module")
def run():
    return simulate(SCENE)


def motion(run, points):
    scatter = np.array([1.0, np.nan, 3.0, 2.0, 2.0, 1.0])
    return Attractor(
        scene=SCENE, skip=2, points=points, error=1e-3, period=period_of(points, 1e-3, 2),
        exponent=Exponent(-1.0, -1.5, -0.5, (1e-2,), 6),
        figures={"stroke": np.full(6, 0.06), "peak_velocity": scatter},
        step_errors={"stroke": 1e-9, "peak_velocity": 1e-3},
        units={"stroke": "m", "peak_velocity": "m/s^2"}, turns=4.0, last=[run],
        transient=np.array([0.1, 0.01]), state={},
    )  # fmt: skip


def test_what_each_panel_shows(run):
    points = np.tile([[0.1, 0.2, 0.3, 0.4], [0.5, 0.6, 0.7, 0.8]], (3, 1))
    section, speeds, portrait, transient, spectrum, orders, values, by_revolution = (
        attractor_figure(AttractorReport(motion(run, points))).axes
    )
    assert section.collections[0].get_offsets().tolist() == points[:, :2].tolist()
    assert speeds.collections[0].get_offsets().tolist() == points[:, [0, 2]].tolist()
    assert portrait.lines[0].get_xdata() == pytest.approx(run["slider_acceleration"])
    assert transient.lines[0].get_ydata().tolist() == [0.1, 0.01]
    assert np.ptp(portrait.get_xlim()) > 1.05 * np.ptp(run["slider_acceleration"])
    assert spectrum.get_yscale() == "log"
    assert spectrum.get_legend().get_window_extent().y0 >= spectrum.bbox.y1
    assert orders.get_xlim()[0] < 1.0
    assert sum(bar.get_height() for bar in values.patches) == 5  # revolutions that have the figure
    assert by_revolution.lines[0].get_xdata().tolist() == [3, 4, 5, 6, 7, 8]
    assert by_revolution.get_ylabel() == "peak velocity, m/s²"


def test_ideal_joints_and_a_motor_have_the_cranks_speed_alone(run):
    points = np.array([[0.95], [0.96]] * 3)
    first, second, *_ = attractor_figure(AttractorReport(motion(run, points))).axes
    assert first.lines[0].get_ydata().tolist() == points[:, 0].tolist()
    assert not second.axison
