"""Sobol indices: a function whose indices are known, and points that fail."""

import numpy as np
import pytest
from scipy.stats import sobol_indices

from exu_press import InputError, Scene
from exu_press.studies.sensitivity import Sensitivity, sensitivity
from exu_press.studies.sensitivity.indices import indices, sample

A, B = 7.0, 0.1


def ishigami(shares):
    x = (2.0 * shares - 1.0) * np.pi
    value = np.sin(x[:, 0]) + A * np.sin(x[:, 1]) ** 2 + B * x[:, 2] ** 4 * np.sin(x[:, 0])
    return np.column_stack([value, np.full(len(x), 3.0)])


def known():
    """Ishigami and Homma, 1990: first and total indices in closed form."""
    of_first = (1.0 + B * np.pi**4 / 5.0) ** 2 / 2.0
    of_second = A**2 / 8.0
    of_both = B**2 * np.pi**8 * 8.0 / 225.0
    variance = of_first + of_second + of_both
    return (
        np.array([of_first, of_second, 0.0]) / variance,
        np.array([of_first + of_both, of_second, of_both]) / variance,
    )


def test_ishigami_s_function():
    """And SciPy's indices of the same sample, with bounds as wide."""
    drawn = sample(ishigami, 3, 1024, 1)
    found, constant = indices(drawn)
    parts = {"f_A": drawn.a[:1], "f_B": drawn.b[:1], "f_AB": drawn.ab[:, :1]}
    theirs = sobol_indices(func=parts, n=1024)
    assert found.first == pytest.approx(theirs.first_order, rel=1e-12)
    assert found.total == pytest.approx(theirs.total_order, rel=1e-12)
    widths = theirs.bootstrap().total_order.confidence_interval
    assert np.ptp(found.total_bounds) == pytest.approx(np.ptp(widths), rel=0.1)
    first, total = known()
    assert found.first == pytest.approx(first, abs=0.03)
    assert found.total == pytest.approx(total, abs=0.03)
    inside = (found.total_bounds[:, 0] <= total) & (total <= found.total_bounds[:, 1])
    assert inside.all()
    assert constant is None


def test_a_sample_with_a_failed_run_is_drawn_anew():
    def failing(shares):
        values = ishigami(shares)
        values[shares[:, 2] > 0.97] = np.nan
        return values

    found = sample(failing, 3, 64, 1)
    assert found.drawn > 64
    assert found.a.shape == (2, 64)
    assert np.isfinite(found.values).all()
    assert found.shares[..., 2].max() <= 0.97


def test_too_many_failures_give_no_sample():
    assert sample(lambda shares: np.full((len(shares), 1), np.nan), 2, 8, 0) is None


def test_one_key_alone_explains_everything():
    def straight(shares):
        return np.column_stack([shares[:, 0], np.zeros(len(shares))])

    found, constant = indices(sample(straight, 1, 8, 0))
    assert found.first == found.total == [1.0]
    assert found.first_bounds.tolist() == found.total_bounds.tolist() == [[1.0, 1.0]]
    assert constant is None


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
