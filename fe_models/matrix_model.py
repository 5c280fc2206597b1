"""The full model of a body from the Matrix Market files of another code, checked. For a child."""

from collections.abc import Mapping
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from fe_models.arrays import Array
from fe_models.elasticity import FullModel, mean_motion, rigid_motions
from fe_models.errors import InputError
from fe_models.matrices import Description, MatrixPart, NodeSet
from fe_models.part import MOTIONS, Interface
from fe_models.saddle import SEED, Cholesky, held_unknowns

__all__ = ["matrix_model"]

MOST_UNKNOWNS = 600_000
MOST_ENTRIES = 200_000_000
"""Largest matrix: more memory than a reduction of it has."""

LEAST_BYTES = 2
"""Of an entry in a file."""

ROUNDED = 1e-6
"""What the digits of a file may change, over the largest entry or the sum of a row's sizes."""


def matrix_model(solid: MatrixPart) -> FullModel:
    """Read and check the matrices of a body.

    Raises:
        InputError: a file is none of its kind or too large; a matrix is asymmetric or singular, or
            the stiffness holds the body; the mass is none of three displacements a node; there is
            no such interface, or a node of it is not there.
    """
    description, where = Description.read(solid.path), f"matrices {solid.path}"
    length, force = (description.units[name] for name in ("length", "force"))
    nodes = length * _array(description.files["nodes"], 3, float)
    unknowns = 3 * len(nodes)
    stiffness = (force / length) * _matrix(description.files["stiffness"], unknowns)
    mass = description.units["mass"] * _matrix(description.files["mass"], unknowns)
    nodal_mass = _nodal_mass(mass, description.files["mass"])
    _refuse_singular(nodal_mass, np.zeros(0, dtype=np.int64), description.files["mass"])
    _refuse_held(stiffness, nodes, description.files["stiffness"])
    held = held_unknowns(nodes)
    rigid = rigid_motions(nodes, nodes.mean(axis=0))
    _refuse_singular(stiffness, held, description.files["stiffness"], rigid)
    motions = {
        interface.face: _set_motion(where, interface.face, description.interfaces, nodes)
        for interface in solid.interfaces
    }
    for pair in combinations(solid.interfaces, 2):
        _refuse_dependent(where, pair, motions)
    return FullModel(
        solid.name,
        nodes,
        stiffness,
        nodal_mass,
        motions,
        _surface(description, nodes),
        np.zeros((0, 10), dtype=np.int64),
    )


def _array(file: Path, columns: int, kind: type) -> NDArray[Any]:
    """Return an array (n, columns) of a file."""
    rows, across, entries, _, field, _ = _header(file)
    if across != columns or field not in ("real", "integer") or entries != rows * columns:
        raise InputError(f"{file}: allowed is a dense array of {columns} real columns")
    array = np.asarray(_content(file))
    _refuse_infinite(file, array)
    if kind is int and (array != array.round()).any():
        raise InputError(f"{file}: allowed are whole numbers")
    return array.astype(kind)


def _matrix(file: Path, size: int) -> sp.csr_matrix:
    """Return a symmetric matrix (size, size) of a file."""
    rows, columns, *_, field, _ = _header(file)
    if (rows, columns) != (size, size) or field not in ("real", "integer"):
        raise InputError(
            f"{file}: {rows} x {columns} of {field} entries; allowed is a real matrix of {size} x "
            f"{size}, three displacements a node"
        )
    matrix = sp.csr_matrix(_content(file), dtype=float)
    _refuse_infinite(file, matrix.data)
    difference = abs(matrix - matrix.T)
    largest = float(abs(matrix).max())
    if difference.max() > ROUNDED * largest:
        row, column = np.unravel_index(difference.argmax(), difference.shape)
        raise InputError(
            f"{file}: is asymmetric: entries ({row + 1}, {column + 1}) and ({column + 1}, "
            f"{row + 1}) differ by {difference.max():.3g}, the largest is {largest:.3g}; allowed "
            'is a symmetric matrix (of "general" kind both halves are in the file)'
        )
    return sp.csr_matrix(0.5 * (matrix + matrix.T))


def _header(file: Path) -> tuple[Any, ...]:
    """Return rows, columns, entries, format, field and symmetry of a file; refuse a large one."""
    try:
        rows, columns, entries, *kind = scipy.io.mminfo(file)
    except Exception as error:  # whatever the reader raises of foreign bytes
        raise InputError(f"{file}: is no Matrix Market file ({error})") from None
    size = file.stat().st_size
    if min(rows, columns) < 1:
        raise InputError(f"{file}: states {rows} x {columns}; allowed is one row at least")
    if max(rows, columns) > MOST_UNKNOWNS or entries > min(MOST_ENTRIES, size / LEAST_BYTES):
        raise InputError(
            f"{file}: states {rows} x {columns} with {entries} entries, in {size} bytes; allowed "
            f"are {MOST_UNKNOWNS} rows and {MOST_ENTRIES} entries, all in the file"
        )
    return rows, columns, entries, *kind


def _content(file: Path) -> Any:
    """Return the matrix or array of a file."""
    try:
        return scipy.io.mmread(file)
    except (ValueError, OverflowError) as error:
        raise InputError(f"{file}: is damaged ({error})") from None


