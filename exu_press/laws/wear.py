"""Sliding wear of two surfaces: its volume and its place."""

from dataclasses import dataclass

import numpy as np

from exu_press.numerics.arrays import Array

__all__ = ["Contacts", "accessible_depths", "archard", "worn_after", "worn_by_angle"]

LONGEST = 0.1
"""Depth worn in one part of many strokes, over the overlap of the surfaces."""

MOST_PARTS = 200

THINNEST = 1e-6
"""Overlap over the clearance below which a contact counts as hard."""

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


@dataclass(frozen=True)
class Contacts:
    """Where a journal rubs in its bearing during a stroke, direction by direction.

    Attributes:
        direction: of the eccentricity, from the bearing's x axis, (n,), rad.
        turned: angle of the journal's x axis from the bearing's then, (n,), rad.
        overlap: of the surfaces, summed over equal sectors, (n,), m: in proportion to the force on
            an elastic foundation.
        volume: worn off each surface there in a stroke, (n,), m^3.
        area: of a sector, m^2.
    """

    direction: Array
    turned: Array
    overlap: Array
    volume: Array
    area: float


def worn_after(
    journal: Array, bearing: Array, clearance: float, contacts: Contacts, strokes: float
) -> tuple[Array, Array]:
    r"""Return the depths of journal and bearing after strokes, from depths before.

    An elastic foundation spreads the wear of each direction over the surfaces' overlap as they are
    by then, so that a dent is never narrower than the journal that bores it. The force of each
    direction stays: the sum of the overlap

    .. math::
        o(\varphi) = \max(0, e \cos(\varphi - \varphi_e) - c - w_B - w_J)

    is kept as the shapes change, by the eccentricity e. With h the volume of a part of the strokes
    over overlap and area, the depths grow by h o at the end of that part (Euler's implicit rule,
    for which the overlap before is 1 + h times as large), and the volume is exact.

    Parameters
    ----------
    journal, bearing : depths in equal sectors around each, (n,) [m]
    clearance : c [m]
    contacts : of a stroke
    strokes : their number [-]

    Returns
    -------
    As many depths of journal and bearing [m].

    Examples
    --------
    A journal of 50 mm that turns under a steady load, and 1e-9 m^3 off both surfaces:

    >>> turns = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    >>> area = 2.0 * np.pi * 0.05 * 0.1 / 72
    >>> even = np.ones(72)
    >>> contacts = Contacts(0.0 * even, turns, 4e-6 * even, 1e-9 / 72 * even, area)
    >>> journal, bearing = worn_after(np.zeros(72), np.zeros(72), 5e-5, contacts, 1.0)
    >>> [round(float(depths.sum()) * area * 1e9, 6) for depths in (journal, bearing)]
    [1.0, 1.0]

    References
    ----------
    .. [1] Mukras, S., Kim, N. H., Mauntler, N. A., Schmitz, T. L., Sawyer, W. G. Analysis of planar
       multibody systems with revolute joint wear. Wear 268 (2010) 643-652.
    """
    count = len(bearing)
    overlap = np.maximum(contacts.overlap, THINNEST * clearance)
    rates = strokes * contacts.volume / (overlap * contacts.area)
    parts = int(min(max(np.ceil(2.0 * rates.sum() / LONGEST), 1), MOST_PARTS))
    depth = rates[:, None] / parts
    spread = 1.0 + 2.0 * float(depth.sum())  # over both surfaces
    angles = 2.0 * np.pi * (np.arange(count) + 0.5) / count
    cosines = np.cos(angles - contacts.direction[:, None])
    whole, share = np.divmod(contacts.turned * count / (2.0 * np.pi), 1.0)
    on_journal = (np.arange(count) - whole[:, None].astype(int)) % count
    previous, share = (on_journal - 1) % count, share[:, None]
    journal, bearing = journal.copy(), bearing.copy()
    for _ in range(parts):
        gap = clearance + bearing + (1.0 - share) * journal[on_journal] + share * journal[previous]
        pressed = np.maximum(_eccentricity(cosines, gap, spread * overlap) * cosines - gap, 0.0)
        worn = depth / spread * pressed
        bearing += worn.sum(axis=0)
        journal += np.bincount(on_journal.ravel(), ((1.0 - share) * worn).ravel(), count)
        journal += np.bincount(previous.ravel(), (share * worn).ravel(), count)
    return journal, bearing


def _eccentricity(cosines: Array, gap: Array, overlap: Array) -> Array:
    """Return the eccentricities (n, 1) with which overlaps over sectors (n, m) have a sum (n,), m.

    The sum is convex and rises with the eccentricity: Newton's method comes down to it.
    """
    facing = cosines > 0.5
    reach = np.where(facing, (gap + overlap[:, None]) / np.where(facing, cosines, 1.0), np.inf)
    eccentricity = reach.min(axis=1, keepdims=True)
    for _ in range(len(gap[0])):
        pressed = eccentricity * cosines > gap
        slope = np.where(pressed, cosines, 0.0).sum(axis=1)
        sums = overlap + np.where(pressed, gap, 0.0).sum(axis=1)
        lower = (sums / slope)[:, None]
        if (lower >= eccentricity * (1.0 - 1e-12)).all():
            break
        eccentricity = np.minimum(lower, eccentricity)
    return np.asarray(eccentricity)


def accessible_depths(depths: Array, clearance: float, least: float = LEAST) -> Array:
    r"""Return depths that a journal can follow, from depths worn off around a surface.

    The depths are smoothed by Jackson's kernel, which has no negative weights, and drawn towards
    their mean, so that the volume stays and

    .. math::
        c + w + w'' \ge \text{least} \cdot c

    all around: in a shape that a journal bored, its centre has one place in all of the dent. Of the
    widths of the kernel the one counts with which the depths change least.

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
    >>> even = accessible_depths(np.full(72, 1e-5), 5e-5)
    >>> bool(np.allclose(even, 1e-5, rtol=1e-12))
    True

    References
    ----------
    .. [1] Jackson, D. The Theory of Approximation. Am. Math. Soc. Coll. Publ. 11 (1930).
    """
    count, mean = len(depths), float(depths.mean())
    spectrum = np.fft.rfft(depths - mean)
    order = np.arange(len(spectrum))
    room = (1.0 - least) * clearance + mean
    nearest, smallest = np.full(count, mean), np.inf
    for degree in range(1, count // 2):
        smooth = spectrum * _jackson(degree, len(spectrum))
        sharpest = -float(np.fft.irfft(smooth * (1.0 - order**2), count).min())
        fraction = min(1.0, room / sharpest) if sharpest > 0.0 else 1.0
        shape = mean + fraction * np.fft.irfft(smooth, count)
        change = float(((shape - depths) ** 2).sum())
        if change < smallest:
            nearest, smallest = shape, change
    return np.asarray(np.maximum(nearest, 0.0))


def _jackson(degree: int, count: int) -> Array:
    """Return the weights of Jackson's kernel for harmonics 0 to count - 1, none beyond a degree."""
    k, n = np.arange(count), degree + 2.0
    turn = np.pi / n
    weights = ((n - k) * np.cos(k * turn) + np.sin(k * turn) / np.tan(turn)) / n
    return np.asarray(np.where(k <= degree, weights, 0.0))
