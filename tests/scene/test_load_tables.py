"""[load.NAME]: what a scene allows and fills in, tables as CSV, and what is refused."""

import json
import math

import pytest
from refused import refused

from exu_press import InputError, Scene
from exu_press.scene import BlankingLoad, TableLoad, mechanism_of
from exu_press.scene.applied import applied_loads
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


def test_a_scene_with_loads_comes_back_equal(tmp_path):
    more = {"body": "link_7_left", "offset": [0.0, 0.1], "direction": [3, 4], "factor": 2.0}
    scene = Scene(load={"blanking": {**PULSE, "offset": [-0.1, 0]}, "spring": {**TABLE, **more}})
    complete = scene.to_dict()
    assert json.loads(json.dumps(complete)) == complete
    assert Scene.from_dict(complete) == scene
    assert hash(Scene.from_dict(complete)) == hash(scene)
    scene.save(tmp_path / "scene.toml", comments=True)
    assert Scene.load(tmp_path / "scene.toml") == scene


def test_by_default_it_acts_on_the_output_in_its_direction():
    applied = applied_loads(Scene(mechanism="six_bar", load={"a": PULSE}))["a"]
    assert (applied.body, applied.point, applied.direction) == ("ram", (0.0, 0.0), (0.0, 1.0))


def test_an_offset_is_as_drawn():
    """The linkage is drawn hanging, its x axis downwards: 0.1 m to its right is its +y."""
    load = {"a": {**PULSE, "body": "linkage", "offset": [0.1, 0.0], "direction": [0.0, -2.0]}}
    applied = applied_loads(Scene(load=load))["a"]
    assert applied.point == pytest.approx((0.0, 0.1))
    assert applied.direction == (0.0, -1.0)


def test_keys_on_the_command_line_and_in_sweeps():
    scene = Scene().replace({"load.a.force": 2e4, "load.a.kind": "blanking"})
    assert scene.load["a"] == BlankingLoad(force=2e4)
    changed = scene.replace({"load.a.force": 3e4}).replace({"load.a.offset": [0.1, 0.0]})
    assert changed.load["a"] == BlankingLoad(force=3e4, offset=(0.1, 0.0))
    table = changed.replace({"load.a.kind": "table", "load.a.time": [0, 1], "load.a.force": [0, 1]})
    assert table.load["a"] == TableLoad(time=(0.0, 1.0), force=(0.0, 1.0), offset=(0.1, 0.0))
    assert not table.replace({"load": {}}).load
    assert changed.replace({"mechanism": "slider_crank"}).load == changed.load


def test_a_csv_file_lies_beside_the_scene(tmp_path):
    (tmp_path / "force.csv").write_text("# drawing\n\ncrank_angle_deg, force\n90,0\n180, 2e5\n")
    (tmp_path / "scene.toml").write_text('[load.a]\nkind = "table"\nfile = "force.csv"\n')
    load = Scene.load(tmp_path / "scene.toml").load["a"]
    assert load == TableLoad(crank_angle_deg=(90.0, 180.0), force=(0.0, 2e5))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "header ''; allowed are two names"),
        ("t,F\n0,1\n", "header 't,F'; allowed is 'time,force' or 'crank_angle_deg,force' or"),
        ("force,time\n0,1\n", "header 'force,time'"),
        ("time,force\n", "0 lines of numbers; allowed are at least two"),
        ("time,force\n0,1\n", "1 lines of numbers"),
        ("time,force\n0,1\n1,x\n", "line 3: '1,x'; allowed are two numbers"),
        ("time,force\n0,1\n1,2,3\n", "line 3: '1,2,3'; allowed are two numbers"),
        ("time force\n0 1\n", "header 'time force'"),
        ("time,force,x\n0,1\n", "header 'time,force,x'"),
        ("time;force\n0;0,5\n1;1.5\n", "line 3: '1;1.5'; allowed is a decimal comma, as on"),
        ("time;force\n0;0.5\n1;1.000,5\n", "line 2: '0;0.5'; allowed is a decimal comma, as on"),
        ('time,force\n0,1\n1,"1,5"\n', "line 3: '1,\"1,5\"'; allowed are two numbers"),
        ("time,force\n0,1\n1,1e300\n", "line 3: '1,1e300'; allowed are finite numbers below"),
        ("time,force\n0,1\n1,nan\n", "line 3: '1,nan'; allowed are finite"),
        ("time,force\n0,1\n1,2\n1,3\n", "line 4: 1 after 1; allowed is inc"),
    ],
)
def test_a_csv_file_that_is_none_is_refused_by_line(text, message, tmp_path):
    path = tmp_path / "force.csv"
    path.write_text(text)
    told = refusal({"a": {"kind": "table", "file": str(path)}})
    assert told.startswith(f"load.a.file: {path}")
    assert message in told


