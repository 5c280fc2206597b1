"""Modal reduction: Hurty-Craig-Bampton with interfaces tied by their mean motion, or free modes.

References
----------
.. [1] R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA Journal 6
   (1968) 1313-1319.
.. [2] A. Zwoelfer, J. Gerstmayr, The nodal-based floating frame of reference formulation with modal
   reduction, Acta Mechanica 232 (2021) 835-851: the constant coupling terms.
"""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import scipy.linalg
import scipy.sparse as sp

from fe_models.arrays import Array
from fe_models.errors import InputError
from fe_models.matrices import MatrixPart
from fe_models.part import MOTIONS, Part
from fe_models.reduced import ReducedInterface, ReducedPart

__all__ = ["METHODS", "Reduction", "Solid", "reduce_model", "reduce_part"]

METHODS = ("craig_bampton", "free")
PLANE = {"x", "y", "rz"}
USUAL_MODES = 20
MOST_MODES = 80
"""Most modes among which those for a flexibility error are selected."""

ROUND = 1e-4
"""Largest distance of nodes from a circle over the face's size, for a round face."""

Solid = Part | MatrixPart

Report = Callable[[str, float], None]  # (text about the progress, share done)


@dataclass(frozen=True)
class Reduction:
    """Method of reducing a part.

    Attributes:
        modes: number of modal coordinates, from 0 (a rigid body) up; by default 20. Craig-Bampton
            spends them on the static modes first (one for each loaded motion of an interface beyond
            six), then on the lowest fixed-interface modes; fewer than the static ones: the lowest
            modes of their span.
        flexibility_error: instead, only those modes of the interfaces' statics (of the free body)
            that are needed to leave no more than this share out of what the interfaces give way
            under any load on them, which the body's own inertia balances.
        loads: the motions that joints load; in a planar mechanism x, y and rz, and of so many modes
            only those are kept that such loads, or rotation in the plane, move.
        method: "craig_bampton", or "free": the lowest modes of the free body.
        stress: whether the stresses of the modes are kept too (more to store).

    Raises:
        InputError: the number of modes or the error is invalid, both are set, or the method is
            unknown.
    """

    modes: int | None = None
    method: str = "craig_bampton"
    stress: bool = True
    flexibility_error: float | None = None
    loads: tuple[str, ...] = MOTIONS

    def __post_init__(self) -> None:
        error = self.flexibility_error
        if error is not None:
            if self.modes is not None:
                raise InputError(
                    f"modes = {self.modes!r}, flexibility_error = {error!r}: allowed is one of "
                    "the two"
                )
            if not 0.0 < error < 1.0:
                raise InputError(f"flexibility_error = {error!r}: must lie between 0 and 1")
        elif self.modes is None:
            object.__setattr__(self, "modes", USUAL_MODES)
        elif isinstance(self.modes, bool) or not isinstance(self.modes, int) or self.modes < 0:
            raise InputError(f"modes = {self.modes!r}: must be a whole number, 0 or more")
        if self.method not in METHODS:
            raise InputError(f"method = {self.method!r}: must be one of {', '.join(METHODS)}")

    def key(self) -> dict[str, Any]:
        """Return everything that determines the reduction, as plain data."""
        return asdict(self)


def reduce_part(solid: Solid, reduction: Reduction, report: Report | None = None) -> ReducedPart:
    """Mesh and assemble, or read, and reduce a body, whatever the cache holds.

    Args:
        solid: to be reduced.
        reduction: how.
        report: called with (text about the progress, share done).

    Raises:
        InputError: the solid cannot be meshed or lacks a face, or the reduction does not fit it.
    """
    from fe_models.elasticity import full_model
    from fe_models.matrix_model import matrix_model

    report = report or (lambda what, share: None)
    report(f"{solid.name}: mesh and matrices", 0.0)
    model = matrix_model(solid) if isinstance(solid, MatrixPart) else full_model(solid)
    report(f"{solid.name}: modes of {model.unknowns} unknowns", 0.5)
    reduced = reduce_model(solid, model, reduction)
    report(f"{solid.name}: reduced", 1.0)
    return reduced


def reduce_model(solid: Solid, model: Any, reduction: Reduction) -> ReducedPart:
    """Reduce a `FullModel`."""
    from fe_models.flexibility import Statics, moved_in_plane

    count = _most_modes(solid, model, reduction)
    if count == 0:
        nothing = np.zeros((model.unknowns, 0))
        return _package(solid, model, reduction, np.zeros(0), nothing, np.zeros(0), np.zeros(0))
    by_error = reduction.flexibility_error is not None
    if reduction.method == "free":
        (basis, cholesky), fixed = _free_basis(model, count), np.zeros(0)
    else:
        mode_count = None if by_error else count
        basis, fixed, cholesky = _craig_bampton_basis(solid, model, mode_count)
    frequencies, modes = _orthogonalise(model, basis, basis.shape[1] if by_error else count)
    rows = interface_rows(solid, model)
    statics = Statics(model, rows, cholesky)
    motions = [motion for interface in solid.interfaces for motion in interface.motions]
    loaded = np.array([motion in reduction.loads for motion in motions], dtype=bool)
    carried = statics.work_shares(rows @ modes, frequencies, loaded)
    selected = list(range(len(frequencies)))
    if reduction.flexibility_error is not None:
        selected = statics.needed_modes(carried, reduction.flexibility_error, solid.name)
    elif set(reduction.loads) <= PLANE:
        outward = model.mass @ (model.nodes * (1.0, 1.0, 0.0)).ravel()
        selected = moved_in_plane(carried, frequencies, outward @ modes)
    frequencies, modes, carried = frequencies[selected], modes[:, selected], carried[:, selected]
    exact, remaining_error = np.diag(statics.flexibility), statics.error(carried)
    return _package(solid, model, reduction, frequencies, modes, fixed, exact, remaining_error)


