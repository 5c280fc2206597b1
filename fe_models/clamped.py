"""Frequencies with all bearing surfaces clamped, as published, and their mesh convergence.

Every node of a clamped face is held: stiffer than the interfaces of the reduction, which hold the
mean motion alone and let the bores go oval.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log
from typing import Any

import numpy as np
from scipy.optimize import brentq

from fe_models.arrays import Array
from fe_models.errors import InputError
from fe_models.part import Part

__all__ = [
    "MODE_NUMBERS",
    "PUBLISHED_HZ",
    "ConvergenceRow",
    "clamped_frequencies",
    "clamped_modes",
    "mesh_convergence",
    "observed_order",
    "relative_errors",
]

MODE_NUMBERS = (2, 5, 6, 10, 16)  # the "five typical" of the paper's section 4, Figs. 8 and 9
PUBLISHED_HZ = {
    "crank": (538.192, 2221.68, 2334.63, 5080.91, 7633.93),
    "linkage": (5657.49, 8024.39, 8258.71, 10250.3, 12973.3),
}


@dataclass(frozen=True)
class ConvergenceRow:
    """One mesh: its size [m], unknowns, mass [kg] and the clamped frequencies [Hz]."""

    mesh_size: float
    unknowns: int
    mass: float
    frequencies: Array


def clamped_modes(
    solid: Part, count: int = 20, faces: Sequence[str] | None = None
) -> tuple[Array, Array, Any]:
    """Return frequencies [Hz] (count,), modes (3n, count) and the `FullModel` they belong to.

    Args:
        solid: is meshed here, and not reduced.
        count: number of modes, from the lowest up.
        faces: to be clamped; by default all bearings (interfaces with six motions).

    Raises:
        InputError: a face is no interface of the solid, or there is none to clamp.
    """
    from fe_models.elasticity import full_model
    from fe_models.saddle import Cholesky, lowest_modes

    model = full_model(solid)
    names = solid.bearings if faces is None else tuple(faces)
    unknown = [name for name in names if name not in model.faces]
    if unknown or not names:
        raise InputError(
            f"{solid.name}: cannot clamp {unknown or 'nothing'}; "
            f"its interfaces: {', '.join(model.faces)}"
        )
    nodes = np.unique(np.concatenate([model.faces[name].nodes for name in names]))
    held = (3 * nodes[:, None] + np.arange(3)).ravel()
    cholesky = Cholesky(model.stiffness, held)
    free = np.ones(model.unknowns)
    free[held] = 0.0
    squares, modes = lowest_modes(model, lambda load: cholesky.solve(free * load), count)
    return np.sqrt(squares) / (2.0 * np.pi), modes, model


def clamped_frequencies(solid: Part, count: int = 20, faces: Sequence[str] | None = None) -> Array:
    """Return the lowest `count` frequencies [Hz], (count,), with the faces clamped (all bearings).

    Raises:
        InputError: a face is no interface of the solid, or there is none to clamp.
    """
    return clamped_modes(solid, count, faces)[0]


def relative_errors(frequencies: Array, published: Sequence[float]) -> Array:
    """Return the relative errors (5,) of modes 2, 5, 6, 10, 16 against the published five."""
    five = frequencies[np.array(MODE_NUMBERS) - 1]
    errors: Array = five / np.asarray(published) - 1.0
    return errors


def mesh_convergence(
    solid: Part, mesh_sizes: Sequence[float], count: int = 16
) -> list[ConvergenceRow]:
    """Return the clamped frequencies on ever finer meshes.

    Args:
        solid: with its bearings clamped.
        mesh_sizes: m, from coarse to fine.
        count: number of modes.
    """
    rows = []
    for size in mesh_sizes:
        frequencies, _, model = clamped_modes(solid.replace(mesh_size=size), count)
        mass = float(model.nodal_mass.sum())
        rows.append(ConvergenceRow(size, model.unknowns, mass, frequencies))
    return rows


def observed_order(rows: Sequence[ConvergenceRow], mode: int) -> tuple[float, float]:
    """Return the order of convergence and the extrapolated frequency [Hz] of a mode (from 1).

    From the last three rows, with the mean edge length taken as unknowns^(-1/3): the order p solves
    (f1 - f2) / (f2 - f3) = (h1^p - h2^p) / (h2^p - h3^p). NaN where they do not fall steadily.
    """
    f1, f2, f3 = (float(row.frequencies[mode - 1]) for row in rows[-3:])
    h1, h2, h3 = (row.unknowns ** (-1.0 / 3.0) for row in rows[-3:])
    nothing = (float("nan"), float("nan"))
    if not f1 > f2 > f3:
        return nothing
    ratio = (f1 - f2) / (f2 - f3)

    def defect(p: float) -> float:
        return log((h1**p - h2**p) / (h2**p - h3**p) / ratio)

    low, high = 0.05, 12.0
    if defect(low) * defect(high) > 0.0:
        return nothing
    p = float(brentq(defect, low, high))
    return p, f3 - (f2 - f3) * h3**p / (h2**p - h3**p)
