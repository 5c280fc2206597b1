"""Nodal stresses of displacement fields on second-order tetrahedra, averaged over the elements."""

from typing import Any

import numpy as np

from fe_models.arrays import Array
from fe_models.material import Material

__all__ = ["nodal_stress"]

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))  # Netgen's order of edge midpoints


def nodal_stress(model: Any, material: Material, fields: Array) -> Array:
    """Return stresses (n, 6, m) [Pa] for displacement fields (n, 3, m); xx yy zz yz xz xy.

    Evaluated at the corners of each tetrahedron and averaged there; at an edge's midpoint the mean
    of its two ends. Peaks at re-entrant corners grow with the mesh: the solid has no fillets.
    """
    elements, nodes = model.elements, model.nodes
    count = fields.shape[2]
    total = np.zeros((len(nodes), 6, count))
    hits = np.zeros(len(nodes))
    shear = material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio))
    lame = 2.0 * shear * material.poissons_ratio / (1.0 - 2.0 * material.poissons_ratio)
    for corner in range(4):
        local = _slopes(corner)  # (10, 3)
        jacobian = np.einsum("eai,aj->eij", nodes[elements], local)
        slopes = np.einsum("aj,eji->eai", local, np.linalg.inv(jacobian))
        gradient = np.einsum("eacm,eai->ecim", fields[elements], slopes)  # du_c / dx_i
        strain = 0.5 * (gradient + gradient.transpose(0, 2, 1, 3))
        stress = 2.0 * shear * strain
        volume = np.einsum("eiim->em", strain)
        for axis in range(3):
            stress[:, axis, axis] += lame * volume
        six = stress[:, [0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]]
        np.add.at(total, elements[:, corner], six)
        np.add.at(hits, elements[:, corner], 1.0)
    corners = hits > 0
    total[corners] /= hits[corners, None, None]
    for middle, (a, b) in enumerate(EDGES):
        total[elements[:, 4 + middle]] = 0.5 * (total[elements[:, a]] + total[elements[:, b]])
    return total


def _slopes(corner: int) -> Array:
    """Return the derivatives (10, 3) of the shape functions to the local coordinates at a corner.

    Barycentric L_0 ... L_3 with L_0 = 1 - xi - eta - zeta; N_i = L_i (2 L_i - 1), N_ij = 4 L_i L_j.
    """
    along = np.vstack([-np.ones(3), np.eye(3)])  # dL_i
    value = np.eye(4)[corner]
    ends = (4.0 * value[:, None] - 1.0) * along
    middles = [4.0 * (value[a] * along[b] + value[b] * along[a]) for a, b in EDGES]
    return np.vstack([ends, middles])
