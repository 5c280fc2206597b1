"""A slider-crank whose stroke and dead centre follow from its lengths in closed form."""

import numpy as np
import pytest

from exu_press import InputError, Scene
from exu_press.studies.sensitivity import Sensitivity, sensitivity

RADIUS, ROD = "slider_crank.crank_radius", "slider_crank.rod_length"
SCENE = Scene(mechanism="slider_crank", joints={"crank_pin": "ideal"}, settle=0.0, revolutions=1.0)
KEYS = {
    RADIUS: {"mean": 0.03, "deviation": 2e-5},
    ROD: {"mean": 0.383, "deviation": 5e-5},
    "slider_crank.slider_mass": {"low": 1300.0, "high": 1400.0},
}


def study(**changes):
    asked = {"quantities": ["stroke", "peak_velocity"], "samples": 16} | changes
    return Sensitivity(scene=SCENE, keys=KEYS, sensitivity=asked)


@pytest.mark.long
def test_the_stroke_is_twice_the_crank(tmp_path):
    report = sensitivity(study(), tmp_path, workers=1)
    spread, found = report.spreads[0], report.indices[0]
    assert spread.middle == pytest.approx(0.06, rel=1e-4)
    assert spread.deviation == pytest.approx(4e-5, rel=0.3)  # of 32 values
    assert found.total[0] == pytest.approx(1.0, abs=0.35)
    assert found.total[1:] == pytest.approx([0.0, 0.0], abs=1e-3)
    ends = 0.06 + 2.0 * 2e-5 * 1.6448536 * np.array([-1.0, 1.0])
    assert report.bars[0, :, 0] == pytest.approx(ends, abs=2e-7)
    text = "\n".join(report.lines())
    assert "+-" in text
    assert "rod_length    0.00 (" in text.replace("slider_crank.", "")
    assert (tmp_path / "sensitivity.json").exists()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"samples": 100}, "allowed is a power of two"),
        ({"quantities": []}, "allowed is a list of names"),
        ({"quantities": ["strok"]}, "did you mean 'stroke'"),
        ({"sample": 8}, "did you mean 'samples'"),
    ],
)
def test_bad_input(changes, said):
    with pytest.raises(InputError, match=said):
        study(**changes)


def test_values_have_no_distribution():
    with pytest.raises(InputError, match=r"keys\.speed_rpm = \[100\.0\]: allowed in a file for"):
        Sensitivity(
            scene=SCENE, keys={"speed_rpm": [100.0]}, sensitivity={"quantities": ["stroke"]}
        )
