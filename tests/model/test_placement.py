"""Solids in their places: STEP files, the faces that joints hold, and what is refused."""

import math

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.model.placement import placed_parts
from exu_press.scene import mechanism_of

pytest.importorskip("ngsolve")

from netgen.occ import Axis, Box, Cylinder, Pnt, Vec, Z

pytestmark = pytest.mark.usefixtures("sound_files")

ROD_PIN, WRIST_PIN = (0.015, 0.232), (0.043, -0.595)  # of the six-bar press's rod
LENGTH = 1e3 * math.dist(ROD_PIN, WRIST_PIN)  # mm
ALONG = math.degrees(math.atan2(WRIST_PIN[1] - ROD_PIN[1], WRIST_PIN[0] - ROD_PIN[0]))
PLACED = {"origin": ROD_PIN, "angle_deg": ALONG, "mesh_size": 0.05, "modes": 6}


def bar(length=LENGTH, boss=0.0):
    """Return a bar from the origin along x with a hole at each end, in mm."""
    solid = Box(Pnt(-40, -30, -15), Pnt(length + 40, 30, 15))
    for x in (0.0, length):
        if boss:
            solid += Cylinder(Pnt(x, 0, -25), Z, r=boss, h=50)
        solid -= Cylinder(Pnt(x, 0, -30), Z, r=20, h=60)
    return solid


@pytest.fixture
def rod(tmp_path):
    """Return a function that writes a solid and returns the scene with it as the rod."""

    def scene(solid, **keys):
        path = tmp_path / "rod.step"
        solid.WriteStep(str(path))
        body = {"flexible": str(path), **PLACED, **keys}
        return Scene(mechanism="six_bar", joints={}, bodies={"rod": body}, revolutions=0.02)

    return scene


def placed(scene):
    return placed_parts(scene)["rod"]


def test_a_step_file_lies_where_it_is_put(rod):
    part = placed(rod(bar()))
    volume = ((LENGTH + 80) * 60 * 30 - 2 * math.pi * 20**2 * 30) * 1e-9
    assert part.reduced.mass == pytest.approx(7850 * volume, rel=1e-6)
    for joint, place in {"rod_pin": (0.0, 0.0), "wrist_pin": (1e-3 * LENGTH, 0.0)}.items():
        (face,) = part.faces[joint]
        assert part.reduced.interface(face).axis[:2] == pytest.approx(place, abs=1e-9)
    assert part.centre_of_mass == pytest.approx((0.0, 0.0), abs=1e-4)


def test_half_a_bore_has_its_axis_too(rod):
    """The centroid of its face lies beside it."""
    solid = bar() - Box(Pnt(-100, -100, -100), Pnt(0, 100, 100))
    interface = placed(rod(solid)).reduced.interface("rod_pin")
    assert np.abs(interface.axis[:2]).max() < 1e-9
    assert interface.centre[0] == pytest.approx(0.02 * 2 / math.pi, rel=1e-3)


def test_of_a_boss_and_its_bore_the_bearing_takes_the_bore(rod):
    """The rod carries the bearings of both its pins."""
    part = placed(rod(bar(boss=35.0)))
    assert part.reduced.interface("wrist_pin").arm == pytest.approx(0.025, rel=1e-3)  # its length
    assert part.reduced.interface("wrist_pin").area == pytest.approx(
        2 * math.pi * 0.02 * 0.05, rel=1e-3
    )


def test_a_forked_rod_holds_its_pin_by_both_eyes(rod):
    """The pin of the ram, which the guide lets go up and down, bears weight and inertia."""
    fork = bar() - Box(Pnt(LENGTH - 30, -50, -5), Pnt(LENGTH + 50, 50, 5))
    eyes = [{"z": [-0.016, -0.004]}, {"z": [0.004, 0.016]}]
    result = simulate(rod(fork, faces={"wrist_pin": eyes}))
    assert result.completed
    mass = mechanism_of(result.scene).body("ram").mass
    lifted = mass * (9.81 + result["slider_acceleration"])
    settled = result.time > 0.5 * result.time[-1]
    force = result["wrist_pin_force"][:, 1]
    assert force[settled] == pytest.approx(lifted[settled], rel=1e-3)


