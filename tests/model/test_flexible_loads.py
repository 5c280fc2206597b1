"""Loads on flexible bodies: statics against a beam and all finite elements, work, stiff limit."""

from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from independent.solid import displaced
from pressed import static_modes

from exu_press import Scene, simulate
from exu_press.model import build
from exu_press.scene import mechanism_of

pytest.importorskip("ngsolve")

from netgen.occ import Box, Cylinder, Pnt, Z

from fe_models import CRANK_STEEL, Axis, Interface, Part, Patch, StepFile
from fe_models.elasticity import full_model

pytestmark = pytest.mark.usefixtures("sound_files")

LENGTH, OVERHANG, SIDE = 0.3, 0.2, 0.016  # m, of the rocker
AT, MESH, FORCE = 0.36, 0.06, 10.0
FLEXURAL = 2.1e11 * SIDE**4 / 12.0  # N m^2
TIP = {"y": [0.499, 0.501]}
CONSTANT = {"kind": "table", "time": [0.0, 1.0], "force": [FORCE, FORCE], "direction": [1.0, 0.0]}


@pytest.fixture(scope="module")
def rocker(tmp_path_factory):
    """A four-bar's dictionary with an upright rocker, and a bar that goes on beyond its knuckle."""
    path = tmp_path_factory.mktemp("rocker") / "rocker.step"
    half = 500.0 * SIDE
    solid = Box(Pnt(360 - half, -15, -half), Pnt(360 + half, 500, half))
    for y in (0.0, 300.0):
        solid += Cylinder(Pnt(360, y, -half), Z, r=1.5 * half, h=2 * half)
    for y in (0.0, 300.0):
        solid -= Cylinder(Pnt(360, y, -2 * half), Z, r=0.8 * half, h=4 * half)
    solid.WriteStep(str(path))
    data = Scene(mechanism=mechanism_of(Scene(mechanism="four_bar"))).to_dict()["mechanism"]
    data["joints"]["pivot"]["at"] = [AT, 0.0]
    data["bodies"]["rocker"]["centre_of_mass"] = [AT, 0.15]
    return data, str(path)


def scene(rocker, load, **keys):
    data, path = rocker
    bores = {joint: {"radius": 0.4 * SIDE} for joint in ("knuckle", "pivot")}
    body = {"flexible": path, "mesh_size": MESH, "modes": 8, "faces": bores}
    body |= keys.pop("body", {})
    load = {name: {"body": "rocker", **one} for name, one in load.items()}
    bodies = {"rocker": body}
    return Scene(**{"mechanism": data, "joints": {}, "bodies": bodies, "load": load, **keys})


def bent(rocker, **keys):
    """Return how far the tip of the loaded rocker at rest lies beside the line of its joints, m."""
    load = {**CONSTANT, "face": TIP, **keys}
    asked = scene(rocker, {"one": load}, gravity=0.0, speed_rpm=1e-3)
    model = build(asked)
    modes = static_modes(model, "rocker")
    part, body = model.parts["rocker"], model.mechanism.body("rocker")
    top = body.local((AT, LENGTH + OVERHANG))
    moved = {"tip": part.carried_point(part.loads["one"], top)[1] @ modes}
    for joint, y in {"pivot": 0.0, "knuckle": LENGTH}.items():
        moved[joint] = part.carried_point(part.faces[joint], body.local((AT, y)))[1] @ modes
    model.SC.Reset()
    return beside({name: vector[0] for name, vector in moved.items()})


def beside(moved):
    return (
        moved["tip"]
        - moved["pivot"]
        - (1 + OVERHANG / LENGTH) * (moved["knuckle"] - moved["pivot"])
    )


@pytest.fixture(scope="module")
def deflection(rocker):
    return bent(rocker)


