"""Flexible bodies in the page: what is coloured is the stress that the file gives."""

import re

import numpy as np
import pytest
from browser import opened
from page.test_live_page import put

from exu_press import Scene, simulate
from exu_press.report.html import page
from exu_press.result.surface import Surface

pytest.importorskip("bokeh")

from exu_press.page.viewer import viewer
from exu_press.result.channel import Channel


def with_surface(result):
    """Return a run whose rod has a surface of four nodes and two modes, as a flexible one has."""
    rng = np.random.default_rng(3)
    nodes = np.array([[0, 0, 0], [0.4, 0, 0], [0, 0.1, 0], [0, 0, 0.1]], dtype=np.float32)
    triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int32)
    surface = Surface(
        nodes,
        triangles,
        rng.normal(size=(4, 3, 2)).astype(np.float32) * 1e-3,
        rng.normal(size=(4, 6, 2)).astype(np.float32) * 1e8,
    )
    time = result.time
    modes = np.column_stack([np.sin(400 * time), 0.3 * np.cos(900 * time)])
    channel = Channel(modes, "kg^0.5 m", "rod: modal coordinates", "rod_mode")
    return result.__class__(
        scene=result.scene,
        channels={**result.channels, "rod_modes": channel},
        info=result.info,
        bodies=result.bodies,
        surfaces={"rod": surface},
    )


@pytest.mark.long
def test_stress_and_displacement_are_those_of_the_file(tmp_path, browser):
    run = with_surface(
        simulate(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.05))
    )
    live = viewer({"": run})
    path = tmp_path / "page.html"
    path.write_text(page("flexible", "", [("In motion", live)]), encoding="utf-8")
    surface, step = run.surfaces["rod"], len(run.time) // 3
    coordinates = run["rod_modes"][step]
    with opened(browser, path) as shown:
        if "no WebGL" in shown.inner_text("#surfaces"):
            pytest.skip("this browser draws nothing with WebGL")
        put(shown, 1e3 * run.time[step])
        for kind, expected in (
            ("stress", 1e-6 * surface.von_mises(coordinates).max()),
            ("displacement", 1e6 * np.linalg.norm(surface.displacement(coordinates), axis=1).max()),
        ):
            shown.select_option("#surfaces select", kind)
            told = shown.inner_text("#surfaces .scale")
            assert float(re.search(r"at most (\S+)", told)[1]) == pytest.approx(expected, rel=6e-3)
