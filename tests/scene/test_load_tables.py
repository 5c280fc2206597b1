"""[load.NAME]: what a scene allows and fills in, tables as CSV, where loads act, refusals."""

import math
import pickle

import numpy as np
import pytest
from refused import refused

from exu_press import Scene
from exu_press.scene import BlankingLoad, TableLoad, mechanism_of
from exu_press.scene.warnings import scene_warnings

PULSE = {"kind": "blanking", "force": 1e4}
TABLE = {"kind": "table", "time": [0.0, 0.1], "force": [0.0, 1e3]}
HEIGHT = {"kind": "table", "height": [0.0, 0.02], "force": [2e5, 0.0]}


def refusal(load, **scene):
    return refused(Scene.from_dict, {"load": load, **scene})


def test_any_number_of_loads_by_name():
    scene = Scene(load={"blanking": PULSE, "spring": TABLE, "third": BlankingLoad(force=1.0)})
    assert [*scene.load] == ["blanking", "spring", "third"]
    assert scene.load["blanking"] == BlankingLoad(force=1e4)
    assert scene.load["spring"] == TableLoad(time=(0.0, 0.1), force=(0.0, 1e3))
    assert not Scene().load


def test_an_offset_is_as_drawn():
    """The linkage is drawn hanging, its x axis downwards: 0.1 m to its right is its +y."""
    load = {"a": {**PULSE, "body": "linkage", "offset": [0.1, 0.0], "direction": [0.0, -2.0]}}
    applied = Scene(load=load).applied_loads["a"]
    assert applied.point == pytest.approx((0.0, 0.1))
    assert applied.direction == (0.0, -1.0)
    applied = Scene(mechanism="six_bar", load={"a": PULSE}).applied_loads["a"]
    assert (applied.body, applied.point, applied.direction) == ("ram", (0.0, 0.0), (0.0, 1.0))


def test_keys_on_the_command_line_and_in_sweeps():
    scene = Scene().replace({"load.a.force": 2e4, "load.a.kind": "blanking"})
    assert scene.load["a"] == BlankingLoad(force=2e4)
    changed = scene.replace({"load.a.force": 3e4}).replace({"load.a.offset": [0.1, 0.0]})
    assert changed.load["a"] == BlankingLoad(force=3e4, offset=(0.1, 0.0))
    table = changed.replace({"load.a.kind": "table", "load.a.time": [0, 1], "load.a.force": [0, 1]})
    assert table.load["a"] == TableLoad(time=(0.0, 1.0), force=(0.0, 1.0), offset=(0.1, 0.0))
    assert not table.replace({"load": {}}).load
    assert changed.replace({"mechanism": "slider_crank"}).load == changed.load


def test_applied_loads_are_computed_once_for_a_scene_and_not_copied():
    scene = Scene(load={"a": PULSE})
    assert scene.applied_loads is scene.applied_loads
    assert scene.replace({"load.a.force": 3.0}).applied_loads["a"].curve.peak == 3.0
    again = pickle.loads(pickle.dumps(scene))
    assert again == scene and "applied_loads" not in vars(again)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "header ''; allowed are two names"),
        ("t,F\n0,1\n", "header 't,F'; allowed is 'time,force' or 'crank_angle_deg,force' or"),
        ("time,force\n", "0 lines of numbers; allowed are at least two"),
        ("time,force\n0,1\n1,x\n", "line 3: '1,x'; allowed are two numbers"),
        ("time,force\n0,1\n1,2,3\n", "line 3: '1,2,3'; allowed are two numbers"),
        ("time;force\n0;0,5\n1;1.5\n", "line 3: '1;1.5'; allowed is a decimal comma, as on"),
        ("time;force\n0;0.5\n1;1.000,5\n", "line 2: '0;0.5'; allowed is a decimal comma, as on"),
        ('time,force\n0,1\n1,"1,5"\n', "line 3: '1,\"1,5\"'; allowed are two numbers"),
        ("time,force\n0,1\n1,1e300\n", "line 3: '1,1e300'; allowed are finite numbers below"),
        ("time,force\n0,1\n1,2\n1,3\n", "line 4: 1 after 1; allowed is inc"),
    ],
)
def test_a_csv_file_that_is_none_is_refused_by_line(text, message, tmp_path):
    path = tmp_path / "force.csv"
    path.write_text(text)
    told = refusal({"a": {"kind": "table", "file": str(path)}})
    assert told.startswith(f"load.a.file: {path}")
    assert message in told


def test_a_joint_is_a_place_of_a_rigid_body_too():
    scene = Scene(load={"a": {**PULSE, "joint": "ball_left"}})
    mechanism = mechanism_of(scene)
    ball = next(joint for joint in mechanism.joints if joint.name == "ball_left")
    assert scene.applied_loads["a"].point == mechanism.body("slider").local(ball.at)


def test_a_force_over_the_height_forms_unless_it_acts_both_ways():
    def fade(**load):
        scene = Scene(mechanism="eccentric_press", speed_rpm=60.0, load={"a": load})
        return scene.applied_loads["a"].fade

    fastest = 2.0 * math.pi * 0.03  # of the crank pin; the ram is a little faster
    assert fade(**HEIGHT) == pytest.approx(1e-3 * fastest, rel=0.01)
    assert fade(**HEIGHT, acts="both") is None
    assert fade(**TABLE) is None
    assert fade(**TABLE, acts="closing") == fade(**HEIGHT)


@pytest.mark.parametrize(
    ("load", "message"),
    [
        ({"height": [0.0, 20.0]}, "from 0 to 20 m: the output is between 0 and 0.0"),
        ({"height": [0.0, 20.0]}, "Was 0.02 m (20 mm) meant?"),
        ({"height": [-0.157, -0.150]}, "from -0.157 to -0.15 m: the output is between"),
        ({"force": [-2e5, 0.0]}, "load.a acts while the output closes, and pushes the way it goes"),
    ],
)
def test_what_is_hardly_meant(load, message):
    scene = Scene(mechanism="eccentric_press", load={"a": HEIGHT | load})
    assert any(message in told for told in scene_warnings(scene))
    usual = Scene(mechanism="eccentric_press", load={"a": HEIGHT})
    assert not any("load.a" in told for told in scene_warnings(usual))


FORCE = np.array([100.0])


@pytest.mark.parametrize(
    ("offset", "direction", "turned", "moment"),
    [
        ((0.0, 0.2), (1.0, 0.0), 0.0, -20.0),  # to the right, above the centre: clockwise
        ((0.0, 0.2), (1.0, 0.0), math.pi / 2.0, 0.0),  # the point lies to the left then
        ((0.0, 0.2), (0.0, 1.0), math.pi / 2.0, -20.0),
        ((0.3, 0.0), (0.0, 1.0), 0.0, 30.0),
        ((0.3, 0.0), (1.0, 0.0), math.pi / 2.0, -30.0),
        ((0.3, 0.2), (3.0, 4.0), 0.0, 0.3 * 80.0 - 0.2 * 60.0),
    ],
)
def test_the_moment_of_a_load_beside_the_centre_of_mass(offset, direction, turned, moment):
    pulse = {"kind": "table", "time": [0.0, 1.0], "force": [1.0, 1.0], "body": "slider"}
    load = {**pulse, "offset": list(offset), "direction": list(direction)}
    scene = Scene(mechanism="slider_crank", joints={}, load={"a": load})
    applied = scene.applied_loads["a"]
    assert applied.moment(FORCE, np.array([turned]))[0] == pytest.approx(moment, abs=1e-12)
