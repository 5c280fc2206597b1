"""A flexible body from matrices in its mechanism: the run of its STEP file, and what is refused."""

from pathlib import Path

import numpy as np
import pytest
from exudyn.FEM import FEMinterface

import exu_press
from exu_press import InputError, Scene, simulate
from exu_press.model.placement import placed_parts
from exu_press.scene.provenance import files_in
from fe_models import CRANK_STEEL, Axis, Interface, Part, StepFile, write_matrices
from fe_models.geometry import OpenedStepFile

pytest.importorskip("ngsolve")

from fe_models.elasticity import full_model

pytestmark = pytest.mark.usefixtures("sound_files")

ROD = Path(exu_press.__file__).parent / "scenes" / "six_bar_rod.step"
ANSYS = Path(__file__).parent / "ansys_rotor"
PINS = {"rod_pin": (0.015, 0.232), "wrist_pin": (0.043, -0.595)}
MESH = 0.1


def scene(body, **keys):
    wrist = {"kind": "lubricated", "clearance": 5e-5, "radius": 0.035}
    return Scene(
        mechanism="six_bar",
        speed_rpm=60.0,
        joints={"wrist_pin": wrist},
        film={"length": 0.1, "viscosity": 0.4},
        bodies={"rod": {"modes": 6, **body}},
        revolutions=0.01,
        **keys,
    )


@pytest.fixture(scope="module")
def matrices(tmp_path_factory):
    """Write the matrices of the six-bar press's rod, in mm, with its bores as node sets."""
    path = tmp_path_factory.mktemp("matrices") / "rod.toml"
    axes = {name: Axis(position, hole=True) for name, position in PINS.items()}
    step = OpenedStepFile(StepFile(ROD, 1e-3, axes=axes))
    model = full_model(Part("rod", step, CRANK_STEEL, tuple(map(Interface, PINS)), MESH))
    sets = {
        name: (face.nodes, face.rows[[0]].toarray()[0, 0::3][face.nodes].clip(0.0))
        for name, face in model.faces.items()
    }
    units = {"length": "mm", "mass": "t", "force": "N"}
    stiffness, mass = 1e-3 * model.stiffness, 1e-3 * model.mass
    write_matrices(path, 1e3 * model.nodes, stiffness, mass, sets, units=units)
    return str(path)


@pytest.mark.validation(
    "independent",
    "six-bar press with a rod from matrices",
    "its rod from a STEP file, with integrals over faces in place of sums over nodes",
    "this package's",
    "Both have the mesh and the elements of NGSolve.",
)
def test_matrices_of_ngsolve_give_the_run_of_the_step_file(matrices, compare):
    from_step = simulate(scene({"flexible": str(ROD), "mesh_size": MESH}))
    result = simulate(scene({"matrices": matrices}))
    for channel in ("slider_position", "slider_acceleration", "rod_elongation"):
        expected = np.interp(result.time, from_step.time, from_step[channel])
        name, scale = f"{channel.replace('_', ' ')}, over the largest", abs(expected).max()
        compare(name, expected, result[channel], error=None, rel=1e-4, scale=scale)
    for name in ("joints.wrist_pin.peak_force", "joints.rod_pin.peak_force"):
        expected = from_step.quantity(name).value
        compare(name, expected, result.quantity(name).value, error=None, rel=1e-4, unit="N")
    assert not [name for name in result.channels if "stress" in name]
    assert result.info["versions"]["ngsolve"]


@pytest.mark.validation(
    "code",
    "natural frequency of a free rotor, from files that Ansys exported",
    "Exudyn (jgerstmayr/EXUDYN e44aca1b, TestModels/compareAbaqusAnsysRotorEigenfrequencies.py)",
    "BSD-3-Clause",
)
def test_an_export_of_ansys_runs(compare, tmp_path):
    """Half of each matrix is in the solver's order of nodes; numbers of nodes have commas."""
    files = {name: str(ANSYS / f"{name}.txt") for name in ("nodes", "stiffness", "mass", "order")}
    fem = FEMinterface()
    fem.ReadNodalCoordinatesFromAnsys(files["nodes"])
    fem.ReadStiffnessMatrixFromAnsys(files["stiffness"], files["order"])
    fem.ReadMassMatrixFromAnsys(files["mass"], files["order"])
    nodes = fem.GetNodePositionsAsArray()
    _, y, z = nodes.T
    ends, pin = (z < 1e-6) | (z > 0.5 - 1e-6), (y > 0.04) & (z > 0.09) & (z < 0.16)
    sets = {"shaft": np.flatnonzero(ends), "crank_pin": np.flatnonzero(pin)}
    units = {"length": "m", "mass": "kg", "force": "N"}
    path, matrices = tmp_path / "rotor.toml", (fem.GetStiffnessMatrix(), fem.GetMassMatrix())
    write_matrices(path, nodes, *matrices, sets, units=units)
    crank = {"matrices": str(path), "modes": 8, "method": "free"}
    size = {"crank_radius": 0.104, "rod_length": 0.8}
    rotor = Scene(
        mechanism="slider_crank", slider_crank=size, bodies={"crank": crank}, revolutions=0.1
    )
    reduced = placed_parts(rotor)["crank"].reduced
    compare("frequency", 104.63701055, reduced.frequencies[0], error=None, rel=1e-9, unit="Hz")
    assert reduced.mass == pytest.approx(77.966, abs=1e-3)  # of 7850 kg/m^3
    assert simulate(rotor).completed


def test_a_set_lies_within_its_pin(matrices):
    body = {"matrices": matrices, "origin": (0.03, 0.0), "angle_deg": 0.0}
    placed = placed_parts(scene(body))["rod"]
    assert placed.reduced.interface("wrist_pin").centre[:2] == pytest.approx(
        PINS["wrist_pin"], rel=1e-4
    )
    message = (
        r"bodies.rod: the centre of node set 'wrist_pin' of '.*rod.toml' lies 30 mm from "
        r"joints.wrist_pin.* allowed is 25 mm, the radius of its pin"
    )
    with pytest.raises(InputError, match=message):
        placed_parts(scene(body).replace({"joints.wrist_pin.radius": 0.025}))


@pytest.mark.parametrize(
    ("face", "message"),
    [
        ("top", "no node set 'top'; interfaces are 'rod_pin', 'wrist_pin'"),
        ({"radius": 0.035}, "allowed is the name of a node set for each"),
    ],
)
def test_faces_that_are_no_sets_are_refused(matrices, face, message):
    with pytest.raises(InputError, match=message):
        placed_parts(scene({"matrices": matrices, "faces": {"wrist_pin": face}}))


def test_every_file_that_goes_in_is_recorded(matrices):
    files = set(files_in(scene({"matrices": matrices}).to_dict()))
    assert files == {str(file) for file in Path(matrices).parent.glob("rod*")}


def test_a_scene_file_has_the_path_from_its_own_folder(matrices, tmp_path):
    saved = tmp_path / "scene.toml"
    scene({"matrices": matrices}).save(saved)
    assert Path(Scene.load(saved).bodies["rod"].matrices).resolve() == Path(matrices).resolve()
    assert 'matrices = "..' in saved.read_text()


def test_a_body_in_a_wrong_unit_is_refused(matrices, tmp_path):
    """A rod of 0.9 m, in a file that says it were 0.9 km long."""
    for file in Path(matrices).parent.glob("rod*"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    copy = tmp_path / "rod.toml"
    copy.write_text(copy.read_text().replace('length = "mm"', 'length = "m"'))
    with pytest.raises(InputError, match=r"up to \d+ m apart.* is units.length right\?"):
        placed_parts(scene({"matrices": str(copy)}))
