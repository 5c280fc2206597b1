"""Pictures of the study: what stands in them."""

import dataclasses
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from exu_press import simulate
from paper.clearance import Point, choose
from paper.plots.motion import motion_figure
from paper.plots.numbers import numbers_figure
from paper.plots.paths import paths_figure
from paper.plots.revolution import last_revolution, mean_acceleration
from paper.plots.save import save_paper
from paper.plots.side_by_side import side_by_side_figure
from paper.plots.sweeps import curves_figure, peaks_figure
from paper.plots.tornado import tornado_figure
from paper.plots.tradeoff import tradeoff_figure
from paper.published import published
from paper.readings import readings
from paper.report import Findings, Report
from paper.rows import number_rows
from paper.runs import paper_runs
from paper.sensitivity import tornado_of
from paper.settings import Setting
from paper.side_by_side import peaks_of

SWEEP = ("clearance 0.05 mm", "clearance 0.1 mm", "clearance 0.15 mm", "clearance 0.2 mm")
NUMBER = next(n for n in published().numbers if n.name == "acceleration_200um")


@pytest.fixture(scope="module")
def runs():
    scenes = paper_runs(rigid_only=True, revolutions=0.02)
    return {name: simulate(scene.replace("solver.step", 5e-5)) for name, scene in scenes.items()}


@pytest.fixture(scope="module")
def rows(runs):
    return {
        name: {"status": "completed", "reason": "", "readings": readings(run)}
        for name, run in runs.items()
    }


def with_acceleration(row, value):
    peaks = dict.fromkeys(("resolved", "mean_1ms", "differentiated_1khz"), value)
    return {**row, "readings": {**row["readings"], "peak_acceleration": peaks}}


@pytest.fixture(scope="module")
def tornado(rows):
    row = rows["clearance 0.2 mm"]
    varied = [
        (Setting("ball", "half"), with_acceleration(row, 50.0)),
        (Setting("ball", "twice"), with_acceleration(row, 90.0)),
        (Setting("oil", "thin"), with_acceleration(row, 71.0)),
    ]
    return tornado_of(NUMBER, "rigid", with_acceleration(row, 70.0), varied)


def test_only_the_last_revolution_is_drawn(runs):
    run = runs["clearance 0.1 mm"]
    assert last_revolution(run).time[0] == 0.0  # a short run is drawn whole
    long = dataclasses.replace(run, channels=dict(run.channels))
    time, angle = np.linspace(0.0, 0.5, 1001), np.linspace(0.0, 4.0 * np.pi, 1001)
    for name, channel in run.channels.items():
        values = np.zeros((1001, *channel.values.shape[1:]))
        values = {"time": time, "crank_angle": angle}.get(name, values)
        long.channels[name] = dataclasses.replace(channel, values=values)
    last = last_revolution(long)
    assert last.time[[0, -1]] == pytest.approx([0.25, 0.5])
    assert last["crank_angle"][[0, -1]] == pytest.approx([0.0, 2.0 * np.pi])


def test_the_curve_has_the_peak_of_the_table(runs, rows):
    curve = mean_acceleration(runs["clearance 0.1 mm"])
    peak = rows["clearance 0.1 mm"]["readings"]["peak_acceleration"]["mean_1ms"]
    assert np.nanmax(np.abs(curve)) == pytest.approx(peak)


@pytest.mark.parametrize("kind", ["displacement", "velocity", "acceleration"])
def test_motion(runs, kind):
    loads = {
        load: {
            joints: runs[f"{load}, {joints}, rigid"] for joints in ("ideal", "dry", "lubricated")
        }
        for load in ("no load", "10 kN")
    }
    figure = motion_figure("Fig. 14", kind, loads)
    assert [axes.get_title("left") for axes in figure.axes[:2]] == ["a  no load", "b  10 kN"]
    assert len(figure.axes[0].lines) >= 3
    assert all(axes.get_ylabel() for axes in (figure.axes[0], figure.axes[2]))


def test_paths_show_their_shares(runs, rows):
    labels = {"no load, dry": "no load, dry, rigid"}
    paths = {label: runs[name] for label, name in labels.items()}
    known = {label: rows[name] for label, name in labels.items()}
    figure = paths_figure("Fig. 18", "ball_left", paths, known)
    bar = figure.axes[1]
    assert sum(patch.get_width() for patch in bar.patches) == pytest.approx(1.0)


