"""The shipped drag-link press against what one finds by hand: pins, flywheel, guide."""

import cmath
import math
from pathlib import Path

import numpy as np
import pytest

import exu_press
from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

SCENE = Path(exu_press.__file__).parent / "scenes" / "drag_link.toml"
CRANK, LINK, LONG, SHORT, FRAME = 0.15, 0.12, 0.15, 0.06, 0.05  # m
ROD, RAM = 0.82747, 500.0 + 26.6  # m; kg, with the rod


def places(angle):
    """Return the ram's height above the pivot, m, by crank angle, and the pins of the link."""
    pivot = complex(-FRAME, 0.0)
    pin = CRANK * cmath.exp(1j * (angle + math.atan2(-0.13328, 0.06883)))
    away = pin - pivot
    along = (LONG**2 - LINK**2 + abs(away) ** 2) / (2 * abs(away))
    beside = math.sqrt(LONG**2 - along**2)
    link_pin = pivot + (along - 1j * beside) * away / abs(away)
    rod_pin = pivot - SHORT / LONG * (link_pin - pivot)
    wrist = rod_pin.imag - math.sqrt(ROD**2 - (rod_pin - pivot).real ** 2)
    return wrist, pin, link_pin, rod_pin, pivot


def by_hand(angle, speed, load):
    """Return the forces of link and guide, N, of load, weight and the ram's inertia alone."""
    wrist, pin, link_pin, rod_pin, pivot = places(angle)
    h = 1e-3
    second = (places(angle + h)[0] - 2 * wrist + places(angle - h)[0]) / h**2
    upwards = RAM * (second * speed**2 + 9.81) - load  # by the rod on the ram
    rod = (complex(pivot.real, wrist) - rod_pin) / ROD
    thrust = upwards / rod.imag * -1.0  # pressure in the rod, away from the lever if positive
    arm, force = rod_pin - pivot, -thrust * -rod
    moment = (arm.conjugate() * force).imag
    unit = (pin - link_pin) / LINK
    lever = ((link_pin - pivot).conjugate() * unit).imag
    return abs(moment / lever), abs(thrust * rod.real)


@pytest.fixture(scope="module")
def of_ideal_pins():
    """Return the tutorial's run."""
    guide = {"friction": "coulomb", "mu_kinetic": 0.08}
    scene = Scene.load(SCENE, ["joints.drag_pins=ideal"]).replace({"guide": guide})
    result = simulate(scene)
    assert result.completed, result.info["reason"]
    return result


def test_at_the_largest_load_pins_bear_it_and_the_inertia(of_ideal_pins):
    run = of_ideal_pins
    at = int(run["load_drawing_force"].argmax())
    load = run["load_drawing_force"][at]
    assert load == pytest.approx(4e5, rel=1e-3)
    link, side = by_hand(run["crank_angle"][at], run["crank_speed"][at], load)
    forces = {
        name: np.linalg.norm(run[f"{name}_force"][at])
        for name in ("crank_pin", "link_pin", "wrist_pin")
    }
    assert forces["crank_pin"] == pytest.approx(link, rel=0.05)
    assert forces["link_pin"] == pytest.approx(link, rel=0.05)
    assert forces["wrist_pin"] == pytest.approx(load - RAM * 9.81, rel=0.01)
    # the pin's friction turns the rod, which the guide and the rod's other pin hold
    couple = 0.1 * run.scene.joints["wrist_pin"].radius * forces["wrist_pin"]
    assert abs(run["guide_force"][at]) == pytest.approx(side + couple / ROD, rel=0.02)


def test_the_ideal_guide_rubs_with_its_force(of_ideal_pins):
    run = of_ideal_pins
    expected = np.trapezoid(0.08 * np.abs(run["guide_force"] * run["slider_velocity"]), run.time)
    assert run.quantity("guides.ram.dissipated").value == pytest.approx(expected, rel=1e-2)


@pytest.mark.long
def test_the_rod_of_its_step_file_fits(tmp_path):
    """As the scene has it in comments: the pins lie in the bores, the mass is the rod's."""
    pytest.importorskip("ngsolve")
    from exu_press.model.placement import placed_parts

    lines = SCENE.read_text().replace('"six_bar_rod.step"', f'"{SCENE.parent}/six_bar_rod.step"')
    start = lines.index("# [bodies.rod]")
    own = lines[:start] + lines[start:].replace("# ", "")
    (tmp_path / "own.toml").write_text(own)
    scene = Scene.load(tmp_path / "own.toml")
    part = placed_parts(scene)["rod"]
    drawn = mechanism_of(scene).body("rod")
    assert part.reduced.mass == pytest.approx(drawn.mass, rel=5e-3)
    assert part.inertia == pytest.approx(drawn.inertia, rel=2e-2)
    assert np.abs(part.centre_of_mass).max() < 1e-4