@pytest.mark.long
def test_the_tip_bends_as_all_finite_elements_and_as_a_beam(rocker, deflection):
    bores = {"pivot": 0.0, "knuckle": LENGTH}
    ends = {name: Axis((AT, y), radius=0.4 * SIDE) for name, y in bores.items()}
    tip = Patch(box=((-np.inf, TIP["y"][0], -np.inf), (np.inf, TIP["y"][1], np.inf)))
    solid = StepFile(Path(rocker[1]), 1e-3, axes=ends, patches={"tip": (tip,)})
    interfaces = tuple(Interface(name) for name in ("pivot", "knuckle", "tip"))
    model = full_model(Part("rocker", solid, CRANK_STEEL, interfaces, MESH))
    coupler = sp.csr_matrix([[0.36, 0.2, 0.0, 0.0, 0.0, 0.0]])  # whose direction it holds
    rows = sp.vstack([model.faces["pivot"].rows[:5], coupler @ model.faces["knuckle"].rows])
    force = model.faces["tip"].rows[:3].T @ np.array([FORCE, 0.0, 0.0])
    found = displaced(model.stiffness, rows, force)
    direct = {name: (face.rows @ found)[0] for name, face in model.faces.items()}
    assert deflection == pytest.approx(beside(direct), rel=1e-4)
    euler = FORCE * OVERHANG**2 * (LENGTH + OVERHANG) / (3.0 * FLEXURAL)
    assert deflection == pytest.approx(euler, rel=0.05)


def test_a_point_beside_the_face_adds_a_couple(rocker, deflection):
    """50 mm further out, M b (l + 3 b/2) / 3 EI more with the couple M and the overhang b."""
    arm = 0.05
    more = bent(rocker, offset=[0.0, LENGTH / 2 + OVERHANG + arm]) - deflection
    euler = FORCE * arm * OVERHANG * (LENGTH + 1.5 * OVERHANG) / (3.0 * FLEXURAL)
    assert more == pytest.approx(euler, rel=0.05)


RAMP = {"kind": "table", "crank_angle_deg": [10, 25, 40], "force": [0.0, 2e3, 0.0],
        "direction": [1.0, 0.4]}  # fmt: skip


def point_of(asked):
    model = build(asked)
    point = model.loads["one"].applied.point
    model.SC.Reset()
    return point


def test_the_balance_closes_only_with_the_bodys_own_motion(rocker):
    """A soft rocker: the tip's vibration does work that the mean motion's does not."""
    soft = {"youngs_modulus": 2e10}
    load = {**RAMP, "force": [0.0, 200.0, 0.0], "face": TIP}
    asked = scene(rocker, {"one": load}, body=soft, revolutions=0.15, speed_rpm=200.0)
    result = simulate(asked.replace({"solver.tolerance": 5e-4}))
    assert result.completed
    assert result.quantity("energy.residual").value < 2e-3
    motion = result["body_position"][:, result.bodies.index("rocker")]
    x, y = point_of(asked)
    c, s = np.cos(motion[:, 2]), np.sin(motion[:, 2])
    place = motion[:, :2] + np.column_stack([c * x - s * y, s * x + c * y])
    along = np.gradient(place @ np.array([1.0, 0.4]) / np.hypot(1.0, 0.4), result.time)
    of_mean_motion = np.trapezoid(result["load_one_force"] * along, result.time)
    assert (
        abs(of_mean_motion - result["load_one_work"][-1])
        > 0.01 * abs(result["load_one_work"]).max()
    )


@pytest.mark.long
def test_over_the_height_that_of_the_flexible_output_counts(rocker):
    """Its frame lies in the origin of the file, 0.39 m away: the balance would not close."""
    spring = {"kind": "table", "height": [0.0, 1.0], "force": [1e3, -1e3], "acts": "both"}
    load = {"spring": {**spring, "direction": [1.0, 0.0], "face": TIP}}
    result = simulate(scene(rocker, load, revolutions=0.04, speed_rpm=100.0))
    assert result.completed
    assert np.ptp(result["load_spring_force"]) > 10.0
    assert result.quantity("energy.residual").value < 2e-3
