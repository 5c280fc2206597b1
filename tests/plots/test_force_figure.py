import pytest

from exu_press.plots import force_figure

LABELS = ["ideal", "dry", "lubricated", "slider_crank", "stopped"]
PRESS = ["Crank pin", "Ball, each side", "Pivot, each side", "Drive torque"]
SLIDER_CRANK = ["Crank pin", "Wrist pin", "Guide", "Drive torque"]


@pytest.mark.parametrize(
    "label",
    [
        pytest.param(n, marks=[pytest.mark.long] * (n not in ("lubricated", "slider_crank")))
        for n in LABELS
    ],
)
def test_joints_and_drive_with_units(results, label):
    figure = force_figure({label: results[label]})
    titles = [axes.get_title("left") for axes in figure.axes]
    assert titles == (SLIDER_CRANK if label == "slider_crank" else PRESS)
    assert [axes.get_ylabel() for axes in figure.axes] == ["force, kN"] * 3 + ["torque, N m"]
    assert not figure.legends


def test_runs_have_a_legend(results):
    figure = force_figure({name: results[name] for name in ("ideal", "dry", "lubricated")})
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["ideal", "dry", "lubricated"]


def test_sides_that_differ_are_both_shown(results):
    result = results["dry"]
    uneven = result.with_values({"ball_left_force": 1.5 * result["ball_left_force"]})
    titles = [axes.get_title("left") for axes in force_figure({"run": uneven}).axes]
    assert "Ball, left" in titles
    assert "Ball, right" in titles
