"""Bodies from matrices: the same reduction as from the solid, and what is refused."""

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp
from exudyn.FEM import FEMinterface

from fe_models import Interface, MatrixPart, Reduction, reduced_part, write_matrices
from fe_models.cache import cache_file
from fe_models.errors import InputError
from fe_models.matrix_model import matrix_model
from fe_models.reduction import reduce_model

SI = {"length": "m", "mass": "kg", "force": "N"}
ENDS = (Interface("left"), Interface("right"))


@pytest.fixture
def sets(bar_model):
    """Return the nodes of both ends with their shares of the areas, which are 0 at corners."""
    return {
        name: (face.nodes, face.rows[[0]].toarray()[0, 0::3][face.nodes].clip(0.0))
        for name, face in bar_model.faces.items()
    }


@pytest.fixture
def bar_files(bar_model, sets, tmp_path):
    """Write the bar's matrices, changed as asked for; return their description."""

    def write(nodes=bar_model.nodes, stiffness=bar_model.stiffness, mass=bar_model.mass, **keys):
        path = tmp_path / "bar.toml"
        write_matrices(path, nodes, stiffness, mass, sets, **{"units": SI, **keys})
        return path

    return write


@pytest.mark.parametrize(
    ("units", "length", "force", "mass"),
    [
        (SI, 1.0, 1.0, 1.0),
        ({"length": "mm", "mass": "t", "force": "N"}, 1e-3, 1.0, 1e3),
        ({"length": "in", "mass": "lb", "force": "lbf"}, 0.0254, 4.4482216152605, 0.45359237),
    ],
)
def test_matrices_give_the_body_of_the_solid(bar_files, bar, bar_model, units, length, force, mass):
    path = bar_files(
        bar_model.nodes / length,
        bar_model.stiffness * (length / force),
        bar_model.mass / mass,
        units=units,
        triangles=bar_model.triangles,
    )
    solid = MatrixPart(path, ENDS)
    model = matrix_model(solid)
    # turns of the ends are sums over nodes in place of integrals over products of shape functions
    for method, tolerance in (("free", 1e-7), ("craig_bampton", 1e-4)):
        reduction = Reduction(20, method)
        reduced, exact = (reduce_model(*of, reduction) for of in ((solid, model), (bar, bar_model)))
        assert reduced.mass == pytest.approx(exact.mass, rel=1e-9)
        assert reduced.inertia == pytest.approx(exact.inertia, rel=1e-9, abs=1e-12)
        assert reduced.frequencies[:8] == pytest.approx(exact.frequencies[:8], rel=tolerance)
    assert (reduced.triangles == exact.triangles).all()


def test_a_child_reads_and_the_cache_keeps_until_a_file_changes(bar_files, bar_model, tmp_path):
    solid, cache = MatrixPart(bar_files(), ENDS), tmp_path / "cache"
    first = reduced_part(solid, Reduction(3), folder=cache)
    hull = first.nodes[first.triangles].reshape(-1, 3)
    assert np.ptp(hull, axis=0) == pytest.approx([0.3, 0.05, 0.03])
    volume = np.linalg.det(first.nodes[first.triangles]).sum() / 6.0  # outwards, all of them
    assert volume == pytest.approx(0.3 * 0.05 * 0.03)
    assert [*cache.glob("*.npz")] == [cache_file(solid, Reduction(3), cache)]
    assert reduced_part(solid, Reduction(3), folder=cache).mass == first.mass
    bar_files(mass=2.0 * bar_model.mass)
    assert not cache_file(solid, Reduction(3), cache).exists()


def held(model):
    """Return the stiffness of a bar with a spring at one node."""
    spring = np.zeros(model.unknowns)
    spring[1] = 1e-4 * model.stiffness.diagonal().max()
    return {"stiffness": model.stiffness + sp.diags_array(spring)}


def asymmetric(model):
    size = 1e-3 * model.stiffness.max()
    corner = sp.coo_array(([size], ([5], [0])), shape=model.stiffness.shape)
    return {"stiffness": model.stiffness + corner}


def without_mass(model):
    present = np.ones(model.unknowns)
    present[:3] = 0.0
    return {"mass": sp.diags_array(present) @ model.mass @ sp.diags_array(present)}


def two_bodies(model):
    """Return a bar and its copy beside it, which nothing holds together."""
    return {
        "nodes": np.vstack([model.nodes, model.nodes + 1.0]),
        "stiffness": sp.block_diag([model.stiffness] * 2),
        "mass": sp.block_diag([model.mass] * 2),
    }


