"""Pictures of fits, sensitivity studies and optima: what their axes show."""

import numpy as np
import pytest

from exu_press import Scene
from exu_press.plots.format import PictureFormat, drawn_as
from exu_press.studies.fit import Fit, fit
from exu_press.studies.fit.figure import fit_figure, profiles_figure
from exu_press.studies.optimise import Optimise, optimise
from exu_press.studies.optimise.figure import front_figure
from exu_press.studies.sensitivity import Sensitivity, sensitivity
from exu_press.studies.sensitivity.figure import sensitivity_figure

SCENE = Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, revolutions=0.02, settle=0.0)
MASS, ROD = "slider_crank.slider_mass", "slider_crank.rod_length"
KEYS = {MASS: {"low": 800.0, "high": 2000.0, "log": True}, ROD: {"low": 0.3, "high": 0.5}}
FORCES = ("joints.wrist_pin.peak_force", "joints.shaft.peak_force")


def titled(figure):
    return {axes.get_title(loc="left"): axes for axes in figure.axes}


@pytest.mark.long
def test_a_fit(tmp_path):
    measured = [{"quantity": n, "value": 2e4, "uncertainty": 300.0} for n in FORCES]
    given = {"keys": {MASS: KEYS[MASS]}, "measured": measured, "fit": {"starts": 1}}
    report = fit(Fit(scene=SCENE, **given), tmp_path, workers=1)
    panel = titled(fit_figure(report))["Numbers"]
    assert [label.get_text() for label in panel.get_yticklabels()] == list(FORCES)
    drawn = panel.containers[0].lines[0].get_xdata()
    assert drawn == pytest.approx([(x - 2e4) / 300.0 for x in report.numbers])
    with drawn_as(PictureFormat(width=3.3)):
        narrow = fit_figure(report)
    assert narrow.axes[0].get_position().height * narrow.get_figheight() > 0.3
    (panel,) = profiles_figure(report).axes
    curve, points = panel.lines[:2]
    assert curve.get_ydata().min() == pytest.approx(0.0, abs=0.05)
    assert points.get_ydata() == pytest.approx(report.profiles[MASS][:, 1])


@pytest.mark.long
def test_a_sensitivity_study(tmp_path):
    given = {"keys": KEYS, "sensitivity": {"quantities": list(FORCES), "samples": 8}}
    report = sensitivity(Sensitivity(scene=SCENE, **given), tmp_path, workers=1)
    axes = sensitivity_figure(report).axes
    assert len(axes) == 6
    assert sum(bar.get_height() for bar in axes[0].patches) == 16
    widths = [bar.get_width() for bar in axes[1].patches]
    order = np.argsort(report.indices[0].total)
    change = 1e-3 * (report.bars[order, :, 0] - report.middle[0])
    assert widths == pytest.approx(np.concatenate([change[:, 0], change[:, 1]]))
    assert [line.get_label() for line in axes[2].lines] == ["alone", "with others"]
    left, right = axes[2].get_xlim()
    found = report.indices[0]
    ends = np.concatenate([found.first_bounds, found.total_bounds])
    assert left < min(0.0, ends.min()) and max(1.0, ends.max()) < right


@pytest.mark.long
def test_an_optimum(tmp_path):
    given = {"keys": KEYS, "objective": [{"quantity": n} for n in FORCES]}
    report = optimise(Optimise(scene=SCENE, optimise={"trials": 8}, **given), tmp_path, workers=1)
    figure = front_figure(report)
    assert len(figure.axes) == 3
    assert figure.axes[0].get_xlabel() == "wrist pin: joint force, max, kN"
    lines = {line.get_label(): line for line in figure.axes[0].lines}
    assert len(lines["tried"].get_xdata()) == 8
    place = report.places[report.chosen]
    shown = float(lines["chosen"].get_xdata()[0])
    assert shown == pytest.approx(1e-3 * report.trials.numbers[place, 0])
    assert figure.axes[1].get_xscale() == "log"