@pytest.mark.parametrize(
    ("load", "message"),
    [
        (5, "load = 5: allowed is a table of loads"),
        ({"a b": PULSE}, "load: 'a b' is no name"),
        ({"a": 3}, "load.a = 3: allowed is a table of keys"),
        ({"a": {"force": 1.0}}, "load.a has no kind: allowed is one of 'blanking', 'table'"),
        ({"ä": PULSE}, "load: 'ä' is no name"),
        ({"a": {"kind": []}}, "load.a.kind = []: allowed is one of"),
        ({"a": {"kind": "blank"}}, "load.a.kind = 'blank': allowed is one of"),
        ({"a": {"kind": "blanking"}}, "load.a.force: missing"),
        ({"a": {**PULSE, "force": -1}}, "load.a.force = -1.0: allowed is a number >= 0"),
        ({"a": {**PULSE, "rise": 0}}, "load.a.rise = 0.0: allowed is a number > 0"),
        ({"a": {**PULSE, "end_angle_deg": 361}}, "load.a.end_angle_deg = 361.0: allowed"),
        (
            {"a": {**PULSE, "start_angle_deg": 90, "end_angle_deg": 100}},
            "load.a.start_angle_deg and end_angle_deg: allowed is one of the two",
        ),
        ({"a": {**PULSE, "time": [0, 1]}}, "load.a.time = [0, 1]: not used by this scene"),
        ({"a": {**PULSE, "rize": 1.0}}, "unknown key of kind 'blanking' (did you mean 'rise'?)"),
        ({"a": {**PULSE, "body": "slidr"}}, "press has no such body (did you mean 'slider'?)"),
        ({"a": {**PULSE, "body": "frame"}}, "load.a.body = 'frame': press has no such body"),
        ({"a": {**PULSE, "body": 3}}, "load.a.body = 3: allowed is a text"),
        ({"a": {**PULSE, "offset": 0.1}}, "load.a.offset = 0.1: allowed is a list of 2 numbers"),
        ({"a": {**PULSE, "offset": [0, "x"]}}, "allowed is a list of 2 numbers"),
        ({"a": {**PULSE, "direction": [0, 0]}}, "load.a.direction = [0, 0]: allowed is a direc"),
        ({"a": {**PULSE, "rise": 0.2, "fall": 0.06}}, "load.a.rise + fall = 0.26: allowed is at"),
        ({"a": {**HEIGHT, "height": [0.02, 0.0]}}, "load.a.height = 0.0 after 0.02: allowed is i"),
        ({"a": {**HEIGHT, "acts": "up"}}, "load.a.acts = 'up': allowed is one of 'closing'"),
        ({"a": {**PULSE, "acts": "both"}}, "load.a.acts = 'both': not used by this scene"),
        ({"a": {"kind": "table"}}, "load.a.nothing given: allowed is file, a CSV, or one of time"),
        ({"a": {**TABLE, "crank_angle_deg": [0, 1]}}, "time, crank_angle_deg, force given"),
        ({"a": {**TABLE, "file": "a.csv"}}, "load.a.file and force: allowed is one of the two"),
        ({"a": {**TABLE, "force": [1.0]}}, "load.a.time, force: 2 and 1 values"),
        ({"a": {**TABLE, "time": [0.1, 0.1]}}, "load.a.time = 0.1 after 0.1: allowed is inc"),
        ({"a": {**TABLE, "time": [0, True]}}, "allowed is a list of numbers"),
        ({"a": {"kind": "table", "file": 3}}, "load.a.file = 3: allowed is the path of a CSV"),
        ({"a": {"kind": "table", "file": "no.csv"}}, "load.a.file: no.csv: cannot be read"),
        (
            {"a": {"kind": "table", "crank_angle_deg": [0, 400], "force": [0, 1]}},
            "load.a.crank_angle_deg from 0.0 to 400.0: allowed is less than a revolution",
        ),
        (
            {"a": {"kind": "table", "crank_angle_deg": [0, 360], "force": [0, 1]}},
            "a whole one that ends with the force with which it begins",
        ),
    ],
)  # fmt: skip
def test_what_is_refused(load, message):
    assert message in refusal(load)


