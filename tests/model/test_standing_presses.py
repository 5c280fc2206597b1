"""Presses at rest: what starts, what stands and stays, what stalls and why."""

import math
import re

import numpy as np
import pytest
from schedules import SCHEDULE, scheduled

from exu_press import InputError, Scene, simulate
from exu_press.studies.attractor.orbit import Orbit

DRIVE = {**SCHEDULE, "driven_inertia": 2.0}


def press(revolutions=0.4, **changes):
    return scheduled(revolutions, **{**DRIVE, **changes})


@pytest.mark.parametrize("angle", [60.0, pytest.param(200.0, marks=pytest.mark.long)])
def test_a_press_that_its_brake_holds_stays(angle):
    """Against its weight, for as long as it stands, and to the last digits."""
    scene = press(start_time=[9.0], stop_time=None, clutch_off=None, brake_on=None)
    result = simulate(scene.replace({"start_angle_deg": angle}))
    assert result.completed
    assert np.ptp(result["crank_angle"]) < 1e-7
    assert np.abs(result["crank_speed"][result.time > 0.2]).max() < 1e-9
    held = np.abs(result["brake_torque"][result.time > 0.2])
    assert held.min() > 100.0 and np.ptp(held) < 1e-3 * held.min()
    assert result.quantity("drive.starting_time").value is None
    assert any("drive.start_time = 9 s: the run" in text for text in result.summary()["warnings"])


def test_a_brake_too_weak_to_stop_is_told():
    result = simulate(press(brake_torque=20.0))
    assert result.completed and result.quantity("drive.stopping_time").value is None
    said = " ".join(result.summary()["warnings"])
    assert "drive.brake_torque = 20 N m does not hold the press at every angle" in said
    assert "the press does not stand behind its last stop: the crank turns at" in said


def test_a_cam_stops_at_its_angle_and_the_run_ends_when_the_press_stands():
    cam = press(2.0, stop_time=None, stop_angle_deg=60.0, ends_after=0.03)
    result = simulate(cam)
    assert result.completed and result.time[-1] < 0.5
    assert not any("the run ends" in text for text in result.summary()["warnings"])
    early = simulate(cam.replace({"revolutions": 0.02})).summary()["warnings"]
    assert any("drive.stop_angle_deg = 60 deg: the run ends at 0.02 s" in text for text in early)
    stops = result.quantity("drive.stopping_time").value
    begun = float(np.interp(math.radians(60.0), result["crank_angle"], result.time))
    assert result.time[-1] == pytest.approx(begun + stops + 0.03, abs=0.02)  # shafts untwist
    turned = result.quantity("drive.stopping_angle_deg").value
    assert np.degrees(result["crank_angle"].max()) == pytest.approx(60.0 + turned, abs=0.01)
    over_angle = {
        "clutch_off": None,
        "brake_on": None,
        "clutch_off_deg": [0.0, 2.0],
        "brake_on_deg": [3.0, 6.0],
    }
    result = simulate(
        press(2.0, stop_time=None, stop_angle_deg=60.0, ends_after=0.03, **over_angle)
    )
    braked = np.flatnonzero(result["brake_torque"] > 1.0)
    braked = braked[result.time[braked] > 0.1]
    assert np.degrees(result["crank_angle"][braked[0]]) == pytest.approx(63.0, abs=0.5)
    assert result.quantity("energy.residual").value < 1e-3


def test_a_run_goes_on_behind_its_stop():
    whole = simulate(press(0.4))
    first = simulate(press(0.22))
    second = simulate(press(0.18), start=first.info["state"])
    assert second.time[0] == pytest.approx(0.22)
    assert second["crank_angle"][-1] == pytest.approx(whole["crank_angle"][-1], abs=1e-4)


def test_a_clutch_that_slips_for_good_is_a_stall_of_the_clutch():
    load = {"hold": {"kind": "table", "height": [0.0, 0.07], "force": [3e5, 3e5]}}
    result = simulate(press(1.0, stop_time=[0.9]).replace({"load": load}))
    assert result.info["status"] == "stalled"
    told = re.search(
        r"want (\S+) N m there, and the clutch, which slips, has 3000 N m", result.info["reason"]
    )
    assert float(told[1]) > 3000.0 and "drive.clutch_torque" in result.info["reason"]


def test_what_does_not_go_with_a_schedule():
    with pytest.raises(InputError, match="starts or stops: an orbit is one of a press that runs"):
        Orbit(press())
    with pytest.raises(InputError, match=r"drive\.driven_inertia = 0\.0: allowed is a number > 0"):
        Scene(
            joints={},
            bodies={"crank": {"flexible": "crank"}},
            drive={**DRIVE, "driven_inertia": 0.0},
        )


def test_fixed_steps_stop_as_those_of_a_tolerance_do():
    scene = press(0.35)
    found = [
        simulate(scene.replace({"solver": solver})).quantity("drive.stopping_time").value
        for solver in ({"step": 2e-4}, {"tolerance": 1e-3})
    ]
    assert found[0] == pytest.approx(found[1], rel=2e-3)
