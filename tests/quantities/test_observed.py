"""Further observations: means over windows and samples at rates that a scene asks for."""

import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.quantities import quantities_of
from exu_press.quantities.acceleration import differentiated_peak, mean_peak
from exu_press.quantities.catalogue import find_quantity

READINGS = {"average": [5e-4, 2e-3], "average_deg": [1.0], "sampled": [5000.0]}


@pytest.fixture(scope="module")
def result():
    scene = Scene(
        mechanism="slider_crank",
        speed_rpm=300.0,
        revolutions=0.1,
        joints={"crank_pin": {"kind": "dry", "clearance": 1e-4}},
        output={"readings": READINGS},
        solver={"tolerance": 1e-2},
    )
    return simulate(scene, errors=True)


def test_names_follow_and_values_are_those_of_the_window(result, tmp_path):
    time, position, velocity = (
        result[name] for name in ("time", "slider_position", "slider_velocity")
    )
    of_means = {"mean_500us": 5e-4, "mean_2ms": 2e-3, "mean_1deg": 1.0 / 1800.0}
    for name, window in of_means.items():
        value = result.quantity(f"peak_acceleration.{name}")
        assert value.value == mean_peak(time, velocity, window) and value.error is not None
    sampled = result.quantity("peak_acceleration.differentiated_5khz").value
    assert sampled == differentiated_peak(time, position, velocity, 5e3)
    entries = result.summary()["quantities"]
    assert {"drive.peak_torque_mean_500us", "shaking.vertical_mean_1deg"} < entries.keys()
    result.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc")
    assert again.summary()["quantities"] == entries


def test_the_name_alone_tells_unit_and_meaning():
    found = find_quantity("peak_acceleration.mean_500us").quantity
    assert found.unit == "m/s^2" and "averaged over 500 us" in found.meaning
    assert find_quantity("peak_acceleration.differentiated_5khz").quantity.title.endswith("5 kHz")
    for name in ("peak_acceleration.mean_5lbs", "stroke.mean_5us", "peak_acceleration.mean_us"):
        assert find_quantity(name) is None
    plain = quantities_of(Scene(mechanism="slider_crank"))
    assert "peak_acceleration.mean_500us" not in plain


@pytest.mark.parametrize(
    ("readings", "words"),
    [
        ({"average": [1e-3]}, "1ms is read already"),
        ({"sampled": [5e3, 5000.0]}, "5khz is read already"),
        ({"average": [0.0]}, "average has 0.0 s; allowed are whole multiples of 1e-09 s"),
        ({"average_deg": [1e-5]}, "multiples of 0.001 deg"),
        ({"averages": [1.0]}, "averages"),
    ],
)
def test_readings_that_are_none_are_refused_by_name(readings, words):
    with pytest.raises(InputError, match=words):
        Scene(mechanism="slider_crank", output={"readings": readings})
