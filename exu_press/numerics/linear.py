"""Linear equations with one matrix: dense ones where they are few, sparse ones where they are many.

Matrices of mechanisms are all but empty. Of 1700 unknowns a sparse factorisation takes an eighth of
the time of a dense one, and most of that is the search for nonzeros; of 530 it takes as long,
and half as long where three solutions follow, as where a step changes; of 300 as long then.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["SPARSE_FROM", "Equations"]

SPARSE_FROM = 300
"""Unknowns from which the sparse solution is faster."""


INVERSE_FROM = 3
"""Solutions from which a small matrix is inverted, which takes as long as three of them."""


class Equations:
    """Solves equations with one matrix for several right sides.

    Attributes:
        matrix: (n, n).
    """

    def __init__(self, matrix: Array) -> None:
        """Take the matrix, (n, n)."""
        self.matrix, self._small = matrix, len(matrix) < SPARSE_FROM
        self._solved = 0
        self._factors: Any = None  # a small one's inverse

    def solve(self, right: Array) -> Array:
        """Return the unknowns for right sides, (n,) or (n, k).

        Raises:
            numpy.linalg.LinAlgError: the matrix is singular.
        """
        self._solved += 1
        if self._small:
            if self._solved < INVERSE_FROM:
                return np.asarray(np.linalg.solve(self.matrix, right), dtype=float)
            if self._factors is None:
                self._factors = np.linalg.inv(self.matrix)
            return np.asarray(np.dot(self._factors, right), dtype=float)
        if self._factors is None:
            from scipy.sparse import csc_matrix  # small systems do without
            from scipy.sparse.linalg import splu

            try:
                self._factors = splu(csc_matrix(self.matrix))
            except (RuntimeError, ValueError) as error:  # exactly singular, or no numbers
                raise np.linalg.LinAlgError(str(error)) from error
        return np.asarray(self._factors.solve(np.ascontiguousarray(right)), dtype=float)

    def solver_of_rows(self, first: int, count: int) -> Callable[[Array], Array]:
        """Return a function of right sides, (count, k), that are zero in all rows but these.

        For repeated use: a small matrix's block of the inverse is computed once.

        Raises:
            numpy.linalg.LinAlgError: the matrix is singular.
        """
        size = len(self.matrix)
        if self._small:
            return self.solve(np.eye(size, count, -first)).dot

        def solve_block(right: Array) -> Array:
            whole = np.zeros((size, right.shape[1]))
            whole[first : first + count] = right
            return self.solve(whole)

        return solve_block