@pytest.mark.parametrize(
    ("load", "message"),
    [
        (
            {"body": "linkage"},
            "load.a: acts on the flexible linkage, which a force at a point would dent without "
            "end; allowed are joint, one of crank_pin, slide_pin, or face, of those that carry it",
        ),
        (
            {"body": "linkage", "joint": "slide_pins"},
            "load.a.joint = 'slide_pins': linkage has no such joint (did you mean 'slide_pin'?)",
        ),
        ({"joint": "ball_left", "offset": [0, 1]}, "load.a.joint and offset: allowed is one of"),
        ({"joint": "ball_left", "face": "a"}, "load.a.joint and face: allowed is one of the two"),
        ({"face": "a"}, "load.a.face: slider is rigid; allowed are joint and offset, or [bodies.s"),
        ({"body": "linkage", "face": {}}, "load.a.face = {}: allowed is a face's name, or ranges"),
        ({"body": "linkage", "face": 3}, "load.a.face = 3: allowed is a face's name, or a table"),
        ({"body": "linkage", "face": {"radius": 1}}, "load.a.face.radius = 1: unknown key"),
        ({"body": "linkage", "face": {"x": [1, 0]}}, "load.a.face.x = [1.0, 0.0]: allowed"),
    ],
)  # fmt: skip
def test_what_is_refused_on_flexible_bodies(load, message):
    assert refusal({"a": {**PULSE, **load}}, bodies={"linkage": "linkage"}).startswith(message)


def test_a_load_on_a_joint_or_a_face_is_saved_and_read_back(tmp_path):
    load = {
        "pin": {**PULSE, "body": "linkage", "joint": "slide_pin"},
        "bore": {**PULSE, "body": "linkage", "face": "big bore"},
        "two": {**PULSE, "body": "linkage", "face": [{"x": [0, 1]}, {"y": [0, 1], "z": [2, 3]}]},
    }
    scene = Scene(bodies={"linkage": "linkage"}, load=load)
    assert Scene.from_dict(scene.to_dict()) == scene
    scene.save(tmp_path / "scene.toml")
    assert Scene.load(tmp_path / "scene.toml") == scene
    moved = scene.replace({"load.pin.joint": "crank_pin"})
    assert moved.load["pin"].joint == "crank_pin"


def test_a_joint_is_a_place_of_a_rigid_body_too():
    scene = Scene(load={"a": {**PULSE, "joint": "ball_left"}})
    mechanism = mechanism_of(scene)
    ball = next(joint for joint in mechanism.joints if joint.name == "ball_left")
    assert applied_loads(scene)["a"].point == mechanism.body("slider").local(ball.at)


def test_a_force_over_the_height_forms_unless_it_acts_both_ways():
    def fade(**load):
        scene = Scene(mechanism="eccentric_press", speed_rpm=60.0, load={"a": load})
        return applied_loads(scene)["a"].fade

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
        ({"height": [0.2, 0.3]}, "from 0.2 to 0.3 m: the output is between"),
        ({"force": [-2e5, 0.0]}, "load.a acts while the output closes, and pushes the way it goes"),
    ],
)
def test_what_is_hardly_meant(load, message):
    scene = Scene(mechanism="eccentric_press", load={"a": HEIGHT | load})
    assert any(message in told for told in scene_warnings(scene))
    usual = Scene(mechanism="eccentric_press", load={"a": HEIGHT})
    assert not any("load.a" in told for told in scene_warnings(usual))


def test_the_old_spelling_is_refused_and_the_new_one_named():
    with pytest.raises(
        InputError, match=r"blanking = .*: is load\.NAME with kind = 'blanking' now"
    ):
        Scene.from_dict({"blanking": {"force": 1e4}})
    with pytest.raises(InputError, match=r"blanking\.force = 1.0: is load\.NAME with kind"):
        Scene().replace({"blanking.force": 1.0})
