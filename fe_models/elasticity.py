"""The full linear-elastic model of a part: stiffness and mass as sparse matrices, faces, surface.

Second-order isoparametric tetrahedra: rigid motions are exact. Unknowns are ordered
x0 y0 z0 x1 y1 z1 ... over the nodes, as Exudyn has them.
"""

import ctypes
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import ngsolve as ngs  # type: ignore[import-untyped]
import numpy as np
import scipy.sparse as sp
from netgen.occ import OCCGeometry  # type: ignore[import-untyped]
from numpy.typing import NDArray

from fe_models.arrays import Array
from fe_models.errors import InputError
from fe_models.part import Part

__all__ = ["FaceMotion", "FullModel", "full_model", "generate_mesh", "mean_motion", "rigid_motions"]


@dataclass(frozen=True)
class FaceMotion:
    """The mean motion of a face: its centre, and six rows that read it from the displacements.

    Rows 0-2: area mean of the displacement. Rows 3-5: rotation theta that fits the displacement
    best, W theta = mean of (x - centre) x u with W = mean of |r|^2 I - r r^T. The transposed rows
    spread a force and a moment over the face: what is called RBE3.
    """

    centre: Array  # (3,) m
    area: float  # m^2
    rows: sp.csr_matrix  # (6, 3 nodes)
    nodes: NDArray[np.int64]  # the face's nodes


@dataclass(frozen=True)
class FullModel:
    """Stiffness [N/m] and mass [kg] of a part over its nodes, before any reduction."""

    name: str
    nodes: Array  # (n, 3) m
    stiffness: sp.csr_matrix  # (3n, 3n)
    nodal_mass: sp.csr_matrix  # (n, n); the mass matrix is this times the 3 x 3 identity
    faces: Mapping[str, FaceMotion]
    triangles: NDArray[np.int64]  # (t, 3) corner-and-edge-midpoint triangles of the surface
    elements: NDArray[np.int64]  # (e, 10) tetrahedra: corners, then edge midpoints

    @property
    def mass(self) -> sp.csr_matrix:
        """Return the mass matrix (3n, 3n)."""
        return sp.csr_matrix(sp.kron(self.nodal_mass, sp.identity(3), format="csr"))

    @property
    def unknowns(self) -> int:
        """Return 3n."""
        return int(self.stiffness.shape[0])


def full_model(solid: Part) -> FullModel:
    """Mesh a part and assemble its matrices."""
    mesh = generate_mesh(solid)
    nodes = np.array([list(point) for point in mesh.ngmesh.Points()], dtype=float)
    space = ngs.NodalFESpace(mesh, order=2)
    u, v = space.TnT()
    nodal_mass = _assemble(space, solid.material.density * u * v * ngs.dx)
    # the curved elements miss the solid's volume by some 1e-5: the mass is to be the solid's
    nodal_mass *= solid.material.density * solid.geometry.build().mass / nodal_mass.sum()
    faces = {
        interface.face: _face_motion(mesh, space, nodes, interface.face)
        for interface in solid.interfaces
    }
    return FullModel(
        solid.name,
        nodes,
        _stiffness(mesh, solid),
        nodal_mass,
        faces,
        _surface(mesh),
        np.array([[p.nr - 1 for p in el.points] for el in mesh.ngmesh.Elements3D()], dtype=int),
    )


def rigid_motions(positions: Array, origin: Array) -> Array:
    """Return the six rigid motions (3n, 6) of points (n, 3): translations, turns about `origin`."""
    arm = positions - origin
    motions = np.zeros((len(positions), 3, 6))
    motions[:, :, :3] = np.eye(3)
    for axis in range(3):
        motions[:, :, 3 + axis] = np.cross(np.eye(3)[axis], arm)
    return motions.reshape(-1, 6)


