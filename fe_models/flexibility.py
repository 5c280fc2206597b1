"""Selection of modes by their share of the interfaces' static flexibility.

A body is free: its inertia balances the loads on its interfaces. Mass-normalised modes without
rigid motion sum up this flexibility, G = sum over modes of (C psi) (C psi)^T / omega^2. Compared
with the statics of all finite elements, each mode's term shows whether it can be omitted.
"""

from typing import Any

import numpy as np

from fe_models.arrays import Array
from fe_models.errors import InputError

__all__ = ["Statics", "moved_in_plane"]

STIFF = 1e-6
"""Flexibility over the largest one, below which a combination of loads is ignored."""

IDLE = 1e-5
"""Share of the work of loads and of centrifugal forces, below which a mode stays at rest."""


class Statics:
    """Full statics of a free body under loads on its interfaces.

    Attributes:
        flexibility: motions of the interfaces under unit forces and moments, (m, m), m/N to
            1/(N m).
    """

    def __init__(self, model: Any, rows: Any, cholesky: Any) -> None:
        """Solve for a unit force or moment on every motion.

        Args:
            model: a `FullModel`.
            rows: (m, 3n) mean motions of interfaces.
            cholesky: of the model's stiffness with three nodes held; loads in equilibrium exert
                no force on these.
        """
        from fe_models.elasticity import rigid_motions
        from fe_models.saddle import SaddleSolver

        momentum = (model.mass @ rigid_motions(model.nodes, model.nodes.mean(axis=0))).T
        solver = SaddleSolver(model, momentum, cholesky)
        motions = [rows @ solver.solve(load, None) for load in np.asarray(rows.todense())]
        flexibility = np.array(motions).reshape(rows.shape[0], rows.shape[0])
        self.flexibility: Array = 0.5 * (flexibility + flexibility.T)

    def work_shares(self, motions: Array, frequencies: Array, loaded: Array) -> Array:
        """Return each mode's share of the work of loads, (k, modes), in rows of at most 1.

        Args:
            motions: of the interfaces by a unit of each modal coordinate, (m, modes).
            frequencies: (modes,) Hz.
            loaded: (m,) which of the motions are loaded.
        """
        exact = self.flexibility[np.ix_(loaded, loaded)]
        scale = 1.0 / np.sqrt(np.diag(exact))
        sizes, directions = np.linalg.eigh(scale[:, None] * exact * scale)
        significant = sizes > STIFF * sizes.max(initial=0.0)
        whiten = (directions[:, significant] / np.sqrt(sizes[significant])).T * scale
        return np.asarray(whiten @ motions[loaded] / (2.0 * np.pi * frequencies))

    @staticmethod
    def error(carried: Array) -> float:
        """Return the largest share of any load's work that the modes lack."""
        lacking = np.eye(len(carried)) - carried @ carried.T
        return float(np.linalg.eigvalsh(lacking)[-1]) if lacking.size else 0.0

    def needed_modes(self, carried: Array, allowed_error: float, name: str) -> list[int]:
        """Return the numbers of the modes that an error requires.

        Args:
            carried: shares of all modes, as of `work_shares`.
            allowed_error: largest share of any load's work that may be lacking.
            name: of the part, for the message.

        Raises:
            InputError: the error of all modes is larger.
        """
        remaining_error = self.error(carried)
        if remaining_error > allowed_error:
            raise InputError(
                f"{name}: flexibility_error = {allowed_error:g}: {carried.shape[1]} modes leave "
                f'{remaining_error:.2g}; allowed is as much, or method = "craig_bampton"'
            )
        needed = list(range(carried.shape[1]))
        for mode in np.argsort((carried**2).sum(axis=0), kind="stable").tolist():
            fewer = [number for number in needed if number != mode]
            if self.error(carried[:, fewer]) <= allowed_error:
                needed = fewer
        return needed


def moved_in_plane(carried: Array, frequencies: Array, centrifugal: Array) -> list[int]:
    """Return the numbers of the modes that plane motion moves; the others stay at rest.

    Of a part that is symmetric to the plane these bend out of it or twist; with an almost symmetric
    mesh their share is some 1e-6.

    Args:
        carried: each mode's share of the work of loads in the plane, (k, modes).
        frequencies: (modes,) Hz.
        centrifugal: force on each mode by rotation in the plane, over the square of the angular
            velocity, (modes,).
    """
    stretched = (centrifugal / frequencies) ** 2
    total = stretched.sum()
    by_loads = (carried**2).sum(axis=0) > IDLE
    by_rotation = stretched > IDLE * total
    return [int(mode) for mode in np.flatnonzero(by_loads | by_rotation)]
