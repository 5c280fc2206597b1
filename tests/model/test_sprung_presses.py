"""Springs between bodies in runs: period, work, torque to hold, forces on guides and frame."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.mechanism import GROUND, shipped_mechanism
from exu_press.mechanism.springs import GasSpring, LinearSpring
from exu_press.scene.holding_torque import holding_torque

GAS = {"area": 0.02, "pressure": 5e5, "volume": 0.05, "exponent": 1.3, "damping": 0.0}


def sprung(*springs):
    return replace(shipped_mechanism("cycloidal_press"), springs=springs)


def gas(between=("frame", "ram"), at=((0.3, -1.2), (0.1, -0.5)), **changes):
    return GasSpring("balance", between, at, **{**GAS, **changes})


def slow(mechanism, **changes):
    keys = {"speed_rpm": 1.0, "revolutions": 0.5, "joints": {}, **changes}
    result = simulate(Scene(mechanism=mechanism, **keys))
    assert result.completed, result.info["reason"]
    return result


@pytest.mark.parametrize("exponent", [1.0, 1.3])
def test_the_drive_does_the_polytropic_work(exponent):
    """Slowly, from top to bottom, without weight: p V (r^(n - 1) - 1) / (n - 1) less p_0 dV."""
    spring = gas(at=((0.0, -1.2), (0.0, -0.5)), exponent=exponent)
    result = slow(sprung(spring), gravity=0.0)
    ratio = 0.05 / (0.05 - 0.02 * 0.16)
    work = np.log(ratio) if exponent == 1.0 else (ratio**0.3 - 1.0) / 0.3
    expected = 5e5 * 0.05 * work - 101325.0 * 0.02 * 0.16
    assert result["energy_input"][-1] == pytest.approx(expected, rel=1e-4)
    assert result["energy_stored"][-1] == pytest.approx(expected, rel=1e-5)
    peak = result.quantity("springs.balance.peak_pressure").value
    assert peak == pytest.approx(5e5 * ratio**exponent, rel=1e-9)


def test_the_drive_holds_what_virtual_work_says():
    """Slowly, a gas spring that leans, and one between the planet and the frame that pulls."""
    pull = LinearSpring("pull", ("planet", GROUND), ((0.02, 0.1), (0.5, 0.4)), 2e4, preload=-3e3)
    mechanism = sprung(gas(), pull)
    result = slow(mechanism, revolutions=0.2)
    middle = len(result.time) // 2
    angle = float(result["crank_angle"][middle])
    (torque,) = holding_torque(mechanism, result.scene, {}, np.array([angle]))
    assert abs(torque) > 100.0
    assert result["drive_torque"][middle] == pytest.approx(torque, rel=1e-4)


def test_forces_on_the_frame_are_those_of_the_momentum():
    """Springs on ram, crank and planet: guide, shaft and springs bear weight and inertia."""
    springs = (
        gas(),
        LinearSpring("one", ("crank", GROUND), ((0.03, 0.0), (0.5, 0.1)), 1e4, preload=1e3),
        LinearSpring("two", ("planet", "ram"), ((0.02, 0.1), (0.1, -0.4)), 1e4, preload=1e3),
    )
    mechanism = sprung(*springs)
    result = simulate(Scene(mechanism=mechanism, joints={}, speed_rpm=60.0, revolutions=0.3))
    weight = 9.81 * sum(body.mass for body in mechanism.bodies)
    expected = result["shaking_force"] - np.array([0.0, weight])
    scale = np.abs(result["spring_balance_force"]).max()
    assert result["frame_force"][1:] == pytest.approx(expected[1:], abs=1e-6 * scale)
    assert result.quantity("energy.residual").value < 1e-3


def test_a_damper_dissipates_what_it_takes():
    """Of c v^2 over the stroke, by quadrature over the ideal motion."""
    damped = gas(at=((0.0, -1.2), (0.0, -0.5)), damping=4e4)
    result = simulate(Scene(mechanism=sprung(damped), joints={}, speed_rpm=30.0, revolutions=0.5))
    angle = np.linspace(0.0, np.pi, 2001)
    velocity = sprung(damped).ideal_slider(angle, np.pi)[1]
    expected = np.trapezoid(4e4 * velocity**2, angle / np.pi)
    assert result.quantity("springs.balance.dissipated").value == pytest.approx(expected, rel=1e-3)
    assert result.quantity("energy.residual").value < 1e-3


def test_a_gas_that_vanishes_ends_the_run_at_its_angle():
    """A hundredth of a millimetre is left above the piston with ideal pins, which hang in these."""
    pins = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
    spring = gas(at=((0.0, -1.2), (0.0, -0.5)), volume=0.02 * 0.16001, pressure=1e5, exponent=0.0)
    scene = Scene(
        mechanism=sprung(spring),
        joints={"rod_pin": pins, "wrist_pin": pins},
        contact={"length": 0.05},
        speed_rpm=60.0,
        start_angle_deg=150.0,
        revolutions=0.2,
    )
    result = simulate(scene)
    assert not result.completed
    assert "crank angle 158" in result.info["reason"]
    assert "springs.balance has a volume of" in result.info["reason"]
    assert result["spring_balance_length"].min() == pytest.approx(0.7 - 0.16001, abs=1e-8)


def test_an_end_on_a_flexible_body_beside_its_joints_is_refused():
    with pytest.raises(InputError, match=r"springs\.balance: bodies\.ram is flexible"):
        Scene(
            mechanism=sprung(gas()),
            joints={},
            bodies={"ram": {"flexible": "any.step", "density": 7850.0}},
        )


def test_a_guide_bears_a_spring_that_swings_through():
    """Within a tenth of a millimetre of the ram's way it turns by half a turn: nothing is moved."""
    ends = (-0.05, -0.767), (-0.0499, -0.83)
    spring = LinearSpring("turns", ("ram", GROUND), ends, 1e5, free_length=0.2, damping=100.0)
    mechanism = replace(shipped_mechanism("drag_link"), springs=(spring,))
    scene = Scene(mechanism=mechanism, joints={}, gravity=0.0, speed_rpm=1.0, revolutions=0.5)
    peak = simulate(scene, errors=True).quantity("guides.ram.peak_force")

    beside, expected = 1e-4, 0.0
    angle = np.linspace(0.0, np.pi, 20_001)
    for _ in range(2):  # then near the largest one
        motion = mechanism.motion(angle, np.pi / 30.0)
        height = -0.83 - (motion["ram"].position[:, 1] + 0.00047)
        length = np.hypot(beside, height)
        tilt = np.tan(motion["rod"].position[:, 2])
        force = np.abs(1e5 * (0.2 - length) / length * (beside + height * tilt))
        expected = force.max()
        angle = np.linspace(-1.0, 1.0, 20_001) * angle[1] + angle[force.argmax()]
    assert np.abs(tilt).max() > 0.01, "the rod bears the spring's part along the guide"
    assert peak.value == pytest.approx(expected, rel=1e-3)
    assert abs(peak.value - expected) < peak.error < 0.01 * expected
