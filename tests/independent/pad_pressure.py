"""Reynolds' equation of a plane pad in two dimensions: central differences and p >= 0."""

import numpy as np
from scipy.linalg import solveh_banded


def end_forces(length, width, gaps, rates, cells=(60, 20)):
    """Return what presses both ends off the way, over the viscosity, (2,).

    Args:
        length: of the pad, m.
        width: m; half of it is solved.
        gaps: at both ends, m.
        rates: v at both ends, m/s: of the gaps, less the wedge's.
        cells: along the pad and over half its width, denser towards the edges.
    """
    n, m = cells
    part = 0.5 - 0.5 * np.cos(np.pi * np.arange(n + 1) / n)
    across = 0.5 * width * np.sin(0.5 * np.pi * np.arange(m + 1) / m)
    gap, rate = (both[0] + (both[1] - both[0]) * part for both in (gaps, rates))
    d_s, d_z = length * np.diff(part), np.diff(across)
    w_s = 0.5 * (d_s[1:] + d_s[:-1])
    w_z = 0.5 * np.append(d_z[0], d_z[1:] + d_z[:-1])  # the middle is a line of symmetry
    middle = 0.5 * (gap[1:] + gap[:-1])
    along = np.outer(middle**3 / d_s, w_z)
    aside = np.outer(gap[1:-1] ** 3 * w_s, 1.0 / d_z)
    diagonal = along[1:] + along[:-1] + aside
    diagonal[:, 1:] += aside[:, :-1]
    source = -12.0 * np.outer(rate[1:-1] * w_s, w_z)
    pressure = _obstacle(diagonal, along[1:-1], aside[:, :-1], source)
    load = 2.0 * w_s * (pressure @ w_z)
    return np.array([load @ (1.0 - part[1:-1]), load @ part[1:-1]])


def _obstacle(diagonal, along, aside, source):
    """Return the pressure: where it is none the source draws."""
    n, m = diagonal.shape
    wet = source > 0.0
    for _ in range(100):
        band = np.zeros((m + 1, n, m))
        band[0] = np.where(wet, diagonal, 1.0)
        band[1, :, :-1] = np.where(wet[:, 1:] & wet[:, :-1], -aside, 0.0)
        band[m, :-1] += np.where(wet[1:] & wet[:-1], -along, 0.0)
        right = np.where(wet, source, 0.0)
        p = solveh_banded(band.reshape(m + 1, -1), right.ravel(), lower=True).reshape(n, m)
        rest = diagonal * p - source
        rest[1:] -= along * p[:-1]
        rest[:-1] -= along * p[1:]
        rest[:, 1:] -= aside * p[:, :-1]
        rest[:, :-1] -= aside * p[:, 1:]
        now = np.where(wet, p > 0.0, rest < 0.0)
        if (now == wet).all():
            return p
        wet = now
    raise RuntimeError("the cavitated set did not settle")
