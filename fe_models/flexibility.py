"""Modes by what they do: which of them give way under loads on interfaces, and what is left out.

Modes that are mass-normalised and free of rigid motion sum the flexibility of interfaces up from
below, G = sum over modes of (C psi) (C psi)^T / omega^2: each one adds what it carries. Held
against the statics of all finite elements this says how far any of them can be spared.
"""

from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from exu_press.errors import InputError

__all__ = ["Statics", "inertia_relief", "shares"]

Array = NDArray[np.float64]

IN_LINE = 1e-4
"""Of the body's size: centres of faces nearer to a plane than this are in it, as by meshes."""


class Statics:
    """Full statics of interfaces under all loads on them that are in equilibrium."""

    def __init__(self, model: Any, rows: Any, cholesky: Any) -> None:
        """Solve for every such load.

        Args:
            model: a `FullModel`.
            rows: (m, 3n) mean motions of interfaces that are loaded.
            cholesky: of the model's stiffness with three nodes held, which loads in equilibrium
                do not feel.
        """
        from fe_models.elasticity import rigid_motions

        rigid = rows @ rigid_motions(model.nodes, model.nodes.mean(axis=0))
        self._loads = scipy.linalg.null_space(rigid.T, rcond=IN_LINE)  # (m, k)
        forces = rows.T @ self._loads
        moved = np.array([cholesky.solve(force) for force in forces.T]).reshape(-1, len(forces))
        exact = forces.T @ moved.T
        if exact.size:
            self._whiten = scipy.linalg.inv(scipy.linalg.cholesky(exact + exact.T, lower=True))
            self._whiten *= np.sqrt(2.0)

    def carried(self, moved: Array, frequencies: Array) -> Array:
        """Return what each mode carries of the loads' work, (k, modes), in rows of at most 1.

        Args:
            moved: (m, modes) what a unit of each modal coordinate moves the interfaces.
            frequencies: (modes,) Hz.
        """
        if not self._loads.size:
            return np.zeros((0, len(frequencies)))
        return np.asarray(self._whiten @ self._loads.T @ moved / (2.0 * np.pi * frequencies))

    def error(self, carried: Array) -> float:
        """Return the largest share of any such load's work that modes leave out."""
        rest = np.eye(len(carried)) - carried @ carried.T
        return float(np.linalg.eigvalsh(rest)[-1]) if rest.size else 0.0

    def enough(self, carried: Array, wanted: float, name: str) -> list[int]:
        """Return the numbers of the modes that are needed for an error; others are left out.

        Args:
            carried: by all modes there are.
            wanted: error.
            name: of the part, for the message.

        Raises:
            InputError: even all of them leave more.
        """
        left = self.error(carried)
        if left > wanted:
            raise InputError(
                f"{name}: flexibility_error = {wanted:g}: {carried.shape[1]} modes leave "
                f'{left:.2g}; allowed is as much, or method = "craig_bampton"'
            )
        kept = list(range(carried.shape[1]))
        for mode in np.argsort((carried**2).sum(axis=0), kind="stable").tolist():
            fewer = [one for one in kept if one != mode]
            if self.error(carried[:, fewer]) <= wanted:
                kept = fewer
        return kept


def inertia_relief(model: Any, rows: Any, cholesky: Any) -> Array:
    """Return what each motion of an interface gives way, (m,), m/N or 1/(N m).

    The body is free: its own inertia balances the force or moment.

    Args:
        model: a `FullModel`.
        rows: (m, 3n) mean motions of interfaces.
        cholesky: of the model's stiffness.
    """
    from fe_models.elasticity import rigid_motions
    from fe_models.saddle import SaddleSolver

    momentum = (model.mass @ rigid_motions(model.nodes, model.nodes.mean(axis=0))).T
    solver = SaddleSolver(model, momentum, cholesky)
    loads = np.asarray(rows.todense())
    return np.array([load @ solver.solve(load, None) for load in loads])


def shares(moved: Array, frequencies: Array, exact: Array) -> Array:
    """Return what share (m, modes) each mode has in how an interface's motion gives way.

    Args:
        moved: (m, modes) what a unit of each modal coordinate moves the interfaces.
        frequencies: (modes,) Hz.
        exact: (m,) from `inertia_relief`.
    """
    return np.asarray((moved / (2.0 * np.pi * frequencies)) ** 2 / exact[:, None])
