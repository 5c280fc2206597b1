"""Modes by what they do: which of them give way under loads on interfaces, and what is left out.

A body is free: its own inertia balances what loads its interfaces, as where a joint pulls it along.
Modes that are mass-normalised and free of rigid motion sum this flexibility up from below,
G = sum over modes of (C psi) (C psi)^T / omega^2: each one adds its part. Held against the
statics of all finite elements this says how far any of them can be spared.
"""

from typing import Any

import numpy as np

from fe_models.arrays import Array
from fe_models.errors import InputError

__all__ = ["Statics", "moved_in_plane"]

STIFF = 1e-6
"""Part of the largest flexibility: combinations of loads that give way less are left out."""

IDLE = 1e-5
"""Part of the work of loads and of centrifugal forces: modes that carry less stay at rest."""


class Statics:
    """Full statics of a free body under loads on its interfaces.

    Attributes:
        flexibility: (m, m) motion of the interfaces by unit forces and moments, m/N to 1/(N m).
    """

    def __init__(self, model: Any, rows: Any, cholesky: Any) -> None:
        """Solve for a unit force or moment on every motion.

        Args:
            model: a `FullModel`.
            rows: (m, 3n) mean motions of interfaces.
            cholesky: of the model's stiffness with three nodes held, which loads in equilibrium
                do not feel.
        """
        from fe_models.elasticity import rigid_motions
        from fe_models.saddle import SaddleSolver

        momentum = (model.mass @ rigid_motions(model.nodes, model.nodes.mean(axis=0))).T
        solver = SaddleSolver(model, momentum, cholesky)
        moved = [rows @ solver.solve(load, None) for load in np.asarray(rows.todense())]
        flexibility = np.array(moved).reshape(rows.shape[0], rows.shape[0])
        self.flexibility: Array = 0.5 * (flexibility + flexibility.T)

    def work_shares(self, moved: Array, frequencies: Array, loaded: Array) -> Array:
        """Return each mode's share of the work of loads, (k, modes), in rows of at most 1.

        Args:
            moved: (m, modes) motion of the interfaces by a unit of each modal coordinate.
            frequencies: (modes,) Hz.
            loaded: (m,) which of the motions are loaded.
        """
        exact = self.flexibility[np.ix_(loaded, loaded)]
        scale = 1.0 / np.sqrt(np.diag(exact))
        sizes, directions = np.linalg.eigh(scale[:, None] * exact * scale)
        significant = sizes > STIFF * sizes.max(initial=0.0)
        whiten = (directions[:, significant] / np.sqrt(sizes[significant])).T * scale
        return np.asarray(whiten @ moved[loaded] / (2.0 * np.pi * frequencies))

    @staticmethod
    def error(carried: Array) -> float:
        """Return the largest share of any load's work that modes leave out."""
        rest = np.eye(len(carried)) - carried @ carried.T
        return float(np.linalg.eigvalsh(rest)[-1]) if rest.size else 0.0

    def needed_modes(self, carried: Array, allowed_error: float, name: str) -> list[int]:
        """Return the numbers of the modes that are needed for an error; others are left out.

        Args:
            carried: by all modes there are.
            wanted: error.
            name: of the part, for the message.

        Raises:
            InputError: even all of them leave more.
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

    Those of a part that is symmetric to the plane bend out of it or twist; of a mesh, which never
    is symmetric to the last digit, they carry some 1e-6.

    Args:
        carried: (k, modes) each mode's share of the work of loads in the plane.
        frequencies: (modes,) Hz.
        centrifugal: (modes,) force on each mode by rotation in the plane, over the angular
            velocity's square.
    """
    stretched = (centrifugal / frequencies) ** 2
    total = stretched.sum()
    by_loads = (carried**2).sum(axis=0) > IDLE
    by_rotation = stretched > IDLE * total
    return [int(mode) for mode in np.flatnonzero(by_loads | by_rotation)]
