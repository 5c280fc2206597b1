"""Free flight, impact, permanent contact: what the paper reads off its centre paths."""

import numpy as np
from numpy.typing import NDArray

from exu_press.observe.clearance import TOUCH

__all__ = ["LONGEST_IMPACT", "contact_modes"]

Array = NDArray[np.float64]

LONGEST_IMPACT = 1e-3
"""A touch that lasts longer is permanent contact, s: one value of the paper's curves holds it."""


def contact_modes(time: Array, penetration: Array) -> dict[str, float]:
    """Return shares of time in free flight, impact and permanent contact, and the touches.

    Args:
        time: (n,), s.
        penetration: (n,), m, of what touches first; negative where the surfaces are apart.

    Returns:
        free_flight, impact, permanent: they add up to 1; impacts: how many touches are impacts.
    """
    touching = penetration > TOUCH
    span = np.diff(time)
    held = touching[1:] & touching[:-1]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], held, [False]]).astype(int)))
    lasting = time[edges[1::2]] - time[edges[::2]]
    total = float(span.sum()) or 1.0
    permanent = float(lasting[lasting > LONGEST_IMPACT].sum()) / total
    contact = float(lasting.sum()) / total
    return {
        "free_flight": 1.0 - contact,
        "impact": contact - permanent,
        "permanent": permanent,
        "impacts": int(np.count_nonzero(lasting <= LONGEST_IMPACT)),
    }
