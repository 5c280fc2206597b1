"""Exudyn's own viewer has something to show of every body, and a run does not pay for it."""

import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from coarse_parts import COARSE
from PIL import Image

from exu_press import Scene
from exu_press.mechanism.shapes import shapes_of
from exu_press.model import build
from exu_press.model.graphics import add_graphics


def test_every_body_is_seen():
    model = Scene(bodies=COARSE).build()
    for name, number in model.bodies.items():
        item = model.mbs.GetObject(number, addGraphicsData=True)
        if item["objectType"] == "FFRFreducedOrder":
            assert len(item["VtriangleMesh"]) > 1000
        else:
            assert len(item["VgraphicsData"]) >= 1, name


def test_a_body_has_its_outline_in_the_frame_of_exudyns_item():
    model = build(Scene())
    add_graphics(model)
    for body, axis, low, high in (
        ("link_7_left", 0, -0.082, 0.082),  # both ends from the middle
        ("link_6_left", 0, 0.0, 0.24),  # from the pivot that it turns about
        ("plunger_left", 1, -0.275, 0.275),  # upright: Exudyn does not turn what it slides
    ):
        item = model.mbs.GetObject(model.bodies[body], addGraphicsData=True)
        points = next(g["points"] for g in item["VgraphicsData"] if g["type"] == "TriangleList")
        along = points.reshape(-1, 3)[:, axis]
        assert low - 0.05 < along.min() <= low
        assert high <= along.max() < high + 0.05


RENDER = """
from exu_press import Scene
model = Scene().build()
settings = model.SC.visualizationSettings
settings.view0.window.renderWindowSize = [600, 600]
settings.exportImages.saveImageFileName = r"%s"
settings.exportImages.saveImageFormat = "PNG"
model.SC.renderer.Start()
model.SC.renderer.ZoomAll()
model.SC.renderer.RedrawAndSaveImage()
model.SC.renderer.Stop()
"""


def test_the_picture(tmp_path):
    """As Exudyn draws it: the sliding bodies' plates stand where they are, in their own colour."""
    display = [] if os.environ.get("DISPLAY") else [shutil.which("xvfb-run"), "-a"]
    if None in display:
        pytest.skip("there is neither a display nor xvfb-run")
    command = [*display, sys.executable, "-c", RENDER % (tmp_path / "picture")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "picture00000.png") as image:
        pixels = np.array(image.convert("RGB"), dtype=float)
    model = build(Scene())
    shapes = shapes_of(model.mechanism)
    plates = [
        name for name in model.constraints.sliding_bodies if name != "slide"
    ]  # hidden by the links
    (colour,) = {shapes[name].colour for name in plates}
    wanted = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])
    drawn = np.abs(pixels - 0.88 * wanted).max(axis=2) < 4.0
    rows, columns = np.nonzero(drawn)
    assert len(rows) > 5_000
    motion = model.mechanism.motion(np.array([0.0]), 1.0)
    places = np.vstack([shapes[name].outline_at(motion[name].position[0]) for name in plates])
    width, height = np.ptp(places, axis=0)
    assert np.ptp(columns) / np.ptp(rows) == pytest.approx(width / height, rel=0.02)
