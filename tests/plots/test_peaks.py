"""Peaks stand in pictures with their errors; of twelve clearance joints few are drawn."""

import dataclasses

import pytest
from matplotlib.figure import Figure

from exu_press import Scene, simulate
from exu_press.plots import force_figure, orbit_figure, slider_figure
from exu_press.plots.busiest import busiest
from exu_press.plots.format import PictureFormat, drawn_as
from exu_press.plots.peaks import rest_lines
from exu_press.plots.press import press_figure
from exu_press.plots.scales import BAR
from exu_press.quantities.uncertain import significant
from exu_press.view import Animation, moment
from exu_press.view.animation import SIZE


@pytest.fixture(scope="module")
def told(results):
    """A run whose every peak is off by a tenth."""
    run = results["dry"]
    peaks = ("resolved", "mean_1ms")
    names = [f"peak_acceleration.{peak}" for peak in peaks]
    names += ["drive.peak_torque", "joints.crank_pin.peak_force"]
    values = {name: run.quantity(name).value for name in names}
    errors = {
        name: {"error": 0.1 * v, "determined": True, "low": 0.9 * v, "high": 1.1 * v}
        for name, v in values.items()
    }
    return dataclasses.replace(run, info={**run.info, "errors": errors})


def notes(figure):
    return [axes.get_title(loc="right") for axes in figure.axes]


def bars(figure):
    return [line for axes in figure.axes for line in axes.lines if line.get_label() == BAR]


def test_peaks_have_error_bars_and_say_how_large(told, results):
    for draw in (slider_figure, force_figure):
        figure = draw({"": told})
        assert len(bars(figure)) == 2
        assert sum("±" in note for note in notes(figure)) == 2
    assert any("±" in note for note in notes(press_figure(told)))


def test_bars_have_their_bounds_at_the_peak_s_side_and_lie_inside_the_axes(results):
    """Also of a negative peak, whose bounds are of its magnitude."""
    run = results["dry"]
    flipped = run.with_values({"slider_acceleration": -run["slider_acceleration"]})
    name, ends = "peak_acceleration.resolved", []
    for signed in (run, flipped):
        size = abs(signed["slider_acceleration"]).max()
        error = {"error": 0.6 * size, "determined": True, "low": 0.7 * size, "high": 1.6 * size}
        info = {**run.info, "errors": {name: error}}
        drawn = slider_figure({"": dataclasses.replace(signed, info=info)})
        (bar,) = bars(drawn)
        ends.append(sorted(bar.get_ydata() / size))
        low, high = bar.axes.get_ylim()
        assert low <= bar.get_ydata().min() and bar.get_ydata().max() <= high
    assert ends[0] == pytest.approx([-end for end in ends[1][::-1]])
    assert {round(abs(end), 6) for end in ends[0]} == {0.7, 1.6}


def test_a_table_and_a_note_tell_the_summary_s_figures_not_those_of_the_start():
    scene = {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}, "start": "centred"}
    run = simulate(Scene.from_dict({**scene, "revolutions": 0.3, "settle": 0.25}))
    force, torque = (run.quantity(n) for n in ("joints.crank_pin.peak_force", "drive.peak_torque"))
    assert abs(run["drive_torque"]).max() > 1.1 * torque.value
    (line,) = rest_lines(run, {"crank_pin": "Crank pin"})[1:]
    assert line.split()[-1] == significant(1e-3 * force.value, 4)
    assert any(significant(1e-3 * torque.value, 4) in note for note in notes(press_figure(run)))


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


@pytest.mark.parametrize("width", ["84mm", "174mm", None])
def test_the_table_of_the_rest_is_in_the_picture(twelve, width):
    with drawn_as(PictureFormat.from_texts("png", width, None, "default")):
        figure = orbit_figure(twelve)
    figure.draw_without_rendering()
    table = figure.axes[8].texts[0].get_window_extent()
    assert table.x0 >= 0.0 and table.y0 >= 0.0
    assert table.x1 <= figure.bbox.x1


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
