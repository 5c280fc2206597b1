"""Spectra of curves whose amplitudes are known, at uneven places."""

import numpy as np
import pytest

from exu_press import InputError
from exu_press.signals.spectrum import amplitude_spectrum, cell_means, spectrogram


def uneven(span, number, seed=1):
    """Return places of steps whose sizes differ by a factor of ten."""
    sizes = np.random.default_rng(seed).uniform(0.1, 1.0, number - 1)
    return np.concatenate([[0.0], np.cumsum(sizes) / sizes.sum() * span])


@pytest.mark.parametrize("window", ["flattop", "hann", "boxcar"])
def test_a_sine_on_a_bin_has_its_amplitude(window):
    x = uneven(1.0, 4000)
    found = amplitude_spectrum(x, 5.0 + 3.0 * np.sin(2.0 * np.pi * 40.0 * x), window=window)
    place = int(np.argmax(found.amplitude))
    assert found.frequency[place] == pytest.approx(40.0)
    assert found.amplitude[place] == pytest.approx(3.0, rel=2e-3)
    assert abs(found.amplitude[place] - 3.0) < max(found.error, 1e-3)
    assert found.error < 0.02


@pytest.mark.parametrize(("window", "least"), [("flattop", 2.99), ("hann", 2.52), ("boxcar", 1.9)])
def test_a_sine_between_two_bins(window, least):
    x = uneven(1.0, 4000)
    found = amplitude_spectrum(x, 3.0 * np.sin(2.0 * np.pi * 40.5 * x + 0.3), window=window)
    assert least < found.amplitude.max() < 3.01
    assert abs(found.frequency[np.argmax(found.amplitude)] - 40.5) < 0.51


def test_a_fast_sine_is_not_damped_by_its_cells():
    x = np.linspace(0.0, 1.0, 20001)
    found = amplitude_spectrum(x, np.sin(2.0 * np.pi * 200.0 * x), cells=500)
    assert found.amplitude.max() == pytest.approx(1.0, rel=2e-3)


def test_a_train_of_impacts_has_a_line_at_each_multiple():
    # area a each, f times a second: the Fourier series has 2 a f at each multiple of f
    f, area, width = 20.0, 0.01, 1e-5
    centres = (np.arange(20) + 0.3712) / f
    x = np.unique(np.concatenate([uneven(1.0, 700), *(centres + k * width for k in (-1, 0, 1))]))
    values = np.interp(
        x,
        np.sort(np.concatenate([centres - width, centres, centres + width, [0.0, 1.0]])),
        np.concatenate([[0.0], np.tile([0.0, area / width, 0.0], 20), [0.0]]),
    )
    found = amplitude_spectrum(x, values, window="boxcar", cells=2000)
    for multiple in range(1, 10):
        line = found.amplitude[np.argmin(np.abs(found.frequency - multiple * f))]
        assert line == pytest.approx(2.0 * area * f, rel=0.02)
    between = found.amplitude[np.round(found.frequency) % 20 != 0]
    assert between.max() < 1e-6


def test_the_error_covers_an_alias():
    x = np.linspace(0.0, 1.0, 100001)
    fast = np.sin(2.0 * np.pi * 130.0 * x)
    found = amplitude_spectrum(x, fast, cells=200)  # up to 100 Hz: 130 appears at 70
    assert found.error > 0.5 * found.amplitude.max() > 0.1


def test_a_spectrogram_tells_when():
    x = uneven(2.0, 8000)
    late = np.where(x > 1.0, np.sin(2.0 * np.pi * 100.0 * x), 0.0)
    found = spectrogram(x, late, 0.2)
    line = found.amplitude[np.argmin(np.abs(found.frequency - 100.0))]
    assert line[found.x < 0.85].max() < 0.01
    assert line[found.x > 1.15].min() == pytest.approx(1.0, rel=0.02)


def test_bad_input():
    x = np.linspace(0.0, 1.0, 100)
    with pytest.raises(InputError, match="window = 'round': allowed are flattop, hann, boxcar"):
        amplitude_spectrum(x, x, window="round")
    with pytest.raises(InputError, match="a spectrum of 5 values: allowed are 16 or more"):
        amplitude_spectrum(x[:5], x[:5])
    with pytest.raises(InputError, match="cells from 0 to 2: allowed are 0 to 1"):
        cell_means(x, x, np.array([0.0, 2.0]))
    with pytest.raises(InputError, match="a spectrogram with windows of 200 of 100 values"):
        spectrogram(x, x, 2.0)
