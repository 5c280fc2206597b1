"""The mass with which the modes of flexible bodies keep their frequencies in steps of any size."""

from typing import Any

import exudyn as exu
import numpy as np
from exudyn.itemInterface import ObjectGenericODE2, VObjectGenericODE2

from exu_press.integrate.system import FLEXIBLE, MODES, modal_item
from exu_press.numerics.arrays import Array

__all__ = ["ModalMass", "follow_modes"]


def follow_modes(mbs: exu.MainSystem) -> None:
    """Let `solve_dynamic` follow what impacts in clearance joints leave vibrating.

    To be called before `mbs.Assemble()`, when all ObjectFFRFreducedOrder are there. It adds one
    item without mass over their modes, which `solve_dynamic` gives the mass of the step.
    """
    nodes = [item["nodeNumbers"][1] for item in _bodies(mbs)]
    if nodes:
        item = ObjectGenericODE2(nodeNumbers=nodes, visualization=VObjectGenericODE2(show=False))
        mbs.variables[MODES] = int(mbs.AddObject(item))


class ModalMass:
    """Return the change of the modes' mass in steps of a size.

    Generalized-alpha slows vibrations down: what has the frequency omega takes omega (1 - kappa (h
    omega)^2 / 2) in steps of h, with kappa = 1/6 + 3/4 (alpha_f - alpha_m)^2. What an impact leaves
    vibrating is soon out of phase by that, and decides on how the next impact comes. If a mode's
    stiffness K acts on q - kappa h^2 q_tt instead of on q, errors of phase go with h^4. That is the
    same as another mass of the modes,

        M - kappa h^2 K,

    with which forces at rest stay what they are. Each mode of a body has m / (1 + kappa (h
    omega)^2), which is the same to this order, and positive in steps of any size. The energies of a
    run are those of M.

    Source: L. Fox and E. T. Goodwin, Some new methods for the numerical integration of ordinary
    differential equations, Mathematical Proceedings of the Cambridge Philosophical Society 45
    (1949); T. J. R. Hughes, The Finite Element Method (1987), 9.1.
    """

    def __init__(self, mbs: exu.MainSystem, solver: Any, ratio: float) -> None:
        """Change the mass by a ratio of what keeps the frequencies; 0.0 leaves modes their own."""
        self._mbs, self._solver, self._ratio = mbs, solver, ratio
        self._item = modal_item(mbs) if ratio > 0.0 else None
        self._step = 0.0
        self._squares: Array = np.zeros(0)  # of the frequencies, 1/s^2
        self._weights: Array = np.zeros((0, 0))  # M times the modes of K and M
        self._places: Any = None  # where it changes
        self._entries: Array = np.zeros((0, 3))  # rows, columns and values there
        if self._item is not None:
            within = [int(node) for node in mbs.GetObject(self._item)["nodeNumbers"]]
            bodies = [item for item in _bodies(mbs) if int(item["nodeNumbers"][1]) in within]
            stiffness = _diagonal([item["stiffnessMatrixReduced"] for item in bodies])
            root = np.linalg.cholesky(_diagonal([item["massMatrixReduced"] for item in bodies]))
            inverse = np.linalg.inv(root)
            self._squares, modes = np.linalg.eigh(inverse @ stiffness @ inverse.T)
            self._weights = root @ modes
            self._places = np.nonzero(np.abs(self._weights) @ np.abs(self._weights.T))
            self._entries = np.column_stack([*self._places, np.zeros(len(self._places[0]))])

    def fit(self, step: float) -> None:
        """Let the modes have the mass that belongs to a step, s; 0.0 leaves them their own."""
        if self._item is None or step == self._step:
            return
        self._step = step
        offset = self._solver.alphaF - self._solver.alphaM
        kappa = self._ratio * (1.0 / 6.0 + 0.75 * offset * offset)
        squares = kappa * step * step * self._squares
        changes = self._weights * (-squares / (1.0 + squares)) @ self._weights.T
        self._entries[:, 2] = changes[self._places]
        mass, size = exu.MatrixContainer(), len(changes)
        mass.SetWithSparseMatrix(self._entries, size, size)
        self._mbs.SetObjectParameter(self._item, "massMatrix", mass)


def _diagonal(containers: list[Any]) -> Array:
    """Return a matrix with those of Exudyn's containers along its diagonal."""
    blocks = [container.Convert2DenseMatrix() for container in containers]
    ends = np.cumsum([len(block) for block in blocks])
    matrix = np.zeros((ends[-1], ends[-1]))
    for block, end in zip(blocks, ends, strict=True):
        matrix[end - len(block) : end, end - len(block) : end] = block
    return matrix


def _bodies(mbs: exu.MainSystem) -> list[dict[str, Any]]:
    """Return Exudyn's dictionaries of the flexible bodies of a system."""
    data: Any = mbs.systemData
    items = [mbs.GetObject(number) for number in range(data.NumberOfObjects())]
    return [item for item in items if item["objectType"] == FLEXIBLE]
