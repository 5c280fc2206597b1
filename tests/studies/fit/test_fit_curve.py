"""What a sensor adds to a curve: zero, clock and band, of sines whose answer is known."""

import dataclasses

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.numerics.piecewise import eno_cubic, evaluate
from exu_press.studies.curve_file import CurveFile, channel_polynomials, factor_to, read_curve
from exu_press.studies.fit.measured import Curve, fit_sensor

AT = np.linspace(0.0, 2.0, 4001)
PLACES = np.linspace(1.0, 1.9, 120)
FREQUENCY = 10.0


def curve(over="time", **keys):
    read = CurveFile(over, PLACES, "slider_velocity", "mm/s", np.zeros(len(PLACES)))
    return Curve(file="c.csv", uncertainty=0.01, measured=read, **keys)


def sine(amplitude=1.0, lag=0.0):
    return amplitude * np.sin(2.0 * np.pi * FREQUENCY * PLACES - lag)


COMPUTED = eno_cubic(AT, np.sin(2.0 * np.pi * FREQUENCY * AT))


def test_a_known_band():
    """At its corner a filter of second order passes 1 / sqrt(2) and turns by 90 degrees."""
    found = fit_sensor(curve(high_cut=[FREQUENCY]), sine(), AT, COMPUTED)
    assert found.values == pytest.approx(sine(np.sqrt(0.5), np.pi / 2.0), abs=0.01)
    found = fit_sensor(curve(low_cut=[FREQUENCY]), sine(), AT, COMPUTED)
    assert found.values == pytest.approx(sine(np.sqrt(0.5), -np.pi / 2.0), abs=0.01)


def test_unknown_zero_clock_and_corner_are_found():
    wanted = 0.3 + fit_sensor(curve(high_cut=[17.0]), sine(), AT, COMPUTED).values
    one = curve(offset=True, high_cut=[5.0, 40.0])
    found = fit_sensor(one, wanted, AT, COMPUTED)
    assert (one.nuisances, found.offset) == (2, pytest.approx(0.3, abs=1e-3))
    assert found.high_cut == pytest.approx(17.0, rel=0.01)
    shifted = curve(shift=[-0.02, 0.02])
    assert (shifted.nuisances, curve(high_cut=[17.0]).nuisances) == (1, 0)
    found = fit_sensor(shifted, sine(lag=-2.0 * np.pi * FREQUENCY * 0.013), AT, COMPUTED)
    assert found.shift == pytest.approx(0.013, abs=1e-5)


def test_the_line_goes_through_the_runs_own_rows_and_the_samples():
    recorded = fit_sensor(curve(offset=True, shift=[0.01, 0.01]), 0.5 + sine(), AT, COMPUTED)
    places, values = recorded.line(PLACES)
    rows = AT[(AT > 1.01) & (AT < 1.91)]
    assert np.abs(rows - 0.01 - places[np.searchsorted(places, rows - 0.01 - 1e-9)]).max() < 1e-8
    assert np.interp(PLACES, places, values) == pytest.approx(recorded.values, abs=1e-8)
    exact = recorded.offset + np.sin(2.0 * np.pi * FREQUENCY * (places + 0.01))
    assert values == pytest.approx(exact, abs=1e-5)


def test_a_curve_that_is_longer_than_the_run_has_no_values():
    assert fit_sensor(curve(), sine(), AT[AT < 1.5], COMPUTED[..., AT[1:] < 1.5]) is None


def test_samples_that_are_not_independent_count_less():
    assert curve().count == 120
    assert curve(correlation=0.1).count == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"shift": [0.1, -0.1]}, r"allowed is \[low, high\]"),
        ({"high_cut": [5.0, 1.0]}, r"allowed is \[frequency\]"),
        ({"low_cut": [500.0], "high_cut": [100.0]}, "nothing is left of the curve"),
        ({"low_cut": [-5.0]}, r"allowed is \[frequency\]"),
        ({"over": "crank_angle", "low_cut": [5.0]}, "has crank_angle; allowed is time"),
    ],
)
def test_bad_input(keys, said):
    with pytest.raises(InputError, match=said):
        curve(**keys)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t" * 140_000 + ",slider_velocity (m/s)\n0,1\n", "allowed are two names"),
        (
            "# samples = " + "9" * 5000 + "\ntime (s),slider_velocity (m/s)\n" + 20 * "{},0\n",
            "states 9",
        ),
    ],
)
def test_files_that_no_sensor_writes(text, said, tmp_path):
    file = tmp_path / "c.csv"
    file.write_text(text.format(*range(20)))
    with pytest.raises(InputError, match=said):
        read_curve(file)


def test_a_curve_over_an_angle_that_falls_back_is_refused():
    """The crank of the run is swung back half-way, as a spring turns a press behind its brake."""
    forth = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.1))
    half = int(np.searchsorted(forth["crank_angle"], 0.5 * forth["crank_angle"][-1]))

    def swing(name, values):
        back = 2.0 * values[half] - values[half:] if name == "crank_angle" else values[half:]
        return np.concatenate([values[:half], back])

    run, most = forth.map_values(swing), np.degrees(forth["crank_angle"][half])
    below = CurveFile("crank_angle", -PLACES, "slider_velocity", "m/s", PLACES)
    assert len(channel_polynomials("a.csv", below, run)[0]) == len(run.time)
    passed = dataclasses.replace(below, at=np.linspace(0.5, 1.0, len(PLACES)) * most)
    with pytest.raises(InputError, match=rf"turns back at {most:.6g} deg, .* allowed is .* time"):
        channel_polynomials("a.csv", passed, run)
    assert channel_polynomials("a.csv", passed, forth)[2] == "m/s"


@pytest.mark.parametrize(
    ("unit", "wanted", "factor"),
    [
        ("kNm", "N m", 1e3),
        ("N m", "N m", 1.0),
        ("mN\N{MIDDLE DOT}m", "N m", 1e-3),
        ("\N{DEGREE SIGN}", "deg", 1.0),
        ("rad", "deg", 180.0 / np.pi),
        ("\N{DEGREE SIGN}/s", "rad/s", np.pi / 180.0),
        ("mm/s\N{SUPERSCRIPT TWO}", "m/s^2", 1e-3),
    ],
)
def test_units_as_instruments_write_them(unit, wanted, factor):
    assert factor_to("a.csv", unit, wanted) == pytest.approx(factor, rel=1e-15)


@pytest.fixture(scope="module")
def fine():
    scene = Scene(mechanism="slider_crank", speed_rpm=600.0, joints={})
    return simulate(scene.replace({"solver.tolerance": 1e-7}))


@pytest.mark.parametrize(
    ("channel", "unit", "off"),
    [
        ("slider_position", "m", 1e-8),
        ("slider_velocity", "m/s", 1e-6),
        ("drive_torque", "N m", 0.1),
    ],
)
def test_values_between_steps_are_those_of_a_finer_record(fine, channel, unit, off):
    """Lines between every fiftieth step are off 2e-5 m, 1e-3 m/s and 1 N m."""
    few = fine.map_values(lambda _, values: values[::50])
    for over in ("time", "crank_angle"):
        file = CurveFile(over, np.array([0.0]), channel, unit, np.array([0.0]))
        places, values, _ = channel_polynomials("a.csv", file, fine)
        at, polynomials, _ = channel_polynomials("a.csv", file, few)
        inside = places[(places > 0.1 * at[-1]) & (places < at[-1])]
        apart = evaluate(at, polynomials, inside) - evaluate(places, values, inside)
        assert np.abs(apart).max() < off
