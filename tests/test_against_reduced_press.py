"""The Exudyn press against independent physics: three coordinates, SciPy's LSODA."""

import numpy as np
import pytest
from independent.reduced_press import ReducedPress

from exu_press import Scene, simulate


def test_default_press_in_its_first_revolution():
    """Lubricated pin, dry balls: the resolved peak at the default tolerance."""
    scene = Scene(film={"law": "pinkus"}, revolutions=0.5)
    true = np.abs(ReducedPress(scene).slider(scene.duration, 1e-10)[:, 7]).max()
    assert np.abs(simulate(scene)["slider_acceleration"]).max() == pytest.approx(true, rel=2e-3)


@pytest.mark.long
@pytest.mark.parametrize(("clearance", "peak"), [(1e-4, 845.7), (2e-4, 2370.7)])
def test_first_revolution_of_a_dry_press(clearance, peak):
    """20 % off while penetrations were held against the clearance."""
    scene = Scene(
        joints={key: {"kind": "dry", "clearance": clearance} for key in ("crank_pin", "balls")},
        revolutions=1.0,
    )
    independent = ReducedPress(scene).slider(scene.duration, 1e-11)
    true = np.abs(independent[:, 7]).max()
    assert true == pytest.approx(peak, rel=1e-3)
    assert np.abs(simulate(scene)["slider_acceleration"]).max() == pytest.approx(true, rel=2e-2)
