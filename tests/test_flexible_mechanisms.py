"""Any link of a mechanism is flexible: what drives, holds and joins it follows from its joints."""

import math
from itertools import pairwise

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

pytest.importorskip("ngsolve")

from netgen.occ import Axis, Box, Cylinder, Pnt, Vec, Z

pytestmark = pytest.mark.usefixtures("sound_files")

RADIUS = 12.0  # mm, of pins and bores
KEYS = {"mesh_size": 0.1, "modes": 3}


def bar(ends, pins=()):
    """Return a bar between two or more joints, in the drawing's coordinates, mm; some have pins."""
    places = [(1e3 * x, 1e3 * y) for x, y in ends]
    solid = None
    for (x, y), (end_x, end_y) in pairwise(places):
        length = math.hypot(end_x - x, end_y - y)
        turn = math.degrees(math.atan2(end_y - y, end_x - x))
        piece = Box(Pnt(-20, -20, -10), Pnt(length + 20, 20, 10))
        piece = piece.Rotate(Axis(Pnt(0, 0, 0), Z), turn).Move(Vec(x, y, 0))
        solid = piece if solid is None else solid + piece
    for number, (x, y) in enumerate(places):
        if number in pins:
            solid += Cylinder(Pnt(x, y, 10), Z, r=RADIUS, h=30)
        else:
            solid -= Cylinder(Pnt(x, y, -30), Z, r=RADIUS, h=60)
    return solid


@pytest.fixture(scope="module")
def links(tmp_path_factory):
    """STEP files of the three links of the shipped four-bar; the crank with a pin."""
    folder = tmp_path_factory.mktemp("links")
    mechanism = mechanism_of(Scene(mechanism="four_bar"))
    files = {}
    for body in mechanism.bodies:
        joints = mechanism.joints_of(body.name)
        pins = [i for i, j in enumerate(joints) if body.name == "crank" and not j.on_frame]
        files[body.name] = str(folder / f"{body.name}.step")
        bar([joint.at for joint in joints], pins).WriteStep(files[body.name])
    return files


def scene(links, names, **keys):
    bodies = {name: {"flexible": links[name], **KEYS} for name in names}
    return Scene(**{"mechanism": "four_bar", "joints": {}, "bodies": bodies, **keys})


def test_ideal_links_bend_and_do_not_ring(links):
    """They move as rigid ones but for microns, hold together, and start on their own motion."""
    names, solver = ("crank", "coupler", "rocker"), {"tolerance": 1e-4}
    result = simulate(scene(links, names, revolutions=0.05, speed_rpm=200.0, solver=solver))
    assert result.completed
    summary = result.summary()
    assert summary["quantities"]["energy.residual"]["value"] < 2e-3
    ideal = mechanism_of(result.scene).ideal_slider(
        result["crank_angle"], result.scene.angular_speed
    )[0]
    away = np.abs(result["slider_position"] - ideal).max()
    assert 1e-10 < away < 1e-4
    for name in names:
        assert result[f"{name}_strain_energy"].max() > 0.0
    force = np.linalg.norm(result.joints["knuckle"].force, axis=1)
    assert np.abs(np.diff(force)).max() < 0.1 * force.max()


def test_without_modes_it_is_the_rigid_mechanism_with_the_solids_masses(links):
    """Mass, centre of mass and inertia of the solids, put into the rigid bodies."""
    solids = scene(links, ["coupler", "rocker"], revolutions=0.1, solver={"step": 1e-4})
    solids = solids.replace({f"bodies.{name}.modes": 0 for name in ("coupler", "rocker")})
    flexible = simulate(solids)
    mechanism = mechanism_of(solids)
    data = Scene(mechanism=mechanism).to_dict()
    for name, solid in flexible.info["solids"].items():
        body = mechanism.body(name)
        c, s = math.cos(body.angle), math.sin(body.angle)
        x, y = solid["centre_of_mass"]
        place = body.centre_of_mass
        data["mechanism"]["bodies"][name] |= {
            "mass": solid["mass"],
            "inertia": solid["inertia"],
            "centre_of_mass": [place[0] + c * x - s * y, place[1] + s * x + c * y],
        }
    rigid = Scene.from_dict(data).replace({"joints": {}, "revolutions": 0.1, "solver.step": 1e-4})
    other = simulate(rigid)
    settled = other.time > 0.5 * other.time[-1]  # forces alternate in the first steps
    for channel in ("drive_torque", "slider_position", "knuckle_force", "pivot_force"):
        one, two = flexible[channel][settled], other[channel][settled]
        assert np.abs(one - two).max() < 1e-5 * np.abs(two).max(), channel