def turning(model):
    """Return a mass that differs by direction, as that of rotations does."""
    factors = np.tile([1.0, 1.0, 2.0], len(model.nodes))
    return {"mass": sp.diags_array(factors) @ model.mass}


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (asymmetric, r"stiffness.mtx: is asymmetric: entries \(\d+, \d+\) and .* differ by"),
        (held, "rigid modes are missing: .* turned about z as a whole .* stiffness of the free"),
        (without_mass, "mass.mtx: is singular or not positive: no mass at some node"),
        (two_bodies, "stiffness.mtx: is singular .*more than six motions without force"),
        (turning, "mass.mtx: masses differ by direction; allowed is the mass of solid"),
        (lambda model: {"nodes": model.nodes[1:]}, r"stiffness.mtx: \d+ x \d+ of real entries; al"),
        (lambda model: {"stiffness": np.nan * model.stiffness}, "mtx: allowed are finite numbers"),
        (lambda model: {"triangles": [[0, 1, len(model.nodes)]]}, "triangles.mtx: allowed are nod"),
        (lambda model: {"triangles": np.zeros((0, 3))}, "triangles.mtx: states 0 x 3; allowed is"),
        (lambda model: {"triangles": [[0.0, 1.5, 2.0]]}, "triangles.mtx: allowed are whole numb"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_matrices_of_no_free_body_are_refused(bar_files, bar_model, damage, message):
    path = bar_files(**damage(bar_model))
    with pytest.raises(InputError, match=message):
        matrix_model(MatrixPart(path, ENDS))


@pytest.mark.parametrize(
    ("text", "instead", "message"),
    [
        ("[units]", "[interfaces.units]", r"has no units; allowed are all three, as units = {len"),
        ('"kg"', '"stone"', "units.mass = 'stone': allowed is one of kg, t, g, lb"),
        ("nodes = [", "nodes = []  # [", r"interfaces.left: no node is in it; allowed is a set"),
        ("nodes = [", "nodes = [9999]  # [", "interfaces.left.weights: allowed are numbers"),
        ("nodes = [", f"nodes = [{10**30}]  # [", "interfaces.left: allowed are nodes, a list"),
        ("weights = [", f"weights = [{10**400},", "left.weights: allowed are numbers from 0 to"),
        ("left", "top", "there is no node set 'left'; interfaces are 'top', 'right'"),
        ("bar_nodes.mtx", "../bar_nodes.mtx", "nodes = '../bar_nodes.mtx': allowed is the name"),
        ("bar_nodes.mtx", "/etc/passwd", "nodes = '/etc/passwd': allowed is the name of a file"),
        ("bar_nodes.mtx", "bar.toml", "nodes = 'bar.toml': allowed is .* ends with .mtx"),
        ("bar_nodes.mtx", "b.mtx", "nodes = 'b.mtx': there is no such file"),
        ("bar_nodes.mtx", "bar_mass.mtx", "bar_mass.mtx: allowed is a dense array of 3 real"),
        ("stiffness =", "code =", "code: allowed are stiffness, mass, nodes, triangles, units"),
    ],
)
def test_a_wrong_description_is_refused(bar_files, text, instead, message):
    path = bar_files()
    path.write_text(path.read_text().replace(text, instead, 1))
    with pytest.raises(InputError, match=message):
        matrix_model(MatrixPart(path, ENDS))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"\x80\x04K\x01.", "is no Matrix Market file"),
        (b"%%MatrixMarket matrix coordinate real general\n9999999 9999999 1\n1 1 1\n", "states"),
        (b"%%MatrixMarket matrix coordinate real general\n9 9 99999999\n1 1 1\n", "states 9 x 9"),
        (b"%%MatrixMarket matrix coordinate real general\nSIZE SIZE 2\n1 1 1\n", "is damaged"),
    ],
)
def test_a_file_that_states_too_much_is_not_read(bar_files, content, message):
    path = bar_files()
    stiffness = path.parent / "bar_stiffness.mtx"
    size = next(line for line in stiffness.read_bytes().splitlines() if line[:1] != b"%").split()[0]
    stiffness.write_bytes(content.replace(b"SIZE", size))
    with pytest.raises(InputError, match=rf"bar_stiffness.mtx: {message}"):
        matrix_model(MatrixPart(path, ENDS))


@pytest.mark.parametrize(("numbers", "count"), [([0], 1), ([0, 8], 2)])
def test_a_set_without_rotation_is_refused(bar_files, sets, numbers, count):
    sets["left"] = (numbers, None)
    with pytest.raises(InputError, match=rf"left: {count} nodes in a point or a line have no rot"):
        matrix_model(MatrixPart(bar_files(), ENDS))


def test_one_set_for_two_interfaces_is_refused(bar_files, sets):
    sets["right"] = sets["left"]
    with pytest.raises(InputError, match=r"interfaces.left and interfaces.right: their nodes move"):
        matrix_model(MatrixPart(bar_files(), ENDS))


def test_exudyn_reads_what_abaqus_writes(bar_model, sets, bar_files, tmp_path):
    """*MATRIX OUTPUT, FORMAT=COORDINATE: row, column and value, from 1."""
    for name in ("stiffness", "mass"):
        entries = getattr(bar_model, name).tocoo()
        rows = np.column_stack([*(index + 1 for index in entries.coords), entries.data])
        np.savetxt(tmp_path / f"{name}.txt", rows, fmt=("%d", "%d", "%.17g"))
    fem = FEMinterface()
    fem.ReadStiffnessMatrixFromAbaqus(str(tmp_path / "stiffness.txt"))
    fem.ReadMassMatrixFromAbaqus(str(tmp_path / "mass.txt"))
    path = bar_files(stiffness=fem.GetStiffnessMatrix(), mass=fem.GetMassMatrix())
    model = matrix_model(MatrixPart(path, ENDS))
    assert abs(model.stiffness - bar_model.stiffness).max() < 1e-9 * bar_model.stiffness.max()
    assert abs(model.nodal_mass - bar_model.nodal_mass).max() < 1e-12
    written = scipy.io.mmread(path.parent / "bar_stiffness.mtx")
    assert abs(written - bar_model.stiffness).max() < 1e-9 * bar_model.stiffness.max()
