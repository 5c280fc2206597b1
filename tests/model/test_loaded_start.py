"""Journals start where the loads of the ideal motion press them, or in the middle."""

from dataclasses import replace

import numpy as np
import pytest
from coarse_parts import COARSE

from exu_press import Scene, simulate
from exu_press.mechanism import shipped_mechanism
from exu_press.mechanism.springs import LinearSpring

PIN = {"radius": 0.02, "clearance": 2e-5, "contact": {"length": 0.02}}
BALANCE = LinearSpring("balance", ("frame", "ram"), ((0.3, -1.2), (0.1, -0.5)), 1e4, preload=3e3)
FOUR_BAR = {"mechanism": "four_bar", "speed_rpm": 200.0}
ECCENTRIC = {"mechanism": "eccentric_press", "joints": {"pins": "dry", "balls": "dry"}}
SCENES = {
    "slider-crank": {"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}},
    "three pins": {
        **FOUR_BAR,
        "joints": {name: {"kind": "dry", **PIN} for name in ("crank_pin", "knuckle", "pivot")},
    },
    "a motor": {**ECCENTRIC, "drive": {"rated_torque": 400.0, "inertia": 50.0}},
    "a load": {
        **ECCENTRIC,
        "load": {"f": {"kind": "table", "time": [0.0, 1.0], "force": [5e4, 5e4]}},
    },
    "elastic guides": {**ECCENTRIC, "guide": {"lateral_stiffness": 1e9}},
    "a spring": {
        "mechanism": replace(shipped_mechanism("cycloidal_press"), springs=(BALANCE,)),
        "joints": {name: {"kind": "dry", **PIN} for name in ("rod_pin", "wrist_pin")},
    },
    "a film": {"mechanism": "slider_crank"},
    "a contact on a line": {
        "mechanism": "elliptic_trammel",
        "speed_rpm": 180.0,
        "joints": {"crank_pin": {"kind": "dry", **PIN, "clearance": 2e-4}},
        "friction": {"mu_kinetic": 0.01},
    },
    "a mixed film": {
        "mechanism": "slider_crank",
        "film": {"at_contact": "mixed", "viscosity": 0.01},
    },
}


def at_angle(given, **more):
    return Scene(**{"start_angle_deg": 40.0, "revolutions": 0.02, **given, **more})


def ideal(scene):
    changes = {f"joints.{name}": "ideal" for name in scene.joints.with_clearance}
    return simulate(scene.replace({**changes, "guide": None, "drive": None}))


@pytest.mark.parametrize("name", SCENES)
def test_joints_begin_with_the_force_of_the_ideal_motion(name):
    scene = at_angle(SCENES[name])
    expected = ideal(scene)
    assert scene.start == "loaded"
    loaded = simulate(scene)
    for joint in scene.joints.with_clearance:
        force = loaded[f"{joint}_force"]
        wanted = expected[f"{joint}_force"][0, :2]
        size = np.linalg.norm(wanted)
        assert np.linalg.norm(force[0, :2] - wanted) < 0.02 * size, joint
        peak = np.linalg.norm(force, axis=1).max()
        assert peak < 1.3 * np.linalg.norm(expected[f"{joint}_force"], axis=1).max(), "no fall"


def test_a_journal_lies_at_its_static_penetration():
    """At rest: weight of rod and slider on the pin of a slider-crank at its top dead centre."""
    scene = Scene(
        mechanism="slider_crank",
        joints={"crank_pin": "dry"},
        speed_rpm=0.01,
        revolutions=1e-6,
        contact={"shape": "point", "stiffness": 2.5545e10},
        friction={"law": "none"},
    )
    result = simulate(scene)
    depth = ((184.5 + 1347.0) * 9.81 / 2.5545e10) ** (2.0 / 3.0)
    lower = result["slider_position"][0] - scene.slider_crank.crank_radius
    assert lower == pytest.approx(-scene.slider_crank.rod_length - 1e-4 - depth, abs=1e-9)


@pytest.mark.parametrize(
    ("kind", "angle", "flexible"),
    [("dry", 0.0, False), ("lubricated", 90.0, False), ("dry", 180.0, True)],
)
def test_the_press_of_the_paper_starts_loaded_at_any_angle(kind, angle, flexible):
    """Its contact's damper of 2.6e8 N s/m tells of every error of the start's rates."""
    joints = {"crank_pin": kind, **({"balls": "dry"} if kind == "dry" else {})}
    scene = Scene(
        joints=joints,
        bodies=COARSE if flexible else {},
        start="loaded",
        start_angle_deg=angle,
        revolutions=0.01,
    )
    wanted = ideal(scene.replace({"bodies": {}}))["crank_pin_force"][0, :2]
    result = simulate(scene)
    assert result.completed
    begun = result["crank_pin_force"][:, :2]
    assert np.linalg.norm(begun[0] - wanted) < 0.03 * np.linalg.norm(wanted)
    assert np.linalg.norm(begun, axis=1).max() < 1.2 * np.linalg.norm(wanted)


@pytest.mark.parametrize(("angle", "flexible"), [(0.0, True), (180.0, False)])
def test_a_strong_film_starts_with_its_force_and_rings_in_no_constraint(angle, flexible):
    """Its damper is of 1e10 N s/m, and steps begin with 0.1 us."""
    scene = Scene(
        bodies=COARSE if flexible else {},
        start="loaded",
        start_angle_deg=angle,
        revolutions=5e-4,
        film={"law": "finite", "viscosity": 0.14, "length": 0.065},
    ).replace({"joints.crank_pin.clearance": 5e-6})
    result = simulate(scene)
    assert result.info["status"] == "completed", result.info["reason"]
    film, guide = result["crank_pin_force"][:, :2], result["slide_guide_force"]
    size = np.linalg.norm(film[0])
    assert np.linalg.norm(film[:20] - film[0], axis=1).max() < 0.1 * size
    assert np.abs(guide[:20]).max() < 0.2 * size


def test_a_film_that_a_slot_keeps_from_its_equilibrium_starts_centred():
    """Slots let the crank pin of a trammel move along a line alone, and its film has two forces."""
    film = {"law": "finite", "viscosity": 0.1, "length": 0.05, "at_contact": "mixed"}
    pin = {"kind": "lubricated", "clearance": 5e-5, "radius": 0.03, "film": film}
    scene = Scene(mechanism="elliptic_trammel", speed_rpm=180.0, joints={"crank_pin": pin})
    result = simulate(scene.replace({"start_angle_deg": 110.0, "revolutions": 0.02}))
    peak = np.linalg.norm(result["crank_pin_force"], axis=1).max()
    assert peak < 200.0, "141 N at the start with ideal joints"
    assert any("started centred" in text for text in result.summary()["warnings"])


@pytest.mark.parametrize(("angle", "pressed"), [(0.0, True), (62.1, False)])
def test_a_joint_that_changes_sides_starts_centred(angle, pressed):
    """At 63 deg the pins' forces turn round within degrees: pressed journals would be flung."""
    result = simulate(
        Scene(
            mechanism="slider_crank",
            joints={"wrist_pin": "dry", "crank_pin": "dry"},
            revolutions=0.05,
            start_angle_deg=angle,
        )
    )
    away = np.linalg.norm(result["wrist_pin_eccentricity"][0])
    clearance = result.joints["wrist_pin"].clearance
    assert away > clearance if pressed else away < 1e-6 * clearance
    assert any("started centred" in text for text in result.summary()["warnings"]) is not pressed
    if not pressed:
        assert np.abs(result["slider_acceleration"]).max() < 50.0
