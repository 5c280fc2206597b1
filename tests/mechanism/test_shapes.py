import numpy as np
import pytest
from matplotlib.path import Path

from exu_press import Scene
from exu_press.mechanism import Body, Guide, Joint, Mechanism, Output
from exu_press.mechanism.shapes import (
    FrontView,
    rail_corners,
    shapes_of,
)
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
    """It runs counter-clockwise."""
    mechanism = mechanism_of(Scene(**scene))
    shapes = shapes_of(mechanism)
    assert list(shapes) == [body.name for body in mechanism.bodies]
    for shape in shapes.values():
        x, y = shape.outline.T
        assert 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) > 0.0
    for joint in mechanism.joints:
        for body, point in mechanism.ends(joint):
            if body in shapes:
                outline = Path(shapes[body].outline, closed=False)
                assert outline.contains_point(point, radius=1e-9), (body, joint.name)


@pytest.mark.parametrize("degrees", [90.0, -90.0, 0.0, 30.0, 180.0])
def test_rails_and_dead_centres_lie_along_the_guide(degrees):
    along = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    across = np.array([along[1], -along[0]])
    pin, wrist = tuple(0.1 * along), tuple(0.5 * along)
    mechanism = Mechanism(
        "slider_crank",
        [
            Body("crank", 1.0, 0.1),
            Body("rod", 1.0, centre_of_mass=tuple(0.3 * along)),
            Body("slide", 1.0, 0.1, wrist),
        ],
        [
            Joint("shaft", (0.0, 0.0), "crank", "frame"),
            Joint("pin", pin, "crank", "rod"),
            Joint("wrist", wrist, "rod", "slide"),
        ],
        crank="crank",
        guides=[Guide("slide", tuple(along))],
        output=Output("slide", tuple(along)),
    )
    view = FrontView(mechanism)
    outline = view.swept["slide"]
    beside = outline @ across
    for rail in rail_corners(mechanism.guides[0], outline, 1.0):
        sides = rail @ across
        assert not np.any((sides > beside.min()) & (sides < beside.max()))
        assert np.ptp(rail @ along) == pytest.approx(np.ptp(outline @ along))
    top, bottom = view.dead_centres()
    assert (top.label, bottom.label) == ("TDC", "BDC")
    assert (top.position - bottom.position) == pytest.approx(0.2 * along)
    assert top.direction[0] <= 1e-12
    assert abs(top.direction @ along) < 1e-12
    assert top.is_above == (along[1] > 1e-9)