def interface_rows(solid: Solid, model: Any) -> sp.csr_matrix:
    """Return C (m, 3n): the loaded mean motions of all interfaces."""
    rows = [
        model.faces[interface.face].rows[[MOTIONS.index(motion)]]
        for interface in solid.interfaces
        for motion in interface.motions
    ]
    return sp.csr_matrix(sp.vstack(rows) if rows else (0, model.unknowns))


def _most_modes(solid: Solid, model: Any, reduction: Reduction) -> int:
    """Return the number of modes to compute; refuse more than the mesh has, and a loose body."""
    rows = sum(len(interface.motions) for interface in solid.interfaces)
    most = int(model.unknowns - max(rows, 6) - 1)
    if reduction.modes is not None and reduction.modes > most:
        raise InputError(
            f"{solid.name}: modes = {reduction.modes}: this mesh of {model.unknowns} "
            f"unknowns has at most {most}"
        )
    if reduction.modes != 0 and reduction.method == "craig_bampton" and not solid.bearings:
        raise InputError(
            f"{solid.name}: the Craig-Bampton reduction needs an interface with all six motions; "
            'add one, or use method = "free"'
        )
    return min(MOST_MODES, most) if reduction.modes is None else reduction.modes


def _free_basis(model: Any, count: int) -> tuple[Array, Any]:
    """Return the lowest modes of the free body: those held to zero mean momentum by C = R^T M.

    The second is the factorised stiffness.
    """
    from fe_models.elasticity import rigid_motions
    from fe_models.saddle import SaddleSolver, lowest_modes

    momentum = (model.mass @ rigid_motions(model.nodes, model.nodes.mean(axis=0))).T
    solver = SaddleSolver(model, momentum)
    _, modes = lowest_modes(model, lambda load: solver.solve(load, None), count)
    return modes, solver.cholesky


def _craig_bampton_basis(solid: Solid, model: Any, count: int | None) -> tuple[Array, Array, Any]:
    """Return the static and the lowest fixed-interface modes, and the latter's frequencies [Hz].

    Without a count, deformations by accelerations of the body between fixed interfaces replace the
    latter. The third is the factorised stiffness.
    """
    from fe_models.elasticity import rigid_motions
    from fe_models.saddle import SaddleSolver, lowest_modes

    solver = SaddleSolver(model, interface_rows(solid, model))
    rigid = solver.rigid_motion
    directions, _ = np.linalg.qr(rigid, mode="complete")
    static = np.column_stack(
        [solver.solve(None, direction) for direction in directions[:, 6:].T]
        or [np.zeros((model.unknowns, 0))]
    )
    if count is None:
        inertia = model.mass @ rigid_motions(model.nodes, model.nodes.mean(axis=0))
        bent = np.column_stack([solver.solve(load, None) for load in inertia.T])
        return np.hstack([static, bent]), np.zeros(0), solver.cholesky
    eigenvalues, fixed = lowest_modes(
        model, lambda load: solver.solve(load, None), max(0, count - static.shape[1])
    )
    return np.hstack([static, fixed]), np.sqrt(eigenvalues) / (2.0 * np.pi), solver.cholesky


def _orthogonalise(model: Any, basis: Array, count: int) -> tuple[Array, Array]:
    """Return frequencies [Hz] and mass-normalised modes of the free body within the basis's span.

    The basis is first freed of its rigid part; the `count` lowest modes are kept, signs fixed.
    """
    from fe_models.elasticity import rigid_motions

    mass = model.mass
    rigid = rigid_motions(model.nodes, model.nodes.mean(axis=0))
    rigid_mass = rigid.T @ (mass @ rigid)
    for _ in range(2):  # twice is enough to be orthogonal to the last digits
        basis = basis - rigid @ np.linalg.solve(rigid_mass, rigid.T @ (mass @ basis))
        basis = basis / np.sqrt(np.einsum("ij,ij->j", basis, mass @ basis))
    if basis.shape[1] == 0:
        return np.zeros(0), basis
    stiffness = basis.T @ (model.stiffness @ basis)
    inertia = basis.T @ (mass @ basis)
    squares, shapes = scipy.linalg.eigh(
        0.5 * (stiffness + stiffness.T), 0.5 * (inertia + inertia.T)
    )
    modes = basis @ shapes[:, :count]
    return np.sqrt(squares[:count]) / (2.0 * np.pi), modes * _signs(modes)


