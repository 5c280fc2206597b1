"""Figures that change from revolution to revolution, and a film that takes many to settle."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.verification.reading import read_a_revolution_earlier, with_next_temperatures

OIL = {"viscosity_cst": (68.0, 8.7), "density": 870.0, "supply_celsius": 40.0, "conductance": 5.0}
FILM = {"oil": OIL, "at_contact": "mixed", "roughness": 4e-7}
PRESS = Scene(
    mechanism="eccentric_press",
    speed_rpm=120.0,
    joints={"wrist_pin": "lubricated"},
    film=FILM,
    revolutions=4.0,
    solver={"tolerance": 1e-2},
)
SLIDER_CRANK = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": "lubricated"},
    film={"oil": OIL},
    revolutions=2.0,
    solver={"tolerance": 1e-2},
)

AT_REST = 51.367
"""deg C, after 19 revolutions at a tolerance of 1e-3 with both pins lubricated."""


@pytest.fixture(scope="module")
def warm():
    return simulate(SLIDER_CRANK, errors=True, beside=False)


def test_a_run_goes_on_until_its_oil_has_settled(warm):
    assert warm.info["added_revolutions"] == 2
    assert (warm.scene.revolutions, warm.scene.settle_revolutions) == (4.0, 3.0)
    assert warm.quantity("joints.crank_pin.film.temperature").determined
    assert any(text.startswith("2 revolutions more") for text in warm.summary()["warnings"])


@pytest.mark.long
def test_a_pin_that_sinks_for_nine_revolutions_is_read_when_it_has_settled():
    """Its oil is at 40.07 deg C in the fourth one, and at 63.97 in the seventh."""
    run = simulate(PRESS, errors=True, beside=False)
    assert np.interp(3.5 * 0.5, run.time, run["wrist_pin_temperature"]) < 40.1
    assert run.info["added_revolutions"] == 8
    temperature = run.quantity("joints.wrist_pin.film.temperature")
    assert temperature.determined
    assert abs(temperature.value - AT_REST) < temperature.error < 0.2


def test_the_drift_of_the_last_revolution_is_part_of_every_error(warm):
    before = read_a_revolution_earlier(warm)
    assert before.scene.settle_revolutions == warm.scene.settle_revolutions - 1.0
    for name in ("film.viscosity", "mean_power", "film.side_flow"):
        full = f"joints.crank_pin.{name}"
        moved = abs(before.quantity(full).value - warm.quantity(full).value)
        assert moved > 0.0
        assert warm.quantity(full).error >= moved


def test_what_heat_asks_for_is_part_of_the_temperatures_error(warm):
    state = warm.info["state"]
    films = {"crank_pin": (warm["crank_pin_temperature"][-1] + 3.0, 1e6)}
    asked = replace(warm, info={**warm.info, "state": {**state, "films": films}})
    found = with_next_temperatures(asked)
    changed = found["crank_pin_temperature"] - warm["crank_pin_temperature"]
    assert changed == pytest.approx(3.0)
    oil = warm.scene.joints["crank_pin"].film.oil
    assert found["crank_pin_viscosity"][-1] == pytest.approx(
        oil.viscosity(films["crank_pin"][0], 1e6)
    )
