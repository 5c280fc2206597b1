import numpy as np
import pytest
from matplotlib.text import Text

from exu_press import Scene, simulate
from exu_press.errors import InputError
from exu_press.plots import orbit_figure


def titled(figure):
    return {axes.get_title("left"): axes for axes in figure.axes if axes.get_title("left")}


@pytest.mark.parametrize(
    "label", ["dry", *(pytest.param(n, marks=pytest.mark.long) for n in ("lubricated", "stopped"))]
)
def test_pin_and_ball_in_their_circles_with_units(results, label):
    panels = titled(orbit_figure(results[label]))
    assert list(panels) == [
        "Crank pin",
        "Crank pin: eccentricity",
        "Ball, each side",
        "Ball, each side: height in its socket",
    ]
    assert all(axes.get_ylabel().endswith(", µm") for axes in panels.values())


def test_a_small_path_is_magnified_beside_the_whole_circle(results):
    path = titled(orbit_figure(results["lubricated"]))["Crank pin"]
    assert path.get_xlim()[1] < 50.0  # um, of 100
    (inset,) = path.child_axes
    assert inset.get_xlim()[1] > 100.0


def test_a_circle_is_round_and_a_large_path_is_whole(results):
    path = titled(orbit_figure(results["dry"]))["Crank pin"]
    reach = 1e6 * np.linalg.norm(results["dry"]["crank_pin_eccentricity"], axis=1).max()
    assert path.get_aspect() == 1.0
    assert path.get_xlim()[1] > reach > 100.0
    assert not path.child_axes


def test_balls_that_move_sideways_are_both_shown(results):
    moved = {
        name: results["dry"][name] + [shift, 0.0, 0.0]
        for name, shift in (("ball_left_eccentricity", 1e-5), ("ball_right_eccentricity", 2e-5))
    }
    figure = orbit_figure(results["dry"].with_values(moved))
    assert {"Ball, left", "Ball, right"} <= set(titled(figure))


def test_ideal_joints_have_no_paths(results):
    with pytest.raises(InputError, match="no joint with clearance"):
        orbit_figure(results["ideal"])


def test_names_stand_clear_of_their_legends():
    """Of many joints, the rest of which stand in a table below."""
    pins = ["counter_pin", "counterweight_pin", "slide_pin", "shaft", "crank_pin"]
    scene = Scene(joints=dict.fromkeys(pins, "dry"), revolutions=0.02, solver={"step": 1e-4})
    figure = orbit_figure(simulate(scene))
    figure.draw_without_rendering()
    seen = 0
    for axes in figure.axes:
        if (legend := axes.get_legend()) is not None:
            (title,) = (t for t in axes.findobj(Text) if t.get_text() == axes.get_title("left"))
            assert title.get_window_extent().x1 < legend.get_window_extent().x0
            seen += 1
    assert seen > 4
