"""The picture of a sweep: curves, maps, points, crosses."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.studies.sweep import Sweep
from exu_press.studies.sweep.figure import axes_of, sweep_figure
from exu_press.studies.sweep.report import report_of

SPEEDS = [200.0, 300.0, 400.0]
CLEARANCES = [5e-5 + 1e-5 * n for n in range(8)]


def table(missing=(), errors=None, **way):
    """A table with made-up numbers: force = speed, film = clearance / 2."""
    study = Sweep(scene=Scene(joints={"crank_pin": "lubricated", "balls": "ideal"}), **way)
    rows = [
        {"status": "failed", "reason": "x"}
        if run in missing
        else {
            "status": "completed",
            "reason": "",
            "joints": {
                "crank_pin": {
                    "peak_force": scene.speed_rpm * 1e3,
                    "min_film": scene.joints["crank_pin"].clearance / 2,
                }
            },
        }
        | ({"errors": errors} if errors else {})
        for run, scene in enumerate(study.scenes)
    ]
    return report_of(study, rows, [])


SHOWN = ("joints.crank_pin.peak_force", "joints.crank_pin.min_film")
TWO = ("joints.crank_pin.clearance", "speed_rpm")


def panels(figure):
    return [axes for axes in figure.axes if axes.get_title(loc="left")]


def test_a_grid_of_few_is_curves():
    some = table(keys={"joints.crank_pin.clearance": CLEARANCES, "speed_rpm": SPEEDS})
    force, film = panels(sweep_figure(some, TWO, SHOWN))
    assert force.get_title(loc="left") == "Crank pin: joint force, max, kN"
    assert film.get_title(loc="left") == "Crank pin: film thickness, min, \N{MICRO SIGN}m"
    assert force.get_xlabel() == "crank pin, radial clearance, \N{MICRO SIGN}m"
    assert [line.get_label() for line in force.lines] == ["200 rpm", "300 rpm", "400 rpm"]
    for line, speed in zip(force.lines, SPEEDS, strict=True):
        np.testing.assert_allclose(line.get_xdata(), np.array(CLEARANCES) * 1e6)
        np.testing.assert_allclose(line.get_ydata(), speed)
    assert force.get_legend() is not None and film.get_legend() is None


def test_numbers_have_their_errors():
    """A force of 200 to 400 kN between 150 and 450."""
    told = {"error": 250e3, "determined": True, "low": 150e3, "high": 450e3}
    errors = {"joints.crank_pin.peak_force": told}
    some = table(errors=errors, keys={"speed_rpm": SPEEDS})
    force, film = panels(sweep_figure(some, ["speed_rpm"], SHOWN))
    assert not film.containers
    ends = [bar.vertices[:, 1] for bar in force.containers[0].lines[2][0].get_paths()]
    assert np.allclose(ends, [150.0, 450.0])
    runs = replace(some, selected=SHOWN).tables()[0]
    assert runs.head[1:3] == ("joints.crank_pin.peak_force, kN", "joints.crank_pin.min_film, um")
    assert runs.rows[0][1:3] == ("200 +- 250", "50")


def test_a_grid_of_many_is_a_map():
    some = table(keys={"speed_rpm": SPEEDS, "joints.crank_pin.clearance": CLEARANCES})
    figure = sweep_figure(some, TWO[::-1], SHOWN)
    (mesh,) = panels(figure)[0].collections
    np.testing.assert_allclose(
        mesh.get_array().reshape(8, 3), np.tile([200.0, 300.0, 400.0], (8, 1))
    )
    (mesh,) = panels(figure)[1].collections
    np.testing.assert_allclose(mesh.get_array().reshape(8, 3)[:, 0], np.array(CLEARANCES) / 2 * 1e6)


def test_runs_without_numbers_are_crosses():
    some = table(missing=[1], keys={"speed_rpm": SPEEDS})
    (panel, *_) = panels(sweep_figure(some, ["speed_rpm"], SHOWN))
    assert panel.lines[-1].get_marker() == "x"
    assert panel.lines[-1].get_xdata().tolist() == [300.0]
    assert panel.get_title(loc="right") == "x: 1 without"


def test_what_is_drawn_over_what():
    some = table(
        keys={"mechanism": ["press"], "speed_rpm": SPEEDS, "joints.crank_pin.clearance": CLEARANCES}
    )
    assert axes_of(some) == ("speed_rpm", "joints.crank_pin.clearance")
    assert axes_of(some, ["joints.crank_pin.clearance"]) == ("joints.crank_pin.clearance",)
    with pytest.raises(InputError, match="--over mechanism: allowed are the numbers that vary"):
        axes_of(some, ["mechanism"])
    with pytest.raises(InputError, match="allowed are one or two keys"):
        axes_of(some, ["speed_rpm"] * 3)
