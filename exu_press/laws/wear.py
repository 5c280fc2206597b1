"""Sliding wear of two surfaces: its volume and its place."""

import numpy as np

from exu_press.arrays import Array

__all__ = ["archard", "worn_by_angle"]


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


def worn_by_angle(volume: Array, angle: Array, count: int) -> Array:
    """Return the volumes worn in equal sectors of a circle, (count,), m^3.

    Args:
        volume: worn in each step, (n,), m^3.
        angle: of the place of contact on the surface in each step, (n,), rad.
        count: of sectors, the first of which begins at the angle 0.

    >>> worn_by_angle(np.array([1.0, 2.0]), np.array([0.1, -0.1]), 4).tolist()
    [1.0, 0.0, 0.0, 2.0]
    """
    sector = np.floor(np.mod(angle, 2.0 * np.pi) * count / (2.0 * np.pi)).astype(int) % count
    return np.asarray(np.bincount(sector, weights=volume, minlength=count), dtype=float)
