"""Exudyn's own viewer has something to show of every body, and a run does not pay for it."""

import subprocess
import sys

import pytest

from exu_press import Scene
from exu_press.graphics import add_graphics
from exu_press.model import build

SCENES = [{"mechanism": "press"}, {"mechanism": "slider_crank"}, {"bodies": "flexible"}]


@pytest.mark.parametrize("scene", SCENES)
def test_every_body_is_seen(scene):
    model = Scene(**scene).build()
    for name, number in model.bodies.items():
        item = model.mbs.GetObject(number, addGraphicsData=True)
        if item["objectType"] == "FFRFreducedOrder":
            assert len(item["VtriangleMesh"]) > 1000
        else:
            assert len(item["VgraphicsData"]) >= 1, name


@pytest.mark.parametrize(
    ("body", "axis", "low", "high"),
    [
        ("link_7_left", 0, -0.082, 0.082),  # both ends from the middle
        ("link_6_left", 0, 0.0, 0.24),  # from the pivot that it turns about
        ("plunger_left", 0, -0.275, 0.275),  # x upwards
    ],
)
def test_a_body_has_its_outline_in_the_frame_of_exudyns_item(body, axis, low, high):
    model = build(Scene())
    add_graphics(model)
    item = model.mbs.GetObject(model.bodies[body], addGraphicsData=True)
    points = next(g["points"] for g in item["VgraphicsData"] if g["type"] == "TriangleList")
    along = points.reshape(-1, 3)[:, axis]
    assert low - 0.05 < along.min() <= low
    assert high <= along.max() < high + 0.05


def test_a_run_makes_no_graphics():
    code = (
        "import sys; from exu_press import Scene, simulate; "
        "simulate(Scene(mechanism='slider_crank', revolutions=0.01)); "
        "print('exu_press.graphics' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split()[-1] == "False"
