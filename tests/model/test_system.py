"""What flexible bodies ask of the rigid ones beside them, and of the ideal motion they start on."""

import numpy as np
import pytest
from exudyn import ConfigurationType

from exu_press import Scene
from exu_press.scene import flexible_press

pytest.importorskip("ngsolve")

SMALL = {"modes": 2, "mesh_size": 0.1}
LINKAGE = {"linkage": {"flexible": "linkage", **SMALL}}


@pytest.mark.parametrize(("kind", "coordinates"), [("ideal", ("y",)), ("dry", ("x", "y", "angle"))])
def test_beside_a_flexible_body_a_joint_with_clearance_is_one_in_space(kind, coordinates):
    """The slide in its ideal guide has y alone, which such a joint could not hold on to."""
    model = Scene(bodies=LINKAGE, joints={"slide_pin": kind}).build()
    assert model.rigid["slide"].coordinates == coordinates


def test_with_clearance_in_the_guides_they_start_in_the_deformation_between_ideal_ones():
    """Bodies with clearance rest nowhere, so that no balance could be found with them."""
    scene = Scene(bodies=flexible_press(**SMALL), start_angle_deg=60.0)
    modes = []
    for guide in (None, {"clearance": 5e-5}):
        model = scene.replace({"guide": guide}).build()
        index = model.mbs.systemData.GetNodeLTGODE2(model.nodes["crank_modes"])
        start = model.mbs.systemData.GetODE2Coordinates(ConfigurationType.Initial)
        modes.append(np.asarray(start)[index])
    assert np.abs(modes[0]).max() > 0.0
    assert modes[1] == pytest.approx(modes[0], rel=1e-9)
