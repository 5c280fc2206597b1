"""Sliding wear of two surfaces: its volume and its place."""

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["archard", "reached", "worn_by_angle"]

FINEST = 18
"""Harmonics of a profile: shapes down to 20 degrees."""

LEAST = 0.1
"""Radius, over the clearance, on which a journal's centre goes around in a worn bearing."""


def archard(coefficient: float, hardness: float, force: float, distance: float) -> float:
    r"""Return the volume that sliding wears off one surface.

    .. math::
        V = \frac{k F s}{H}

    Parameters
    ----------
    coefficient : k [-]
    hardness : H of the surface [Pa]
    force : F, normal [N]
    distance : s that the surfaces slide on each other [m]

    Returns
    -------
    V [m^3].

    Notes
    -----
    Range: steady mild or severe wear, not running-in, scuffing or fatigue. k of one pair differs by
    a factor of ten between tests: the law compares joints better than it foretells lives.

    Examples
    --------
    Archard's test of mild steel on mild steel, 4 N over 1 m at H = 1.86 GPa and k = 7e-3:

    >>> f"{archard(7e-3, 1.86e9, 4.0, 1.0):.2e}"
    '1.51e-11'

    References
    ----------
    .. [1] Archard, J. F. Contact and rubbing of flat surfaces. J. Appl. Phys. 24 (1953) 981-988.
    """
    return coefficient * force * distance / hardness


def worn_by_angle(volume: Array, overlap: Array) -> Array:
    """Return the volumes worn in equal sectors of a surface, (count,), m^3.

    Each is spread as an elastic foundation of the surfaces presses there, in proportion to their
    overlap; where no sector's middle overlaps, all goes to the one that comes nearest.

    Args:
        volume: worn in each step, (n,), m^3.
        overlap: of the surfaces in the middle of each sector, (n, count), m; < 0 apart.

    >>> overlap = np.array([[2.0, 1.0, -9.0], [-3.0, -2.0, -9.0]])
    >>> worn_by_angle(np.array([3.0, 1.0]), overlap).tolist()
    [2.0, 2.0, 0.0]
    """
    share = np.maximum(overlap, 0.0)
    alone = ~share.any(axis=1)
    share[alone, overlap[alone].argmax(axis=1)] = 1.0
    share /= share.sum(axis=1, keepdims=True)
    return np.asarray(volume @ share)


def reached(depths: Array, clearance: float, least: float = LEAST) -> Array:
    r"""Return depths that a journal can follow, from depths worn off around a surface.

    The depths are smoothed by Jackson's kernel, which has no negative weights: the volume stays,
    and a convex profile stays convex. The kernel is as narrow as the curvature allows,

    .. math::
        c + w + w'' \ge \text{least} \cdot c

    all around. In a dent narrower than the journal's own curvature the pressure is on both
    shoulders, which wear first: the dent is taken as spread over them.

    Parameters
    ----------
    depths : w in equal sectors around the surface, (n,) [m]
    clearance : c [m]
    least : radius of curvature that is left of the path of the journal's centre, over c [-]

    Returns
    -------
    As many depths, [m]; their mean is kept.

    Examples
    --------
    >>> even = reached(np.full(72, 1e-5), 5e-5)
    >>> bool(np.allclose(even, 1e-5, rtol=1e-12))
    True

    References
    ----------
    .. [1] Jackson, D. The Theory of Approximation. Am. Math. Soc. Coll. Publ. 11 (1930).
    """
    count = len(depths)
    found = np.fft.rfft(depths)
    order = np.arange(len(found))
    for degree in range(min(FINEST, count // 4), 0, -1):
        weights = _jackson(degree, len(found))
        smooth = np.fft.irfft(found * weights, count)
        curved = np.fft.irfft(found * weights * (1.0 - order**2), count)
        if clearance + curved.min() >= least * clearance:
            break
    return np.asarray(np.maximum(smooth, 0.0))


def _jackson(degree: int, count: int) -> Array:
    """Return the weights of Jackson's kernel for harmonics 0 to count - 1, none beyond a degree."""
    k, n = np.arange(count), degree + 2.0
    turn = np.pi / n
    weights = ((n - k) * np.cos(k * turn) + np.sin(k * turn) / np.tan(turn)) / n
    return np.asarray(np.where(k <= degree, weights, 0.0))
