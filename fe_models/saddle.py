"""The saddle point system [[K, C^T], [C, 0]] of a free body held in mean motions, factorised once.

K is singular (six rigid motions), so it is not factorised itself: three nodes are held statically
determinate, which leaves the elastic answer untouched under a load in equilibrium, and the rest
is positive definite (sparse Cholesky, five times faster than a sparse LU of the whole). The rows
of C and the six rigid motions then make a small dense system.
"""

from typing import Any

import ngsolve as ngs  # type: ignore[import-untyped]
import numpy as np
import scipy.linalg
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigsh

from fe_models.arrays import Array
from fe_models.elasticity import FullModel, rigid_motions

__all__ = ["SEED", "Cholesky", "SaddleSolver", "held_unknowns", "lowest_modes"]

SEED = 20  # of the eigensolver's start vector: any, but always the same


class Cholesky:
    """A sparse symmetric positive definite matrix restricted to free unknowns, factorised."""

    def __init__(self, matrix: sp.csr_matrix, held: NDArray[np.int64]) -> None:
        """Factorise `matrix` without the unknowns `held`."""
        ngs.SetNumThreads(1)
        size = matrix.shape[0]
        entries = matrix.tocoo()
        row, column = entries.coords
        native = ngs.la.SparseMatrixd.CreateFromCOO(
            row.astype(np.int32), column.astype(np.int32), entries.data, size, size
        )
        free = ngs.BitArray(size)
        free.Set()
        for unknown in held:
            free.Clear(int(unknown))
        self._held = held
        self._inverse: Any = native.Inverse(free, inverse="sparsecholesky")
        self._load, self._answer = ngs.BaseVector(size), ngs.BaseVector(size)

    def solve(self, load: Array) -> Array:
        """Return the displacements (n,) under a load (n,); zero at the held unknowns."""
        self._load.FV().NumPy()[:] = load
        self._answer.data = self._inverse * self._load
        answer: Array = self._answer.FV().NumPy().copy()
        answer[self._held] = 0.0
        return answer


class SaddleSolver:
    """Solves K u + C^T f = load, C u = motion for the displacements u of a free body."""

    def __init__(self, model: FullModel, rows: Any, cholesky: Cholesky | None = None) -> None:
        """Factorise, unless `cholesky` is another solver's of the same model.

        Args:
            model: free.
            rows: C (m, 3n), which must hold all six rigid motions.
            cholesky: of the stiffness.
        """
        self._rows = rows
        self._rigid = rigid_motions(model.nodes, model.nodes.mean(axis=0))
        self.cholesky = cholesky or Cholesky(model.stiffness, held_unknowns(model.nodes))
        spread = np.asarray(rows.T @ np.eye(rows.shape[0]))  # C^T, dense
        self._answers = np.column_stack([self.cholesky.solve(column) for column in spread.T])
        self._spread = spread
        self.rigid_motion: Array = np.asarray(rows @ self._rigid)  # C R (m, 6)
        compliance = np.asarray(rows @ self._answers)
        m = len(compliance)
        self._scale = m / float(np.trace(compliance))  # N/m: makes the small system well scaled
        small = np.zeros((m + 6, m + 6))
        small[:m, :m] = -self._scale * compliance
        small[:m, m:] = self.rigid_motion
        small[m:, :m] = self.rigid_motion.T
        self._small = scipy.linalg.lu_factor(small)

    def solve(self, load: Array | None, motion: Array | None) -> Array:
        """Return u (n,) for a load (n,) and a prescribed motion (m,); None is zero."""
        m = self._rows.shape[0]
        right = np.zeros(m + 6)
        elastic = np.zeros(self._spread.shape[0])
        if motion is not None:
            right[:m] = motion
        if load is not None:
            elastic = self.cholesky.solve(load)
            right[:m] -= self._rows @ elastic
            right[m:] = self._rigid.T @ load / self._scale
        answer = scipy.linalg.lu_solve(self._small, right)
        reaction = self._scale * answer[:m]
        displacement: Array = elastic - self._answers @ reaction + self._rigid @ answer[m:]
        return displacement


def lowest_modes(model: FullModel, inverse: Any, count: int) -> tuple[Array, Array]:
    """Return the `count` lowest eigenvalues omega^2 and modes (3n, count), mass-normalised.

    `inverse` maps a load (n,) to displacements: K^-1 under whatever constraints hold.
    """
    size = model.unknowns
    if count == 0:
        return np.zeros(0), np.zeros((size, 0))
    mass = model.mass
    operator = LinearOperator((size, size), matvec=inverse, dtype=float)
    generator = np.random.default_rng(SEED)
    start = inverse(mass @ generator.standard_normal(size))
    values, modes = eigsh(
        model.stiffness,
        k=count,
        M=mass,
        sigma=0.0,
        OPinv=operator,
        v0=start / np.abs(start).max(),
        ncv=min(size, max(2 * count + 10, 20)),
        rng=generator,
    )
    order = np.argsort(values)
    return values[order], modes[:, order]


def held_unknowns(nodes: Array) -> NDArray[np.int64]:
    """Return six unknowns at three far nodes that hold a body statically determinate."""
    first = int(np.argmax(((nodes - nodes.mean(axis=0)) ** 2).sum(axis=1)))
    arm = nodes - nodes[first]
    second = int(np.argmax((arm**2).sum(axis=1)))
    along = arm[second] / np.linalg.norm(arm[second])
    across = arm - np.outer(arm @ along, along)
    third = int(np.argmax((across**2).sum(axis=1)))
    transverse = np.sort(np.argsort(np.abs(along), kind="stable")[:2])  # the two axes most across
    normal = np.cross(along, across[third])
    axis = int(np.argmax(np.abs(normal)))
    return np.array(
        [
            3 * first,
            3 * first + 1,
            3 * first + 2,
            *(3 * second + transverse),
            3 * third + axis,
        ],
        dtype=np.int64,
    )
