"""Static deflection of the assembled press against the same solids, solved directly by NGSolve."""

import numpy as np
import pytest
import scipy.sparse as sp
from exudyn.itemInterface import LoadForceVector, MarkerBodyRigid
from independent.solid import displaced

from exu_press import Scene
from exu_press.mechanism.parts import DRIVE
from exu_press.model import build
from exu_press.model.placement import placed_parts
from exu_press.model.start import quasi_static_motion
from exu_press.result.flexible import deflection
from exu_press.scene import flexible_press

pytest.importorskip("ngsolve")

from fe_models import shipped_part
from fe_models.elasticity import full_model

MESH, ANGLE, FORCE = 0.1, 150.0, 1e3  # m, deg, N


def solved(model, held, loads):
    """Return mean motions (6,) of every face under loads on faces, the held motions zero.

    Args:
        model: NGSolve's stiffness over all nodes.
        held: face -> numbers of its six mean motions that are held.
        loads: face -> force, N.
    """
    rows = sp.vstack([model.faces[face].rows[numbers] for face, numbers in held.items()])
    force = sum(model.faces[face].rows[:3].T @ np.array(load) for face, load in loads.items())
    moved = displaced(model.stiffness, rows, force)
    return {name: face.rows @ moved for name, face in model.faces.items()}


BEARINGS = {"journal A": [0, 1, 2], "journal B": [0, 1], "flange": [5]}


@pytest.fixture(scope="module")
def crank_model():
    return full_model(shipped_part("crank", MESH))


def pin_moves(model, force):
    return solved(model, BEARINGS, {"pin": (*force, 0.0)})["pin"][:2]


@pytest.mark.parametrize("force", [(1e4, 0.0), (0.0, 1e4)])
def test_pin_deflection_is_that_of_the_solid(crank_model, force):
    """Across the throw and along it; by modes, of a crank in its bearings, turned at its flange."""
    placed = placed_parts(Scene(bodies={"crank": {"flexible": "crank", "mesh_size": MESH}}))
    part = placed["crank"].reduced
    at_pin, bearing, other, flange = (
        (face.translation, face.rotation, face.centre)
        for face in map(part.interface, ("pin", "journal A", "journal B", "flange"))
    )

    def by_all(face):
        """Return translation and rotation of a face by modes and six rigid motions."""
        translation, rotation, (x, y, z) = face
        lever = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
        return (
            np.hstack([translation, np.eye(3), lever]),
            np.hstack([rotation, np.zeros((3, 3)), np.eye(3)]),
        )

    held = np.vstack([by_all(bearing)[0], by_all(other)[0][:2], by_all(flange)[1][2:]])
    modes = part.mode_count
    matrix = np.zeros((modes + 12, modes + 12))
    matrix[:modes, :modes] = part.stiffness_matrix
    matrix[modes + 6 :, : modes + 6] = held
    matrix[: modes + 6, modes + 6 :] = held.T
    load = np.zeros(modes + 12)
    load[: modes + 6] = by_all(at_pin)[0][:2].T @ force
    q = np.linalg.solve(matrix, load)[:modes]
    moved = deflection(placed["crank"], "crank_pin", "shaft") @ q
    assert moved == pytest.approx(pin_moves(crank_model, force), rel=1e-4, abs=1e-9)


@pytest.mark.long
def test_a_force_at_the_slider_moves_it_as_the_solids_give_way(crank_model):
    scene = Scene(
        joints={}, bodies=flexible_press(mesh_size=MESH), gravity=0.0,
        start_angle_deg=ANGLE, speed_rpm=1e-3,
    )  # fmt: skip
    model = build(scene)
    mbs, slider = model.mbs, model.nodes["slider"]
    marker = mbs.AddMarker(MarkerBodyRigid(bodyNumber=model.bodies["slider"]))
    mbs.AddLoad(LoadForceVector(markerNumber=marker, loadVector=[0.0, FORCE, 0.0]))
    mbs.Assemble()
    drive = mbs.GetNodeODE2Index(model.nodes[DRIVE]) + model.rigid[DRIVE].coordinates.index("angle")
    q, _ = quasi_static_motion(mbs, model.forces["drive", "force"], drive, scene.angular_speed)
    moved = float(q[mbs.GetNodeODE2Index(slider) + model.rigid["slider"].coordinates.index("y")])

    mechanism, crank_angle = model.mechanism, np.radians(ANGLE)
    motion = mechanism.motion(np.array([crank_angle]), 1.0)
    ratio = motion["slider"].velocity[0, 1] / motion["slide"].velocity[0, 1]
    pin = 0.03 * np.array([-np.sin(crank_angle), np.cos(crank_angle)])
    along = motion["slide"].position[0, :2] - pin
    along /= np.linalg.norm(along)
    pull = ratio * FORCE / along[1]  # in the linkage; the slide's guide takes what is across
    c, s = np.cos(crank_angle), np.sin(crank_angle)
    turn = np.array([[c, -s], [s, c]])
    given_way = turn @ pin_moves(crank_model, turn.T @ (pull * along))
    linkage = full_model(shipped_part("linkage", MESH))
    held = {"big bore": [0, 1, 2, 3, 4, 5]}
    bores = solved(linkage, held, {"big bore": (-pull, 0, 0), "small bore": (pull, 0, 0)})
    slide = (bores["small bore"][0] + along @ given_way) / along[1]
    assert moved == pytest.approx(ratio * slide, rel=1e-4)
