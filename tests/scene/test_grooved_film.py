"""[[film.grooves]] of a scene: read, written, refused by name, and run."""

import math

import numpy as np
import pytest

from exu_press import Scene, bearing_coefficients, simulate
from exu_press.numerics.piecewise import integral
from exu_press.scene.warnings import scene_warnings

AXIAL = [{"angle_deg": 90.0, "width_deg": 10.0}, {"angle_deg": -90.0, "width_deg": 10.0}]
RING = [{"width_deg": 360.0, "length": 0.005}]


def scene(grooves, **keys):
    film = {"law": "grooved", "length": 0.05, "viscosity": 0.05, "grooves": grooves}
    crank_pin = {"kind": "lubricated", "clearance": 1e-4, "radius": 0.05}
    return Scene(mechanism="slider_crank", joints={"crank_pin": crank_pin}, film=film, **keys)


def inclined(**keys):
    film = {"law": "grooved", "length": 0.05, "viscosity": 0.5, "tilt": 1e-3, **keys}
    crank_pin = {"kind": "lubricated", "clearance": 1e-4, "radius": 0.05}
    return Scene(mechanism="slider_crank", joints={"crank_pin": crank_pin}, film=film)


def test_an_inclined_journal_runs_and_is_thinnest_at_its_end():
    """The balance of energy closes, with the couple of the inclination in it."""
    result = simulate(inclined().replace({"revolutions": 0.02}))
    assert result.summary()["status"] == "completed"
    assert result.quantity("energy.residual").value < 1e-4
    eccentricity = result["crank_pin_eccentricity"]
    film = result.joints["crank_pin"].gap
    end = np.hypot(eccentricity[:, 0], eccentricity[:, 1]) + 0.25e-4  # at most, beside the other
    assert (film >= 1e-4 - end - 1e-12).all()
    assert (film < 1e-4 - np.hypot(eccentricity[:, 0], eccentricity[:, 1])).all()
    assert result.quantity("joints.crank_pin.min_film").value == film.min()
    assert not any("at an end" in text for text in result.summary()["warnings"])


def test_an_inclined_journal_near_an_end_has_a_warning():
    """Though its middle is far from the wall."""
    result = simulate(inclined(tilt=3.85e-3).replace({"revolutions": 0.002}))
    (warning,) = (text for text in result.summary()["warnings"] if "at an end" in text)
    assert "crank pin: eccentricity ratio up to 0.9" in warning
    assert result.joints["crank_pin"].distance.max() < 0.5e-4


def test_coefficients_of_an_inclined_journal():
    """A turned drawing, and the opposite end, have the same bearing; a small tilt changes nothing.

    The grid does not turn with the drawing.
    """
    load = (0.0, -2e4)
    straight, across = (
        bearing_coefficients(inclined(tilt=tilt), "crank_pin", load=load, speed_rpm=300.0)
        for tilt in (1e-6, 1e-3)
    )
    opposite = bearing_coefficients(
        inclined(tilt_direction_deg=180.0), "crank_pin", load=load, speed_rpm=300.0
    )
    turned = bearing_coefficients(
        inclined(tilt_direction_deg=90.0), "crank_pin", load=(2e4, 0.0), speed_rpm=300.0
    )
    assert straight.min_film == pytest.approx(1e-4 * (1.0 - straight.eccentricity_ratio), rel=1e-2)
    assert across.min_film < 0.95 * straight.min_film
    x, y = across.eccentricity
    for other, expected, size in ((opposite, (x, y), 1e-6), (turned, (-y, x), 5e-3)):
        assert other.min_film == pytest.approx(across.min_film, rel=size)
        assert other.eccentricity == pytest.approx(expected, abs=size * math.hypot(x, y))
    assert across.power > 0.0 and across.side_flow > 0.0


def test_a_pressure_far_above_that_of_the_rotation_has_a_warning():
    """Of a groove around, whose pressure bears next to nothing; not of another one."""
    slow = {"speed_rpm": 0.1}
    (warning,) = scene_warnings(scene([{**RING[0], "pressure": 1e6}], **slow))
    assert "film.grooves.pressure = 1e+06 Pa is 6.4e+02 times" in warning
    assert scene_warnings(scene([{**RING[0], "pressure": 1e6}])) == []
    pocket = {**AXIAL[0], "length": 0.04, "pressure": 1e6}
    assert scene_warnings(scene([pocket], **slow)) == []


@pytest.mark.long
@pytest.mark.parametrize("pressure", [{}, {"pressure": 2e6}])
def test_a_run_keeps_its_energy_and_the_film_its_heat(pressure):
    """A groove around, that a pump feeds or not: the oil's heat and the pump's work are in it."""
    given = scene([{**RING[0], **pressure}], revolutions=1.0)
    result = simulate(given)
    assert result.summary()["status"] == "completed"
    assert result.quantity("energy.residual").value < 1e-4
    assert result["crank_pin_power"].min() > 0.0
    oil = {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0}
    warm = given.replace({"film.oil": oil})
    bearing = bearing_coefficients(warm, "crank_pin", load=(0.0, -5e3), speed_rpm=300.0)
    carried = 1.8e6 * bearing.side_flow * (bearing.temperature - 40.0)
    assert bearing.power + bearing.pump_power == pytest.approx(carried, rel=1e-5)
    if pressure:
        pumped = integral(result.time, result["crank_pin_pump_power"])[-1]
        assert pumped > 0.5 * result["energy_input"][-1]
        assert bearing.pump_power == pytest.approx(2e6 * bearing.side_flow, rel=0.01)
    else:
        assert bearing.pump_power == 0.0
        assert simulate(warm).summary()["status"] == "completed"
