"""Beams as reduced parts: shape functions of a line, by quadrature; no finite elements of ours."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import scipy.linalg
import scipy.sparse as sp

from fe_models.elasticity import rigid_motions
from fe_models.reduced import ReducedInterface, ReducedPart
from fe_models.reduction import _couplings


@dataclass(frozen=True)
class Beam:
    """A reduced part, and how its coordinates come from those of the shape functions.

    Attributes:
        part: reduced.
        to_modes: (k, k): modal coordinates by shape functions' coordinates.
        moved: (3, k): what the part's frame moves along x and y, and turns, by these.
    """

    part: ReducedPart
    to_modes: np.ndarray
    moved: np.ndarray


def line_part(places, density, shapes, stiffness, ends, *, turns=None, mean_axes=True):
    """Return a beam along x, its frame at x = 0.

    Args:
        places: (n,) along the beam, even and an odd number of them, m.
        density: mass over length, kg/m.
        shapes: (n, 3, k) displacements of the shape functions.
        stiffness: (k, k).
        ends: name -> index of the place.
        turns: (n, k) rotations about z, for joints that hold them.
        mean_axes: free the shape functions of rigid motion, as real parts are.
    """
    weights = np.ones(len(places))  # Simpson's rule
    weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
    mass = density * weights * (places[1] - places[0]) / 3.0
    nodes = np.column_stack([places, np.zeros((len(places), 2))])
    model = SimpleNamespace(
        nodes=nodes, nodal_mass=sp.diags(mass).tocsr(), mass=sp.diags(np.repeat(mass, 3)).tocsr()
    )
    count = shapes.shape[2]
    rigid = rigid_motions(nodes, mass @ nodes / mass.sum())[:, [0, 1, 5]]  # in the plane
    given = shapes.reshape(-1, count)
    taken = np.linalg.solve(rigid.T @ model.mass @ rigid, rigid.T @ model.mass @ given)
    taken = taken * mean_axes
    basis = given - rigid @ taken
    turned = np.zeros((len(places), 3, count))
    turned[:, 2] = (0.0 if turns is None else turns) - taken[2]
    modal_mass = basis.T @ (model.mass @ basis)
    squares, mixed = scipy.linalg.eigh(stiffness, 0.5 * (modal_mass + modal_mass.T))
    modes = (basis @ mixed).reshape(-1, 3, count)
    interfaces = tuple(
        ReducedInterface(
            name,
            centre=nodes[place],
            axis=nodes[place],
            area=1.0,
            arm=0.01,
            translation=modes[place],
            rotation=turned[place] @ mixed,
        )
        for name, place in ends.items()
    )
    second = nodes.T @ (mass[:, None] * nodes)
    some = slice(None, None, len(places) // 4)
    part = ReducedPart(
        name="beam",
        method="given",
        mass=float(mass.sum()),
        centre_of_mass=mass @ nodes / mass.sum(),
        inertia=np.trace(second) * np.eye(3) - second,
        frequencies=np.sqrt(squares) / (2.0 * np.pi),
        fixed_interface_frequencies=np.zeros(0),
        nodes=nodes[some],
        triangles=np.array([[0, 1, 2]]),
        modes=modes[some].reshape(-1, count),
        stress=np.zeros((0, count)),
        mass_matrix=np.eye(count),
        stiffness_matrix=np.diag(squares),
        flexibility=np.zeros(0),
        couplings=_couplings(model, modes),
        interfaces=interfaces,
    )
    lever = float(mass @ places / mass.sum())  # rigid motions are about the centre of mass
    moved = np.array([taken[0], taken[1] - lever * taken[2], taken[2]])
    return Beam(part, np.linalg.inv(mixed), moved)
