"""Pictures of a press with twelve clearance joints can be read: few drawn, the rest in a table."""

import pytest
from matplotlib.figure import Figure

from exu_press import Scene, simulate
from exu_press.plots.busiest import busiest
from exu_press.plots.force import force_figure
from exu_press.plots.orbit import orbit_figure
from exu_press.plots.peaks import rest_lines
from exu_press.view import Animation, moment
from exu_press.view.animation import SIZE

JOINTS = {"pivots": "lubricated", "slide_pin": "lubricated", "crank_pin": "lubricated"}
JOINTS |= dict.fromkeys(("knuckles", "plunger_pins", "balls"), "dry")


@pytest.fixture(scope="module")
def twelve():
    result = simulate(Scene(joints=JOINTS, revolutions=0.005))
    assert len(result.clearance_joints) == 12
    return result


def test_the_largest_forces_are_drawn_and_every_other_joint_is_in_the_table(twelve):
    drawn, rest = busiest([twelve], twelve.clearance_joints, "eccentricity", 3)
    peak = {n: twelve.quantity(f"joints.{n}.peak_force").value for n in twelve.clearance_joints}
    assert len(drawn) == 3
    assert min(peak[name] for name in drawn) >= max(peak[name] for name in rest)
    head, *lines = rest_lines(twelve, rest)
    assert head.split()[0] == "also"
    assert len(lines) == len(rest)


def _titles(figure):
    return [axes.get_title("left") for axes in figure.axes]


@pytest.mark.parametrize(
    ("draw", "most"),
    [
        (lambda result: force_figure({"run": result}), 6),
        (orbit_figure, 8),
        (lambda result: Animation(result, moment(result), Figure(figsize=SIZE)).figure, 6),
    ],
    ids=["force", "orbit", "view"],
)
def test_panels_are_few(twelve, draw, most):
    assert len(list(filter(None, _titles(draw(twelve))))) <= most
