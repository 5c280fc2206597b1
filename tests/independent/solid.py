"""All finite elements of a solid under forces, some of their motions held: by SciPy, no modes."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu


def displaced(stiffness, held, force):
    """Return the displacements u, as the force: K u + C^T r = f and C u = 0.

    Args:
        stiffness: K (n, n), sparse, N/m.
        held: C (m, n), sparse.
        force: f (n,), or (n, k) for several at once, N.
    """
    bordered = sp.bmat([[stiffness, 1e9 * held.T], [1e9 * held, None]]).tocsc()
    order = "MMD_AT_PLUS_A" if held.nnz > len(force) else "COLAMD"  # by rows that are full or not
    solve = splu(bordered, permc_spec=order).solve
    return solve(np.concatenate([force, np.zeros((held.shape[0], *force.shape[1:]))]))[: len(force)]
