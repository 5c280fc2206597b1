"""[drive] with clutch, brake and schedule: what is refused, and what a scene keeps."""

import pytest
from schedules import SCHEDULE, scheduled

from exu_press import InputError, Scene

DRIVE = {**SCHEDULE, "brake_off": [0.0, 0.03], "start_time": [0.05], "stop_time": [0.6]}


def scene(**changes):
    return scheduled(2.0, **{**DRIVE, **changes})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"clutch_on": [0.02, 0.06]}, r"clutch_on = \[0\.02, 0\.06\] overlaps drive\.brake_off"),
        ({"brake_on": [0.01, 0.05]}, r"brake_on = .* overlaps drive\.clutch_off .*at once"),
        ({"stop_time": [0.6, 0.7]}, r"stop_time = 0\.7 after 0\.6: allowed is a start in between"),
        ({"start_time": [0.05, 0.62], "stop_time": [0.6]}, r"start_time = 0\.62 overlaps"),
        ({"start_time": None, "clutch_on": None, "brake_off": None}, "needs drive.start_time"),
        ({"clutch_on": None}, r"needs drive\.clutch_on \(.* which decides the result"),
        ({"clutch_on": None, "clutch_off": None}, r"clutch_on \(.*, drive\.clutch_off \(.* decide"),
        ({"stop_angle_deg": 200.0}, "stop_time and drive.stop_angle_deg: allowed is one"),
        ({"brake_on_deg": [1.0, 3.0]}, r"brake_on and drive\.brake_on_deg: allowed is one"),
        (
            {"brake_on": None, "brake_on_deg": [1.0, 3.0]},
            "brake_on_deg: allowed are both over time",
        ),
        (
            {"stop_time": None, "stop_angle_deg": 200.0, "start_time": [0.05, 2.0]},
            "allowed is one start, of a press that stands",
        ),
        ({"clutch_torque": None}, r"drive\.begins = 'standing' needs drive\.clutch_torque"),
        ({"clutch_torque": None, "begins": "rest"}, r"not used .*clutch_torque is not given"),
        ({"brake_torque": None}, r"drive\.brake_o.* not used .*brake_torque is not given"),
        (
            {"stop_time": None, "brake_on": None},
            r"clutch_off = .*not used .*neither drive\.stop_time",
        ),
    ],
    ids=str,
)
def test_a_schedule_that_is_refused(changes, message):
    with pytest.raises(InputError, match=message):
        scene(**changes)


def test_what_a_scene_refuses_beside_a_schedule():
    with pytest.raises(InputError, match=r"settle = 1: allowed is 0 with a .drive. that starts"):
        scene().replace({"settle": 1.0})
    with pytest.raises(InputError, match="stop_angle_deg = 90: allowed is a number > start_angle"):
        Scene(
            mechanism="eccentric_press",
            start_angle_deg=100.0,
            drive={**{k: v for k, v in DRIVE.items() if k != "stop_time"}, "stop_angle_deg": 90.0},
        )
