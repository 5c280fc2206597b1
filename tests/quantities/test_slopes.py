"""Warnings about the slopes of bent shafts, on a result of one joint."""

from types import SimpleNamespace

import numpy as np
import pytest

from exu_press.quantities.slopes import slope_warnings

CLEARANCE, LENGTH, ASPERITIES = 1e-4, 0.05, 6e-7


class Bent(dict):
    """A result whose journal is at an eccentricity, with a slope along it."""

    def __init__(self, eccentricity, slope):
        super().__init__(pin_slope=np.array([[slope, 0.0]]))
        film = SimpleNamespace(length=LENGTH, contact_gap=ASPERITIES)
        self.scene = SimpleNamespace(joints={"pin": SimpleNamespace(film=film)})
        at = np.array([[eccentricity, 0.0]])
        self.joints = {
            "pin": SimpleNamespace(clearance=CLEARANCE, eccentricity=at, distance=np.abs(at[:, 0]))
        }


@pytest.mark.parametrize(
    ("middle", "thinner", "warns"),
    [
        (2e-5, 0.9e-5, False),
        (2e-5, 1.1e-5, True),
        (-1e-7, 0.4 * ASPERITIES, False),  # the middle touches: asperities leave their height
        (-1e-7, 0.6 * ASPERITIES, True),
        (0.0, 1e-5, True),
    ],
)
def test_where_an_end_has_half_of_the_film(middle, thinner, warns):
    result = Bent(CLEARANCE - middle, thinner / (0.5 * LENGTH))
    texts = list(slope_warnings(SimpleNamespace(result=result)))
    assert len(texts) == warns
    if warns:
        assert f"where the middle has {1e6 * max(0.0, middle):.3g} um" in texts[0]
