"""Reynolds' equation around a bearing, with Swift and Stieber's cavitation: p >= 0.

The film is unbroken where the pressure is positive, and elsewhere no cell has more oil flowing in
than out. This complementarity problem has an M-matrix and one solution, which policy iteration
gets exactly. Between its iterations the unbroken cells spread by Jacobi's sweeps, as an iteration
alone adds one cell at a boundary.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dpbsv  # type: ignore[import-untyped,unused-ignore]
from scipy.sparse import dia_array  # type: ignore[import-untyped,unused-ignore]

from exu_press.numerics.arrays import Array

__all__ = ["FilmMatrix", "Mask", "Pressures"]

Mask = NDArray[np.bool_]

ITERATIONS, SPREAD = 100, 20
"""At most, and those after which the unbroken cells spread."""

SWEEPS = 6


class Pressures(NamedTuple):
    """The pressures of each speed alone, (speeds, n m), where the film is unbroken, (n m,)."""

    by_speed: Array
    unbroken: Mask


class FilmMatrix:
    """What flows between the cells of a grid, n around and m along the axis, by their pressures."""

    def __init__(self, around: Array, along: Array, diagonal: Array) -> None:
        """Take what flows by a difference of pressures.

        Args:
            around: to the next cell around, (n, m).
            along: to the next one along the axis, (n, m - 1).
            diagonal: of each cell to all beside it, also beyond the ends, (n, m).
        """
        self._around, self._along, self._diagonal = around, along, diagonal
        self.diagonal = diagonal.ravel()
        n, m = diagonal.shape
        size = n * m
        links = np.zeros((7, n, m))
        links[0], links[1], links[2, :, :-1], links[3, :, 1:] = diagonal, around, along, along
        links[4] = links[6] = np.roll(around, 1, axis=0)
        links[5] = around
        np.negative(links[1:], out=links[1:])
        offsets = 0, -m, -1, 1, m, size - m, m - size
        self._operator = dia_array((links.reshape(7, size), offsets), shape=(size, size))

    def net(self, p: Array) -> Array:
        """Return what flows out of each cell by a pressure, (n m,)."""
        return np.asarray(self._operator @ p)

    def solve(
        self, sources: Array, speeds: Array, rounding: Array, land: Mask, guess: Pressures
    ) -> Pressures:
        """Return the pressures of speeds.

        Args:
            sources: of each speed, (speeds, n m).
            speeds: (speeds,).
            rounding: by which the flow of a broken cell may be short, (n m,).
            land: cells that are no groove, (n m,).
            guess: of other speeds.

        Raises:
            RuntimeError: the iteration does not settle.
        """
        source, pressures = speeds @ sources, guess
        for iteration in range(ITERATIONS):
            p = speeds @ pressures.by_speed
            short = self.net(p) - source
            unbroken = np.where(pressures.unbroken, p > 0.0, short < -rounding) & land
            if np.array_equal(unbroken, pressures.unbroken):
                return pressures
            if iteration < SPREAD:
                p = np.maximum(p, 0.0)
                for _ in range(SWEEPS):
                    p = np.maximum(p - (self.net(p) - source) / self.diagonal, 0.0) * land
                unbroken |= p > 0.0
            pressures = self.pressures(sources, unbroken)
        raise RuntimeError(f"the cavitated set did not settle in {ITERATIONS} iterations")

    def pressures(self, sources: Array, unbroken: Mask) -> Pressures:
        """Return the pressures of sources, (k, n m), with that of broken cells 0."""
        shape = self._diagonal.shape
        wet: Mask = np.reshape(unbroken, shape)
        sources = sources.reshape(-1, *shape)
        filled: Mask = np.any(wet, axis=1)
        solution = self._solve_folded if filled.all() else self._solve_cut
        return Pressures(solution(sources, wet).reshape(len(sources), -1), unbroken)

    def _solve_cut(self, sources: Array, wet: Mask) -> Array:
        """Return the pressures of a film that is broken over all of the length at a line."""
        filled: Mask = np.any(wet, axis=1)
        n, m = wet.shape
        lines = np.roll(np.arange(n), -int(np.argmin(filled)))
        lines = lines[filled[lines]]
        wet_lines = wet[lines]
        band = np.zeros((len(lines), m, m + 1))
        band[:, :-1, 1] = -self._along[lines] * (wet_lines[:, 1:] & wet_lines[:, :-1])
        band[:, :, m] -= self._around[lines] * (wet_lines & wet[(lines + 1) % n])
        band[:, :, 0] = np.where(wet_lines, self._diagonal[lines], 1.0)
        p = np.zeros_like(sources)
        p[:, lines] = _solve_band(band, sources[:, lines] * wet_lines)
        return p

    def _solve_folded(self, sources: Array, wet: Mask) -> Array:
        """Return those of another one, whose circle is folded in a band."""
        n, m = wet.shape
        column, around_at = _fold(n, m)
        band = np.zeros(n * m * (2 * m + 1))
        band[around_at] = -self._around * (wet & np.roll(wet, -1, axis=0))
        band = band.reshape(n, m, 2 * m + 1)
        band[column, :-1, 1] = -self._along * (wet[:, 1:] & wet[:, :-1])
        band[column, :, 0] = np.where(wet, self._diagonal, 1.0)
        right = np.empty_like(sources)
        right[:, column] = sources * wet
        return _solve_band(band, right)[:, column]


@lru_cache(maxsize=8)
def _fold(n: int, m: int) -> tuple[Array, Array]:
    """Return the places of lines in a folded circle, and of their links around in the band."""
    column = np.empty(n, dtype=int)
    column[np.arange((n + 1) // 2)] = np.arange(0, n, 2)
    column[np.arange(n - 1, (n + 1) // 2 - 1, -1)] = np.arange(1, n, 2)
    following = np.roll(column, -1)
    first, apart = np.minimum(column, following), np.abs(column - following)
    cell = first[:, None] * m + np.arange(m)
    return column, cell * (2 * m + 1) + apart[:, None] * m


def _solve_band(band: Array, right: Array) -> Array:
    """Return the solutions of a symmetric band, (lines, m, width), for right sides (k, lines, m).

    Raises:
        RuntimeError: it is not positive definite.
    """
    k = len(right)
    solved, failed = dpbsv(
        band.reshape(-1, band.shape[2]).T, right.reshape(k, -1).T,
        lower=1, overwrite_ab=1, overwrite_b=1,
    )[1:]  # fmt: skip
    if failed:
        raise RuntimeError("the matrix of a film is not positive definite")
    return np.asarray(solved.T).reshape(right.shape)
