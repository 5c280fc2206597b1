"""Pictures of runs: panels with units, and values that are those of the run."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.plots import energy_figure, orbit_figure, press_figure, slider_figure
from exu_press.plots.slider import sliding_mean

PATHS = [
    *("Crank pin", "Crank pin: eccentricity"),
    *("Ball, each side", "Ball, each side: height in its socket"),
]
GUIDES = ["Shaking force", "Power of the drive", "Guides"]


def titled(figure):
    return {axes.get_title("left"): axes for axes in figure.axes if axes.get_title("left")}


@pytest.mark.parametrize(
    ("draw", "label", "titles", "unit"),
    [
        (energy_figure, "dry", ["Balance", "Dissipated in", "Residual"], "J"),
        (energy_figure, "ideal", ["Balance", "Residual"], "J"),
        (press_figure, "ideal", GUIDES, ("kN", "kW")),
        (press_figure, "stopped at once", GUIDES, ("kN", "kW")),
        (orbit_figure, "dry", PATHS, (", µm", "eccentricity ratio")),
    ],
)
def test_panels_and_their_units(results, draw, label, titles, unit):
    panels = titled(draw(results[label]))
    assert list(panels) == titles
    assert all(axes.get_ylabel().endswith(unit) for axes in panels.values())


def test_motion_of_the_slider_of_a_run_that_stopped_early(results):
    figure = slider_figure({"": results["stopped"]})
    units = [axes.get_ylabel().partition(", ")[2] for axes in figure.axes]
    assert units == ["mm", "µm", "m/s", "mm/s", "m/s²", "m/s²"]
    assert figure.axes[-1].get_xlabel().endswith("deg")
    assert "stopped early" in figure.get_suptitle()
    deviation = np.abs(figure.axes[1].lines[0].get_ydata()).max()
    assert 50.0 <= deviation < 300.0, "um, of twice 100 um and penetration"


def test_averaging_keeps_the_change_of_velocity():
    time = np.linspace(0.0, 0.01, 1001)
    mean = sliding_mean(time, np.where(time > 0.005, 0.04, 0.0))
    assert mean.max() == pytest.approx(40.0, rel=1e-9)  # 0.04 m/s in 1 ms
    assert np.count_nonzero(mean > 1.0) == pytest.approx(101, abs=2)
    assert np.all(np.isfinite(sliding_mean(np.zeros(1), np.zeros(1))))


def test_a_circle_is_round_a_large_path_is_whole_and_a_small_one_magnified_beside(results):
    path = titled(orbit_figure(results["dry"]))["Crank pin"]
    reach = 1e6 * np.linalg.norm(results["dry"]["crank_pin_eccentricity"], axis=1).max()
    assert path.get_aspect() == 1.0
    assert path.get_xlim()[1] > reach > 100.0
    assert not path.child_axes
    path = titled(orbit_figure(results["lubricated"]))["Crank pin"]
    assert path.get_xlim()[1] < 50.0  # um, of 100
    (inset,) = path.child_axes
    assert inset.get_xlim()[1] > 100.0


def test_elastic_guides_show_tilt_and_the_stroke(results):
    result = results["elastic"]
    panels = titled(press_figure(result))
    others = ["Bottom dead centre", "Slider tilt", "Slider sideways", "Loads"]
    assert list(panels) == [*GUIDES, *others]
    assert "µrad" in panels["Slider tilt"].get_ylabel()
    tilts = [stroke["tilt"] for stroke in result.summary()["strokes"]]
    (dot,) = (line for line in panels["Slider tilt"].lines if line.get_marker() == "o")
    assert dot.get_ydata() == pytest.approx(1e6 * np.array(tilts))
    mean = f"mm: {1e3 * result.quantity('strokes.mean').value:.6g}"
    assert mean in panels["Bottom dead centre"].get_title("right")


def test_a_motors_speed_and_loads_have_panels_and_a_rocker_no_dead_centre():
    drive = {"rated_torque": 400.0, "inertia": 50.0}
    load = {"die": {"kind": "table", "time": [0.0, 0.1], "force": [0.0, 2e3]}}
    keys = {"joints": {}, "drive": drive, "load": load, "revolutions": 1.1}
    panels = titled(press_figure(simulate(Scene(mechanism="four_bar", **keys))))
    assert list(panels) == [*GUIDES, "Crank speed", "Loads"]
    assert panels["Crank speed"].get_ylabel() == "rpm"
    assert np.ptp(panels["Crank speed"].lines[0].get_ydata()) > 0.0
    labels = [text.get_text() for text in panels["Loads"].get_xticklabels()]
    assert labels and not any("DC" in label for label in labels)