def _stiffness(mesh: Any, solid: Part) -> sp.csr_matrix:
    """Return the stiffness matrix, from the component-wise order of NGSolve to node by node."""
    e, nu = solid.material.youngs_modulus, solid.material.poissons_ratio
    shear, lame = e / (2.0 * (1.0 + nu)), e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    space = ngs.NodalFESpace(mesh, order=2) ** 3
    u, v = space.TnT()
    strain, virtual = ngs.Sym(ngs.Grad(u)), ngs.Sym(ngs.Grad(v))
    stress = 2.0 * shear * strain + lame * ngs.Trace(strain) * ngs.Id(3)
    by_component = sp.coo_matrix(_assemble(space, ngs.InnerProduct(stress, virtual) * ngs.dx))
    n = by_component.shape[0] // 3
    row, column = (3 * (index % n) + index // n for index in by_component.coords)
    matrix = sp.csr_matrix((by_component.data, (row, column)), shape=by_component.shape)
    return sp.csr_matrix(0.5 * (matrix + matrix.T))  # symmetric to the last bit


def _assemble(space: Any, form: Any) -> sp.csr_matrix:
    """Return the matrix of a bilinear form."""
    bilinear = ngs.BilinearForm(space)
    bilinear += form
    bilinear.Assemble()
    values, columns, starts = bilinear.mat.CSR()
    size = space.ndof
    return sp.csr_matrix((np.array(values), np.array(columns), np.array(starts)), (size, size))


def _face_motion(mesh: Any, space: Any, nodes: Array, name: str) -> FaceMotion:
    """Return the mean motion of the faces with a name, by the surface's own shape functions."""
    u, v = space.TnT()
    face = mesh.Boundaries(_literal(name))
    weights = _assemble(space, u * v * ngs.ds(definedon=face))  # (n, n), m^2
    weights.eliminate_zeros()
    return mean_motion(weights, nodes, np.unique(weights.indices))


def mean_motion(weights: sp.csr_matrix, nodes: Array, on_face: NDArray[Any]) -> FaceMotion:
    """Return the mean motion of a face from the weights (n, n) of its nodes, m^2 or without unit.

    Args:
        weights: integrals over products of shape functions, or a diagonal.
        nodes: positions (n, 3), m.
        on_face: numbers of the nodes of the face.
    """
    per_node = np.asarray(weights.sum(axis=0)).ravel()
    area = float(per_node.sum())
    centre = per_node @ nodes / area
    arm = nodes - centre
    moment = np.einsum("ni,nj->ij", arm[on_face], (weights @ arm)[on_face]) / area
    gyration = np.trace(moment) * np.eye(3) - moment  # W of the docstring
    turn = rigid_motions(nodes, centre)[:, 3:].reshape(-1, 3, 3)  # e_axis x arm, per node
    mean = sp.kron(sp.csr_matrix(per_node / area), sp.identity(3))
    weighted = np.stack([weights @ turn[:, :, axis] for axis in range(3)])  # (3, n, 3)
    rotation = np.linalg.solve(gyration, weighted.reshape(3, -1) / area)
    rows = sp.csr_matrix(sp.vstack([mean, sp.csr_matrix(rotation)]))
    return FaceMotion(centre, area, rows, on_face.astype(np.int64))


def _literal(name: str) -> str:
    """Return a boundary name as NGSolve's regular expression for exactly this name."""
    return "".join(char if char.isalnum() or char in " _-" else "\\" + char for char in name)


def _surface(mesh: Any) -> NDArray[np.int64]:
    """Return four flat triangles for each six-node triangle, turning outwards."""
    six = np.array([[p.nr - 1 for p in el.points] for el in mesh.ngmesh.Elements2D()], dtype=int)
    a, b, c, bc, ca, ab = six.T  # Netgen: corners, then the midpoints opposite to a, b, c
    return np.vstack(
        [np.column_stack(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    ).astype(np.int64)


def generate_mesh(solid: Part) -> Any:
    """Return an ngsolve mesh with curved second-order elements.

    Meshing parallel is slower on a busy machine and not reproducible, so it is off.
    """
    ngs.SetNumThreads(1)
    shape = solid.geometry.build()
    known = {face.name for face in shape.faces if face.name is not None}
    for interface in solid.interfaces:
        if interface.face not in known:
            raise InputError(
                f"{solid.name}: the shape has no face named {interface.face!r}; its faces are "
                f"named {', '.join(repr(name) for name in sorted(known)) or 'nothing at all'}"
            )
    try:
        with _quiet():
            geometry = OCCGeometry(shape)
            netgen_mesh = geometry.GenerateMesh(maxh=solid.mesh_size, parallel_meshing=False)
        tetrahedra = netgen_mesh.Elements3D()
        if len(tetrahedra) == 0:
            raise RuntimeError("no tetrahedra: is the shape a closed solid?")
        netgen_mesh.SecondOrder()
    except Exception as error:
        raise InputError(
            f"{solid.name}: meshing failed at mesh_size = {solid.mesh_size:g} m ({error}); "
            "try a smaller one, and check that the shape is one closed solid in m"
        ) from error
    return ngs.Mesh(netgen_mesh)


@contextmanager
def _quiet() -> Iterator[None]:
    """Drop Netgen's output: a thousand lines for a mesh that fails, whatever its message level.

    Its standard error is kept, as it may end the process with a message there.
    """
    sys.stdout.flush()
    c_library = ctypes.CDLL(None)
    stdout_copy, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        c_library.fflush(None)
        os.dup2(stdout_copy, 1)
        os.close(stdout_copy)
        os.close(nowhere)
