import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.plots import press_figure

ALWAYS = ["Shaking force", "Power of the drive", "Guides"]


def panels(result):
    return {axes.get_title("left"): axes for axes in press_figure(result).axes}


@pytest.mark.parametrize(
    "label",
    [
        "ideal",
        "stopped at once",
        *(pytest.param(n, marks=pytest.mark.long) for n in ("dry", "lubricated", "stopped")),
    ],
)
def test_less_than_a_stroke_on_ideal_guides(results, label):
    shown = panels(results[label])
    loads = ["Loads"] if results[label].scene.load else []
    assert list(shown) == ALWAYS + loads
    assert all(axes.get_ylabel().endswith(("kN", "kW")) for axes in shown.values())


def test_with_and_without_counterweight(results):
    legend = panels(results["ideal"])["Shaking force"].get_legend()
    names = [text.get_text() for text in legend.get_texts()]
    assert names == ["vertical", "vertical, without counterweight", "horizontal"]


def test_shaking_force_is_drawn_as_its_mean_over_a_millisecond(results):
    """Without impacts that is the force itself, in kN."""
    line = panels(results["ideal"])["Shaking force"].lines[0]
    result = results["ideal"]
    force = np.interp(
        line.get_xdata(), np.degrees(result["crank_angle"]), result["shaking_force"][:, 1]
    )
    middle = slice(20, -20)
    assert line.get_ydata()[middle] == pytest.approx(1e-3 * force[middle], abs=0.1)


def test_elastic_guides_show_tilt_and_the_stroke(results):
    result = results["elastic"]
    shown = panels(result)
    assert list(shown) == [
        *ALWAYS,
        "Bottom dead centre",
        "Slider tilt",
        "Slider sideways",
        "Loads",
    ]
    assert "µrad" in shown["Slider tilt"].get_ylabel()
    tilts = [stroke["tilt"] for stroke in result.summary()["strokes"]]
    (dot,) = (line for line in shown["Slider tilt"].lines if line.get_marker() == "o")
    assert dot.get_ydata() == pytest.approx(1e6 * np.array(tilts))
    assert f"mm: {1e3 * result.quantity('strokes.mean').value:.6g}" in shown[
        "Bottom dead centre"
    ].get_title("right")


def test_a_motors_speed_and_loads_have_panels_and_a_rocker_no_dead_centre():
    load = {"die": {"kind": "table", "time": [0.0, 0.1], "force": [0.0, 2e3]}}
    result = simulate(
        Scene(
            mechanism="four_bar",
            joints={},
            drive={"rated_torque": 400.0, "inertia": 50.0},
            load=load,
            revolutions=1.1,
        )
    )
    shown = panels(result)
    assert list(shown) == [*ALWAYS, "Crank speed", "Loads"]
    assert shown["Crank speed"].get_ylabel() == "rpm"
    assert np.ptp(shown["Crank speed"].lines[0].get_ydata()) > 0.0
    labels = [text.get_text() for text in shown["Loads"].get_xticklabels()]
    assert labels and not any("DC" in label for label in labels)
    assert shown["Loads"].get_xlabel() == "crank angle, deg"
