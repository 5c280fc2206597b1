"""The keys in which scenes differ."""

from exu_press import Scene
from exu_press.studies import compare
from exu_press.studies.compare import different_keys, variants


def rows(scenes):
    head, *lines = different_keys(scenes)
    assert head[1:] == list(scenes)
    return {line[0]: line[1:] for line in lines}


def test_a_changed_number_and_a_table_that_one_scene_has():
    base = Scene()
    other = base.replace(
        {
            "speed_rpm": 300.0,
            "joints.crank_pin.clearance": 5e-5,
            "guide": {"lateral_stiffness": 1e9},
        }
    )
    loaded = other.replace({"load.punch": {"kind": "blanking", "force": 1e4}})
    found = rows({"a": base, "b": loaded})
    assert found["speed_rpm"] == ["240", "300"]
    assert found["joints.crank_pin.clearance"] == ["0.0001", "5e-05"]
    assert found["[guide]"] == ["-", "given"] == found["[load.punch]"]
    assert len(found) == 4


def test_a_long_table_ends_with_the_number_of_further_keys(monkeypatch):
    monkeypatch.setattr(compare, "MOST_KEYS", 2)
    changes = dict.fromkeys(("revolutions", "gravity", "start_angle_deg", "speed_rpm"), 1.0)
    _, *lines = different_keys({"a": Scene(), "b": Scene().replace(changes)})
    assert len(lines) == 3 and lines[-1][0] == "2 more keys"


def test_solids_of_other_dimensions_are_left_out():
    """So are those on which a load would press at a point; a counterweight is no part of them."""
    press = Scene()
    assert "flexible dry" in variants(press.replace({"press.counterweight": False}))[0]
    load = {"load.a": {"kind": "blanking", "force": 1e4, "body": "crank"}}
    for change, reason in (({"press.crank_radius": 0.04}, "other dimensions"), (load, "dent")):
        scenes, (left_out,) = variants(press.replace(change))
        assert list(scenes) == ["ideal", "dry", "lubricated"]
        assert left_out.startswith("flexible: left out") and reason in left_out


def test_drawings_of_the_same_name_differ_in_their_keys():
    shipped = Scene(mechanism="six_bar", joints={}, speed_rpm=60.0)
    heavy = shipped.replace({"mechanism.bodies.ram.mass": 1.5e3})
    drawing = heavy.to_dict()["mechanism"]
    spring = {"between": ["ram", "frame"], "at": [[0, 0], [0, 1]], "stiffness": 1e3, "preload": 0.0}
    sprung = heavy.replace({"mechanism": {**drawing, "springs": {"counterbalance": spring}}})
    found = rows({"shipped": shipped, "heavy": heavy, "sprung": sprung})
    assert found["mechanism.bodies.ram.mass"][1:] == ["1500", "1500"]
    assert found["[mechanism.springs.counterbalance]"] == ["-", "-", "given"]
    assert len(found) == 2