def _signs(modes: Array) -> Array:
    """Return +-1 per mode: the first component of nearly the largest size becomes positive."""
    large = np.abs(modes) >= 0.9 * np.abs(modes).max(axis=0)
    first = np.argmax(large, axis=0)
    signs: Array = np.sign(modes[first, np.arange(modes.shape[1])])
    return signs


def _package(
    solid: Solid,
    model: Any,
    reduction: Reduction,
    frequencies: Array,
    modes: Array,
    fixed: Array,
    exact: Array,
    flexibility_error: float = 1.0,
) -> ReducedPart:
    """Return the reduced part: interface motions, couplings, and the surface of everything."""
    from fe_models.stress import nodal_stress

    count = len(frequencies)
    surface, triangles = np.unique(model.triangles, return_inverse=True)
    by_node = modes.reshape(len(model.nodes), 3, count)
    ones = np.ones(len(model.nodes))
    weights = model.nodal_mass @ ones
    mass = float(weights.sum())
    squares = model.nodes.T @ (model.nodal_mass @ model.nodes)
    interfaces = []
    for interface in solid.interfaces:
        face = model.faces[interface.face]
        motion = np.asarray(face.rows @ modes)
        arm = float(np.abs(model.nodes[face.nodes] - face.centre).max())
        interfaces.append(
            ReducedInterface(
                interface.face,
                centre=face.centre,
                axis=_axis(model.nodes[face.nodes], face.centre),
                area=face.area,
                arm=arm,
                translation=motion[:3],
                rotation=motion[3:],
            )
        )
    stress = np.zeros((0, count))
    if reduction.stress and isinstance(solid, Part):
        stress = nodal_stress(model, solid.material, by_node)[surface]
        stress = stress.reshape(6 * len(surface), count)
    return ReducedPart(
        name=solid.name,
        method=reduction.method,
        mass=mass,
        centre_of_mass=weights @ model.nodes / mass,
        inertia=np.trace(squares) * np.eye(3) - squares,
        frequencies=frequencies,
        fixed_interface_frequencies=fixed,
        nodes=model.nodes[surface],
        triangles=triangles.reshape(-1, 3).astype(np.int64),
        modes=by_node[surface].reshape(3 * len(surface), count),
        stress=stress,
        mass_matrix=np.eye(count),
        stiffness_matrix=np.diag((2.0 * np.pi * frequencies) ** 2),
        couplings=_couplings(model, by_node),
        interfaces=tuple(interfaces),
        flexibility=exact,
        meta={
            "unknowns": model.unknowns,
            "tetrahedra": len(model.elements),
            "motions": [[i.face, motion] for i in solid.interfaces for motion in i.motions],
            "flexibility_error": flexibility_error,
        },
    )


def _axis(nodes: Array, centre: Array) -> Array:
    """Return a point on the axis of a cylinder along z, or a sphere's centre; else the centre.

    Nodes lie on the face exactly: a circle or a sphere through them by least squares, as
    2 x . m + c = |x|^2, whose residual is rounding. A part of the mantle is enough.
    """
    for columns in (slice(0, 2), slice(0, 3)):
        arm = (nodes - centre)[:, columns]
        rows = np.column_stack([2.0 * arm, np.ones(len(arm))])
        squares = (arm**2).sum(axis=1)
        solution, _, rank, _ = np.linalg.lstsq(rows, squares)
        residual = np.abs(rows @ solution - squares).max()
        if rank == rows.shape[1] and residual < ROUND * squares.max():
            moved = np.zeros(3)
            moved[columns] = solution[:-1]
            return np.asarray(centre + moved)
    return centre


def _couplings(model: Any, modes: Array) -> dict[str, Array]:
    """Return the constant terms of the floating frame [2]_ for modes (n, 3, m).

    With S(v) the cross-product matrix, S of a matrix of modes stacks one block a mode side by side.
    """
    nodal = model.nodal_mass
    count = modes.shape[2]
    skew = _skew(modes.transpose(0, 2, 1))  # (n, m, 3, 3)
    psi_tilde = skew.transpose(0, 2, 1, 3).reshape(3 * len(modes), 3 * count)  # (3n, 3m)
    psi = modes.reshape(3 * len(modes), count)
    reference_tilde = _skew(model.nodes).reshape(-1, 3)  # (3n, 3)
    mass = model.mass
    total = np.tile(np.eye(3), (nodal.shape[0], 1))  # (3n, 3): the three translations
    m_psi, m_psi_tilde = mass @ psi, mass @ psi_tilde
    return {
        "mPsiTildePsi": psi_tilde.T @ m_psi,
        "mPsiTildePsiTilde": psi_tilde.T @ m_psi_tilde,
        "mPhitTPsi": total.T @ m_psi,
        "mPhitTPsiTilde": total.T @ m_psi_tilde,
        "mXRefTildePsi": reference_tilde.T @ m_psi,
        "mXRefTildePsiTilde": reference_tilde.T @ m_psi_tilde,
    }


def _skew(vectors: Array) -> Array:
    """Return S(v) (..., 3, 3) with S(v) w = v x w."""
    x, y, z = np.moveaxis(vectors, -1, 0)
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
