"""LAPACK as it is: for a hundred unknowns the checks of scipy.linalg.solve take longer than it."""

from typing import Any

import numpy as np
from scipy.linalg import get_lapack_funcs

__all__ = ["factorise", "solve"]

_found: Any = get_lapack_funcs(("getrf", "getrs"), dtype=np.float64)
factorise, solve = _found