def _refuse_infinite(file: Path, values: NDArray[Any]) -> None:
    if not values.size or not np.isfinite(values).all():
        raise InputError(f"{file}: allowed are finite numbers, one at least")


def _nodal_mass(mass: sp.csr_matrix, file: Path) -> sp.csr_matrix:
    """Return the masses between nodes (n, n): the same in x, y and z, none between these."""
    nodal = mass[0::3, 0::3]
    difference = abs(mass - sp.kron(nodal, sp.identity(3), format="csr")).max()
    if difference > ROUNDED * abs(mass).max():
        raise InputError(
            f"{file}: masses differ by direction; allowed is the mass of solid elements, with the "
            "displacements x, y and z of each node and no rotations (lumped or consistent)"
        )
    return sp.csr_matrix(nodal)


def _refuse_held(stiffness: sp.csr_matrix, nodes: Array, file: Path) -> None:
    """Refuse a stiffness whose forces do not vanish under the six rigid motions."""
    motions = rigid_motions(nodes, nodes.mean(axis=0))
    force, size = abs(stiffness @ motions), abs(stiffness) @ abs(motions)
    shares = (force.max(axis=0) / size.max(axis=0)).round(9)
    if shares.max() > ROUNDED:
        worst = int(shares.argmax())
        motion = f"{'turned about' if worst > 2 else 'moved along'} {'xyz'[worst % 3]}"
        raise InputError(
            f"{file}: rigid modes are missing: the body resists when it is {motion} as a "
            f"whole ({shares[worst]:.2g} of its largest forces); "
            "allowed is the stiffness of the free body, without supports and constraints, with the "
            "nodes' positions that belong to it"
        )


def _refuse_singular(
    matrix: sp.csr_matrix, held: NDArray[np.int64], file: Path, rigid: Array | None = None
) -> None:
    """Refuse a matrix that has no inverse; of a stiffness, with three nodes held."""
    load = np.random.default_rng(SEED).standard_normal(matrix.shape[0])
    if rigid is not None:  # in equilibrium: the held nodes bear nothing
        basis, _ = np.linalg.qr(rigid)
        load -= basis @ (basis.T @ load)
    try:
        answer = Cholesky(matrix, held).solve(load)
        is_sound = np.linalg.norm(matrix @ answer - load) < ROUNDED * np.linalg.norm(load)
    except Exception:  # whatever the solver raises at a pivot of zero
        is_sound = False
    if not is_sound or not answer @ load > 0.0:
        loose = "no mass at some node" if rigid is None else "more than six motions without force"
        raise InputError(
            f"{file}: is singular or not positive: {loose}; allowed is one connected body of which "
            "every node has mass and elements"
        )


def _set_motion(where: str, name: str, sets: Mapping[str, NodeSet], nodes: Array) -> Any:
    """Return the mean motion of an interface's nodes."""
    if name not in sets:
        raise InputError(
            f"{where}: there is no node set {name!r}; interfaces are {', '.join(map(repr, sets))}"
        )
    numbers, weights = (np.array(values) for values in (sets[name].nodes, sets[name].weights))
    if numbers.max() >= len(nodes):
        raise InputError(
            f"{where}: interfaces.{name}: no node {numbers.max() + 1} is there; allowed are 1 to "
            f"{len(nodes)}"
        )
    arms = nodes[numbers[weights > 0.0]]
    if np.linalg.matrix_rank(arms - arms.mean(axis=0), tol=ROUNDED * np.ptp(nodes)) < 2:
        raise InputError(
            f"{where}: interfaces.{name}: {len(arms)} nodes in a point or a line have no rotation; "
            "allowed are three or more nodes beside a line"
        )
    diagonal = np.zeros(len(nodes))
    diagonal[numbers] = weights
    return mean_motion(sp.csr_matrix(sp.diags_array(diagonal)), nodes, numbers)


def _refuse_dependent(
    where: str, pair: tuple[Interface, Interface], motions: Mapping[str, Any]
) -> None:
    """Refuse two interfaces of whose motions one follows from the others, as with one set twice."""
    rows = [
        motions[interface.face].rows[[MOTIONS.index(motion)]].toarray()[0]
        for interface in pair
        for motion in interface.motions
    ]
    directions = [row / np.linalg.norm(row) for row in rows]
    if np.linalg.matrix_rank(directions, tol=ROUNDED) < len(rows):
        raise InputError(
            f"{where}: interfaces.{pair[0].face} and interfaces.{pair[1].face}: their nodes move "
            "together; allowed are sets of different nodes"
        )


def _surface(description: Description, nodes: Array) -> NDArray[np.int64]:
    """Return the triangles of the surface; without a file those of the nodes' convex hull."""
    if "triangles" not in description.files:
        hull = ConvexHull(nodes)
        corners: NDArray[np.int64] = hull.simplices.astype(np.int64)
        a, b, c = nodes[corners].transpose(1, 0, 2)
        inwards = (np.cross(b - a, c - a) * hull.equations[:, :3]).sum(axis=1) < 0.0
        corners[inwards] = corners[inwards, ::-1]
        return corners
    file = description.files["triangles"]
    corners = _array(file, 3, int).astype(np.int64) - 1
    if corners.min() < 0 or corners.max() >= len(nodes):
        raise InputError(f"{file}: allowed are nodes 1 to {len(nodes)}")
    return corners
