import numpy as np
import pytest
from matplotlib.path import Path

from exu_press import Scene
from exu_press.mechanism.shapes import moved, shapes_of, swept
from exu_press.scene import mechanism_of

SCENES = [
    {"mechanism": "press"},
    {"mechanism": "press", "press": {"counterweight": False}},
    {"mechanism": "slider_crank"},
    {"mechanism": "six_bar"},
    {"mechanism": "andrews_squeezer"},
]


@pytest.mark.parametrize("scene", SCENES)
def test_every_body_has_an_outline_around_all_its_joints(scene):
    mechanism = mechanism_of(Scene(**scene))
    shapes = shapes_of(mechanism)
    assert list(shapes) == [body.name for body in mechanism.bodies]
    for joint in mechanism.joints:
        for body, point in mechanism.ends(joint):
            if body in shapes:
                outline = Path(shapes[body].outline, closed=False)
                assert outline.contains_point(point, radius=1e-9), (body, joint.name)


@pytest.mark.parametrize("scene", SCENES)
def test_outlines_run_counter_clockwise(scene):
    for shape in shapes_of(mechanism_of(Scene(**scene))).values():
        x, y = shape.outline.T
        assert 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) > 0.0


def test_roles():
    roles = {name: shape.role for name, shape in shapes_of(mechanism_of(Scene())).items()}
    assert roles["crank"] == "crank"
    assert roles["linkage"] == "bearing"
    assert roles["link_6_left"] == "link"
    assert {n for n, role in roles.items() if role == "block"} == {
        "slide", "plunger_left", "plunger_right", "slider", "counterweight",
    }  # fmt: skip


def test_moved_turns_and_shifts():
    pose = np.array([1.0, 2.0, np.pi / 2])
    assert moved(np.array([[1.0, 0.0]]), pose)[0] == pytest.approx([1.0, 3.0])


def test_swept_spans_the_mechanism():
    height = np.ptp(swept(mechanism_of(Scene(mechanism="slider_crank")))[:, 1])
    assert height == pytest.approx(2 * 0.03 + 0.383, abs=1e-6)
