import numpy as np
import pytest

from exu_press.plots.decimate import decimate, visible_segments


@pytest.mark.parametrize("spacing", ["even", "uneven"])
def test_decimation_keeps_ends_and_the_extremes_of_every_bin(spacing):
    rng = np.random.default_rng(1)
    x = np.linspace(0.0, 1.0, 50_001)
    if spacing == "uneven":
        x = np.sort(rng.random(x.size) ** 3)
    curves = rng.standard_normal((2, x.size))
    curves[0, 31_415], curves[1, 27_182] = 50.0, -50.0
    bins = 200
    kept = decimate(x, *curves, bins=bins)
    assert kept.size <= bins * (2 + 2 * len(curves))
    assert (kept[0], kept[-1]) == (0, x.size - 1)
    assert np.all(np.diff(kept) > 0)
    width = (x[-1] - x[0]) / bins
    bin_of = np.minimum(((x - x[0]) / width).astype(int), bins - 1)
    for curve in curves:
        for number in np.unique(bin_of):
            inside = curve[bin_of == number]
            shown = curve[kept][bin_of[kept] == number]
            assert (shown.min(), shown.max()) == (inside.min(), inside.max())


def test_a_way_there_and_back_keeps_the_extremes_of_both():
    x = np.abs(np.linspace(-1.0, 1.0, 50_001))[::-1] - 0.5
    curve = np.zeros(x.size)
    curve[12_345], curve[42_000] = 7.0, -7.0
    kept = decimate(x, curve, bins=100)
    assert {0, 12_345, 42_000, x.size - 1} <= set(kept) and kept.size <= 400


def test_a_path_keeps_its_shape_and_its_last_turn():
    angle = np.linspace(0.0, 20 * np.pi, 100_001)
    points = np.column_stack([np.cos(angle), np.sin(angle)])
    segments = visible_segments(points, 0.01)
    assert len(segments) < 3_000
    drawn = points[segments]
    assert np.abs(np.linalg.norm(drawn, axis=2) - 1.0).max() < 1e-12
    assert np.linalg.norm(drawn[:, 1] - drawn[:, 0], axis=1).max() < 0.03
    assert np.all(np.diff(segments[:, 0]) > 0)
    assert segments[-1, 1] > 99_900
    assert np.ptp(drawn[..., 0]) > 1.98