def test_sweeps_show_the_papers_numbers(runs, rows):
    sweep = {name: runs[name] for name in SWEEP}
    figure = peaks_figure("Fig. 21", sweep, rows, "rises")
    assert len(figure.axes) == 5
    paper = next(line for line in figure.axes[4].lines if line.get_label() == "paper")
    assert list(paper.get_ydata()) == [70.2, 105.0] and list(paper.get_xdata()) == [0, 3]
    figure = curves_figure("Fig. 19", "displacement", sweep, rows, "rises, then falls")
    assert "rises, then falls" in figure.axes[2].get_xlabel()


def test_a_tornado_has_its_bars_and_the_papers_band(tornado):
    (axes,) = tornado_figure("What moves it", [tornado]).axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["ball", "oil"]
    assert "ours 70, paper 105" in axes.get_xlabel()
    low, high = axes.get_xlim()
    assert low < 50.0 and high > 105.0


def test_numbers_of_all_rows(rows, tornado):
    table = number_rows([NUMBER], rows, {NUMBER.name: tornado})
    figure = numbers_figure(table)
    (label,) = figure.axes[0].get_yticklabels()
    assert "0.2 mm" in label.get_text()


def points():
    models = ("resolved", "mean_1ms", "differentiated_1khz")
    for pin in (5e-5, 1e-4, 2e-4):
        for balls in (5e-5, 1e-4, 2e-4):
            losses = {"balls": balls * 1e5, "pin": 0.05 / pin}
            peaks = dict.fromkeys(models, 1e4 * balls**0.5)
            yield Point(pin, balls, peaks, 1e5, 0.1, balls, 1e-7, losses)


def test_the_trade_off(runs):
    separate = list(points())
    alike = [point for point in separate if point.pin == point.balls]
    choice = choose(runs["clearance 0.1 mm"].scene, alike, separate)
    titles = [axes.get_title("left") for axes in tradeoff_figure(choice).axes]
    assert "Trade-off" in titles and "Bottom dead centre" in titles


def test_a_report_becomes_files(runs, rows, tornado, tmp_path):
    """Of runs that are missing nothing is drawn."""
    from paper.tasks import run_file

    for name in SWEEP:
        path = run_file(tmp_path, name)
        path.parent.mkdir(exist_ok=True)
        runs[name].save(path)
    alike = [point for point in points() if point.pin == point.balls]
    found = Findings(
        damping="2.5545e8",
        bodies="rigid",
        rows=tuple(number_rows([NUMBER], rows, {NUMBER.name: tornado})),
        runs={name: rows[name] for name in SWEEP},
        tornados=(tornado,),
        choice=choose(runs["clearance 0.1 mm"].scene, alike, list(points())),
        peaks=(peaks_of("rigid", published().beside("rigid").numbers, rows, rows),),
        settings={},
        files={name: run_file(tmp_path, name) for name in SWEEP},
    )
    report = Report(True, {"2.5545e8": found, "0.01": replace(found, damping="0.01", runs={})}, ())
    names = {str(path.relative_to(tmp_path)) for path in save_paper(report, tmp_path)}
    summary = {"numbers.png", "tornado_acceleration.png", "clearance.png"}
    sweeps = {"fig19_displacement.png", "fig20_velocity.png", "fig21_acceleration.png"}
    assert names == {
        "side_by_side.png", *summary, *sweeps, *(f"c_max_0.01/{name}" for name in summary)
    }  # fmt: skip
    assert all((tmp_path / name).stat().st_size > 10_000 for name in names)


def test_both_readings_side_by_side(rows):
    """A point for each peak and reading; a run that stopped has none."""
    numbers = published().beside("rigid").numbers
    peaks = peaks_of("rigid", numbers, rows, rows)
    stopped = peaks_of("rigid", numbers, {**rows, "500 rpm": {"readings": None}}, rows)
    axes = side_by_side_axes(peaks, stopped)
    assert len(axes) == 3
    first, second = (line.get_xdata() for line in axes[1].lines[:2])
    assert np.isfinite(first).all() and np.count_nonzero(np.isnan(second)) == 1
    values = peaks.values["mean_1ms"]
    assert first[0] == pytest.approx(values[0] / 29.4)


def side_by_side_axes(*peaks):
    kinds = [SimpleNamespace(damping=str(i), peaks=(one,)) for i, one in enumerate(peaks)]
    return side_by_side_figure(kinds).axes
