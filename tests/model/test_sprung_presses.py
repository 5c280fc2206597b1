"""Springs between bodies in runs: period, work, torque to hold, forces on guides and frame."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import exu_press
from exu_press import InputError, Scene, simulate
from exu_press.mechanism import GROUND, Body, Guide, Joint, Mechanism, Output, shipped_mechanism
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


@pytest.mark.parametrize("damping", [0.0, 20.0])
def test_a_mass_on_a_spring_has_its_period_and_its_decay(damping):
    """A slide on a long rod of 1 kg, free across: omega^2 = k / (m + m_rod / 3), without weight."""
    pin, slide = (0.0, 10.001), (0.0, 0.001)
    spring = LinearSpring(
        "side", ("slide", GROUND), (slide, (1.0, 0.001)), 1e4, free_length=1.001, damping=damping
    )
    mechanism = Mechanism(
        "pendulum",
        (
            Body("crank", 1.0, 1.0, (0.0, 10.0)),
            Body("rod", 1.0, centre_of_mass=(0.0, 5.001)),
            Body("slide", 10.0, 1.0, slide),
        ),
        (
            Joint("shaft", (0.0, 10.0), "crank", GROUND),
            Joint("pin", pin, "crank", "rod"),
            Joint("wrist", slide, "rod", "slide"),
        ),
        (Guide("slide"),),
        "crank",
        Output("slide"),
        springs=(spring,),
    )
    guide = {"lateral_stiffness": 1e-3, "lateral_damping": 0.0, "tilting_damping": 0.0, "length": 1}
    scene = Scene(
        mechanism=mechanism,
        joints={},
        speed_rpm=0.01,
        revolutions=0.5 / 6000,
        gravity=0.0,
        guide=guide,
        solver={"step": 5e-4},
    )
    result = simulate(scene)
    assert result.completed, result.info["reason"]
    mass = 10.0 + 1.0 / 3.0
    decay, omega = damping / (2.0 * mass), np.sqrt(1e4 / mass - (damping / (2.0 * mass)) ** 2)
    t = result.time
    x = 1e-3 * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
    assert omega * t[-1] > 2.0 * np.pi
    assert result["slider_lateral"] == pytest.approx(x - 1e-3, abs=3e-6)
    assert result["spring_side_length"] == pytest.approx(1.001 - x, abs=3e-6)
    assert result.quantity("springs.side.peak_force").value == pytest.approx(10.0, rel=1e-3)


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


@pytest.mark.parametrize("rest", [1e-2, pytest.param(1e-5, marks=pytest.mark.long)])
def test_a_gas_spring_that_nearly_bottoms_keeps_the_energy(rest):
    """All but this share of the gas is pressed together: its peak is the polytropic one."""
    spring = gas(at=((0.0, -1.2), (0.0, -0.5)), volume=0.02 * 0.16 * (1.0 + rest))
    result = simulate(Scene(mechanism=sprung(spring), joints={}, speed_rpm=60.0))
    expected = 0.02 * (5e5 * (1.0 + 1.0 / rest) ** 1.3 - 101325.0)
    peak = result.quantity("springs.balance.peak_force").value
    assert peak == pytest.approx(expected, rel=2e-3)
    assert result.quantity("energy.residual").value < 5e-3


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


@pytest.mark.long
def test_a_spring_on_the_joint_of_a_flexible_rod():
    """Of steel, it hardly gives way: the force of the spring is that on a rigid one."""
    pytest.importorskip("ngsolve")
    ends = (0.043, -0.595), (0.543, -1.295)
    spring = LinearSpring("side", ("rod", GROUND), ends, 2e5, preload=3e4)
    mechanism = replace(shipped_mechanism("six_bar"), springs=(spring,))
    step = Path(exu_press.__file__).parent / "scenes" / "six_bar_rod.step"
    keys = {"speed_rpm": 60.0, "revolutions": 0.05, "joints": {}}
    rigid = simulate(Scene(mechanism=mechanism, **keys))
    bodies = {"rod": {"flexible": str(step), "modes": 8}}
    flexible = simulate(Scene(mechanism=mechanism, bodies=bodies, **keys))
    for result in (rigid, flexible):
        assert result.completed, result.info["reason"]
        assert result.quantity("energy.residual").value < 1e-3
    peaks = [run.quantity("springs.side.peak_force").value for run in (rigid, flexible)]
    assert peaks[1] == pytest.approx(peaks[0], rel=1e-3)
    assert peaks[0] > 3.02e4, "it stretches"


def test_an_end_on_a_flexible_body_beside_its_joints_is_refused():
    with pytest.raises(InputError, match=r"springs\.balance: bodies\.ram is flexible"):
        Scene(
            mechanism=sprung(gas()),
            joints={},
            bodies={"ram": {"flexible": "any.step", "density": 7850.0}},
        )
