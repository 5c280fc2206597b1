"""Flexible bodies start in the deformation, and its rate, that the ideal motion asks for."""

import numpy as np
import pytest
from coarse_parts import COARSE
from exudyn import ConfigurationType

from exu_press import InputError, Scene, simulate

pytest.importorskip("ngsolve")

IDEAL = {"joints": {"crank_pin": "ideal", "balls": "ideal"}}
TURN = 0.25  # s


def _over(result, channel, begin, end):
    """Return a channel, (n, columns), at a hundred instants of a run."""
    values = result[channel].reshape(len(result.time), -1)
    instants = np.linspace(begin, end, 100)
    return np.array([np.interp(instants, result.time, column) for column in values.T])


@pytest.fixture(scope="module")
def result():
    scene = Scene(**IDEAL, revolutions=1.1, bodies=COARSE, solver={"step": 2e-4})
    found = simulate(scene)
    assert found.completed
    return found


@pytest.mark.parametrize(
    ("channel", "relative"),
    [
        ("counter_pin_force", 2e-4),
        ("crank_pin_force", 4e-4),  # 14.7 of 32.6 kN where the bodies start undeformed
        ("slider_acceleration", 4e-4),
        ("drive_torque", 2e-3),
        ("crank_pin_deflection", 1e-3),
    ],
)
def test_the_first_30_degrees_are_those_of_the_second_revolution(result, channel, relative):
    first = _over(result, channel, 0.0, TURN / 12.0)
    second = _over(result, channel, TURN, TURN * 13.0 / 12.0)
    assert np.abs(first - second).max() < relative * np.abs(result[channel]).max()


def test_a_body_too_soft_to_stay_in_shape_is_refused():
    """A Young's modulus in MPa; what it would be bent by is no number that says anything."""
    linkage = {"flexible": "linkage", "modes": 4, "mesh_size": 0.1, "youngs_modulus": 1.69e5}
    scene = Scene(**IDEAL, bodies={"linkage": linkage}, revolutions=0.001)
    message = (
        r"bodies\.linkage: its .* more than its size; .* 0\.\d+, of a larger youngs_modulus than "
        r"169000 Pa or at a lower speed_rpm"
    )
    with pytest.raises(InputError, match=message) as refused:
        simulate(scene)
    assert "\n" not in str(refused.value)


def test_elastic_guides_start_loaded():
    """What the guide of the slide carries at the start is what it carries a revolution later."""
    scene = Scene(
        **IDEAL,
        guide={"lateral_stiffness": 1e9},
        revolutions=1.0,
        start_angle_deg=60.0,
        bodies=COARSE,
    )
    force = simulate(scene)["slide_guide_force"]
    assert np.abs(force).max() > 1000.0
    assert force[0] == pytest.approx(force[-1], abs=10.0)


def test_with_clearance_in_the_guides_they_start_in_the_deformation_between_ideal_ones():
    """Bodies with clearance rest nowhere, so that no balance could be found with them."""
    scene = Scene(bodies=COARSE, start_angle_deg=60.0)
    modes = []
    for guide in (None, {"clearance": 5e-5}):
        model = scene.replace({"guide": guide}).build()
        index = model.mbs.systemData.GetNodeLTGODE2(model.nodes["crank_modes"])
        start = model.mbs.systemData.GetODE2Coordinates(ConfigurationType.Initial)
        modes.append(np.asarray(start)[index])
    assert np.abs(modes[0]).max() > 0.0
    assert modes[1] == pytest.approx(modes[0], rel=1e-9)
