"""The [guide] table, the load's eccentricity and the counterweight's switch."""

import pytest

from exu_press import InputError, Scene
from exu_press.scene import parse_assignment


def test_absent_means_ideal():
    scene = Scene()
    assert scene.guide is None
    assert "guide" not in scene.to_dict()


def test_an_empty_table_means_defaults():
    scene = Scene(guide={})
    assert scene.guide.lateral_stiffness == 1e9
    assert Scene.from_dict(scene.to_dict()) == scene


def test_on_and_off_by_replace():
    scene = Scene().replace("guide.lateral_stiffness", 2e8)
    assert scene.guide.lateral_stiffness == 2e8
    assert scene.guide.length == 0.5
    assert scene.replace("guide", None) == Scene()
    other = scene.replace({"guide": None, "mechanism": "slider_crank"})
    assert other == Scene(mechanism="slider_crank")


def test_on_the_command_line():
    assert Scene().replace(dict([parse_assignment("guide={}")])).guide == Scene(guide={}).guide


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        ({"guide": {"stiffness": 1.0}}, r"guide\.stiffness = 1\.0: unknown key"),
        ({"guide": {"lateral_stiffness": 0.0}}, r"guide\.lateral_stiffness = 0\.0: allowed .* > 0"),
        ({"guide": {"damping_ratio": -0.1}}, r"guide\.damping_ratio = -0\.1: allowed .* >= 0"),
        ({"guide": 1e9}, r"guide = 1000000000\.0: allowed is a table"),
        (
            {"mechanism": "slider_crank", "guide": {"slide_inertia": 1.0}},
            r"guide\.slide_inertia = 1\.0: is press\.slide_inertia now",
        ),
        (
            {"press": {"counterweight": False, "counterweight_mass": 900.0}},
            r"press\.counterweight_mass = 900\.0: not used .* \(press\.counterweight is false\)",
        ),
        (
            {"press": {"counterweight": False, "counterweight_inertia": 9.0}},
            r"press\.counterweight_inertia = 9\.0: not used .* \(press\.counterweight is false\)",
        ),
        ({"press": {"counterweight": 0}}, r"press\.counterweight = 0: allowed is true or false"),
    ],
)
def test_what_is_refused(scene, message):
    with pytest.raises(InputError, match=message) as caught:
        Scene.from_dict(scene)
    assert "\n" not in str(caught.value)


def test_a_press_that_loses_its_counterweight_loses_its_keys():
    scene = Scene(press={"counterweight_mass": 900.0, "counterweight_inertia": 9.0})
    bare = scene.replace("press.counterweight", False)
    assert bare == Scene(press={"counterweight": False})
    with pytest.raises(InputError, match="counterweight_mass"):
        bare.replace("press.counterweight_mass", 900.0)