@pytest.mark.parametrize(
    ("solid", "keys", "message"),
    [
        (bar(LENGTH + 5.0), {}, r"no cylinder along z lies about wrist_pin, .* 5 mm away"),
        (Box(Pnt(0, 0, 0), Pnt(9, 9, 9)), {}, r"no cylinder.*it has none at all"),
        (
            bar(),
            {"faces": {"rod_pin": {"radius": 0.03}}},
            r"of radius 0\.03 m lies about rod_pin, .*; there are radius = 0\.02, z = \[-0\.015, ",
        ),
        (bar(), {"faces": {"rod_pin": "bore"}}, r"has no face named 'bore'"),
        (
            bar(),
            {"faces": {"rod_pin": "bore", "wrist_pin": "bore"}},
            r"joints\.rod_pin and joints\.wrist_pin hold the same face 'bore'",
        ),
        (
            bar() - Cylinder(Pnt(0, 0, 5), Z, r=25, h=20),
            {},
            r"2 round faces lie about rod_pin: radius = 0\.02, z = .*; radius = 0\.025, z = .* Say",
        ),
    ],
)
def test_what_does_not_fit_is_refused_in_one_line(rod, solid, keys, message):
    with pytest.raises(InputError, match=message) as refused:
        placed(rod(solid, **keys))
    assert "\n" not in str(refused.value)
    assert str(refused.value).startswith("bodies.rod: ")


def test_a_step_file_that_is_not_there_is_refused(tmp_path):
    body = {"flexible": str(tmp_path / "rod.step"), **PLACED}
    scene = Scene(mechanism="six_bar", bodies={"rod": body})
    scene.save(tmp_path / "scene.toml")
    changed = Scene.load(tmp_path / "scene.toml", ["revolutions=0.5"])
    for asked, beginning in ((scene, ""), (changed, r".*scene\.toml: ")):
        message = rf"^{beginning}bodies\.rod: STEP file .*cannot be read \(No such file"
        with pytest.raises(InputError, match=message):
            placed(asked)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"press.linkage_length": 0.4}, r"bodies\.linkage: face 'big bore' .* lies 8\.5 mm from"),
        ({"bodies.linkage": "wheel"}, r"bodies\.linkage: 'wheel': there is no such flexible part"),
        ({"bodies.linkage": "crank"}, r"'crank' has no face for slide_pin; allowed as faces"),
    ],
)
def test_shipped_parts_that_do_not_fit_are_refused(change, message):
    scene = Scene(bodies={"linkage": {"flexible": "linkage", "modes": 0}}).replace(change)
    with pytest.raises(InputError, match=message):
        placed_parts(scene)


def test_two_joints_in_one_place_cannot_hold_one_face(tmp_path):
    """Both knuckle joints of a link 5: its links share the bore, and no face tells them apart."""
    mechanism = mechanism_of(Scene())
    joints = {joint.name: 1e3 * np.array(joint.at) for joint in mechanism.joints}
    (x, y), (end_x, end_y) = joints["slide_joint_right"], joints["knuckle_6_right"]
    turn = math.degrees(math.atan2(end_y - y, end_x - x))
    solid = bar(math.dist((x, y), (end_x, end_y)))
    path = tmp_path / "link.step"
    solid.Rotate(Axis(Pnt(0, 0, 0), Z), turn).Move(Vec(x, y, 0)).WriteStep(str(path))
    scene = Scene(bodies={"link_5_right": {"flexible": str(path), "mesh_size": 0.1}})
    with pytest.raises(InputError, match=r"knuckle_6_right and knuckle_7_right hold the same face"):
        placed_parts(scene)
