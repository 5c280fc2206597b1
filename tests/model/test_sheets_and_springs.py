"""A sheet and a spring in a press, against the ideal motion; what is refused."""

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.scene import mechanism_of

SHEET = {
    "kind": "sheet",
    "height": 3e-3,
    "thickness": 2e-3,
    "shear_strength": 3e8,
    "cut_length": 0.2,
    "penetration": 0.4,
    "crack_time": 2e-4,
}
SPRING = {"kind": "spring", "height": 0.02, "travel": [0.0, 5e-4, 0.021], "force": [0, 1e4, 2e4]}


def ideal(load, **keys):
    given = {"mechanism": "slider_crank", "joints": {}, "revolutions": 1.0} | keys
    return Scene(**given, load={"part": load})


@pytest.mark.parametrize("tolerance", [1e-3, 1e-4])
def test_work_is_that_of_the_curve_and_the_crack(tolerance):
    """The area of the curve up to fracture, and the crack's mean force times the ideal way.

    Steps end on the fracture.
    """
    result = simulate(ideal(SHEET, solver={"tolerance": tolerance}))
    mechanism, speed = mechanism_of(result.scene), result.scene.angular_speed
    angle = np.linspace(0.0, np.pi, 2501)
    height = mechanism.ideal_slider(angle, 1.0)[0] - mechanism.bottom
    fracture = np.interp(-(3e-3 - 0.8e-3), -height, angle) / speed
    for instant in (fracture, fracture + 2e-4):
        assert np.abs(result.time - instant).min() < 1e-6
    peak, deep = 3e8 * 0.2 * 2e-3, 0.8e-3
    area = peak * deep * (0.5 * 0.15 * 0.8 + 0.35 * 0.9 + 0.5 * 0.975)
    begin = np.flatnonzero(result["load_part_force"] > 0.94 * peak)[-1]
    time = np.linspace(result.time[begin], result.time[begin] + 2e-4, 1001)
    height = mechanism.ideal_slider(time * speed, 1.0)[0]
    crack = np.trapezoid(0.95 * peak * np.linspace(1.0, 0.0, 1001), -height)
    assert result.quantity("loads.part.work").value == pytest.approx(-area - crack, rel=2e-3)
    assert result.quantity("loads.part.peak_force").value == pytest.approx(peak, rel=1e-4)
    assert result.quantity("energy.residual").value < 1e-3
    assert result.quantity("loads.part.stack_up").value < 1e-9


def test_clearance_stacks_up():
    keys = {"kind": "dry", "clearance": 1e-4}
    scene = ideal(SHEET, joints={"crank_pin": keys}, revolutions=0.08, start_angle_deg=150.0)
    result = simulate(scene)
    assert result.completed
    up = result.quantity("loads.part.stack_up").value
    assert 2e-4 < up < 3e-4  # the clearance's two sides, and the contact's penetrations
    assert result.quantity("loads.part.reverse_force").value > 0.0
    assert result.quantity("energy.residual").value < 1e-3


MOTOR = {"rated_torque": 1e4, "slip": 0.2, "no_load_speed_rpm": 300.0, "inertia": 1.0}


@pytest.mark.parametrize(
    ("mechanism", "keys"),
    [
        ("slider_crank", {"solver.tolerance": 1e-5}),
        ("eccentric_press", {"solver.tolerance": 1e-5}),
        ("slider_crank", {"load.part.crack_time": 2e-6}),
        ("slider_crank", {"load.part.crack_time": 2e-5, "solver.tolerance": 1e-5, "drive": MOTOR}),
    ],
)
def test_other_loads_on_the_output_are_no_pull_of_the_mechanism(mechanism, keys):
    """Rigid links carry just what presses the output, a journal or a socket, beside the sheet.

    Accelerations that oscillate from step to step, the more behind sudden cracks, are no pull.
    """
    constant, reverse = {"kind": "table", "time": [0.0, 1.0], "force": [-1.4e4, -1.4e4]}, 1.4e4
    scene = ideal(SHEET, mechanism=mechanism).replace({"load.constant": constant, **keys})
    result = simulate(scene)
    assert result.quantity("loads.part.reverse_force").value == pytest.approx(reverse, rel=0.01)
    share = result.quantity("loads.part.reverse_share").value
    assert share == pytest.approx(reverse / 1.2e5, rel=0.01)


def test_a_cushion_that_presses_more_than_snaps_back_leaves_no_reverse_load():
    """30 kN hold the slide up: its rod presses on throughout, and gives back 1.8 J meanwhile."""
    keys = {"kind": "dry", "clearance": 5e-5, "radius": 0.07, "friction": {"law": "none"}}
    keys["contact"] = {"shape": "point", "stiffness": 2e9, "exponent": 1.0, "damping": "step"}
    keys["contact"] |= {"damping_max": 1e6, "damping_depth": 1e-6}
    cushion = SPRING | {"travel": [0.0, 5e-4, 0.021], "force": [0.0, 3e4, 3e4]}
    scene = ideal(
        SHEET, joints={"wrist_pin": keys}, speed_rpm=30.0, revolutions=0.1, start_angle_deg=150.0,
        start="centred", solver={"tolerance": 3e-3},
    )  # fmt: skip
    result = simulate(scene.replace({"load.cushion": cushion, "load.part.stripping": 0.05}))
    assert result.quantity("loads.part.reverse_force").value == 0.0
    assert result.quantity("loads.part.snap_through_energy").value == pytest.approx(1.81, rel=0.01)


def test_damping_takes_out_its_integral():
    """Of F d v over the way there and back, with the ideal motion's velocity; else nothing."""
    undamped = simulate(ideal(SPRING))
    stored = 0.5 * 1e4 * 5e-4 + (0.02 - 5e-4) * 0.5 * (1e4 + 1e4 + 1e4 * 19.5 / 20.5)
    assert -undamped["load_part_work"].min() == pytest.approx(stored, rel=1e-3)
    assert abs(undamped.quantity("loads.part.work").value) < 1e-3 * stored
    damped = simulate(ideal(SPRING | {"damping": 0.2}))
    speed = damped.scene.angular_speed
    mechanism = mechanism_of(damped.scene)
    angle = np.linspace(0.0, 2.0 * np.pi, 2001)
    place, velocity, _ = mechanism.ideal_slider(angle, speed)
    travel = np.maximum(0.02 - (place - mechanism.bottom), 0.0)
    force = np.interp(travel, SPRING["travel"], SPRING["force"])
    lost = np.trapezoid(0.2 * force * velocity**2, angle / speed)
    assert -damped.quantity("loads.part.work").value == pytest.approx(lost, rel=5e-3)
    assert damped.quantity("energy.residual").value < 1e-3


def test_a_run_goes_on_in_the_sheet():
    whole = ideal(SHEET)
    angle, speed = whole.start_angle, whole.angular_speed
    position = mechanism_of(whole).ideal_slider(np.linspace(0, 2 * np.pi, 3601) + angle, speed)[0]
    height = position - mechanism_of(whole).bottom
    inside = int(np.flatnonzero(height < 2.6e-3)[0])  # before the fracture
    first = simulate(whole.replace({"revolutions": inside / 3600}))
    rest = whole.replace({"revolutions": 1.0 - inside / 3600})
    second = simulate(rest, start=first.info["state"])
    together = first.quantity("loads.part.work").value + second.quantity("loads.part.work").value
    assert second.quantity("loads.part.peak_force").value > 1.1e5
    assert together == pytest.approx(simulate(whole).quantity("loads.part.work").value, rel=5e-3)


@pytest.mark.parametrize(
    ("load", "changes", "words"),
    [
        (SHEET, {"height": 10.0}, "never leaves it"),
        (SHEET, {"thickness": 8e-3}, "thinner sheet"),
        (SHEET, {"crack_time": None}, "needs crack_time"),
        (SHEET, {"over_peak": [0.0, 1.0]}, "as many of both"),
        (SHEET, {"over_fracture": [0.0, 0.5, 0.5, 1.0]}, "increasing"),
        (SPRING, {"force": [1e4, 1e4, 2e4]}, "preload"),
        (SPRING, {"travel": [0.0, 5e-4, 0.01]}, "as long as that"),
    ],
)
def test_sheets_and_springs_that_are_refused(load, changes, words):
    with pytest.raises(InputError, match=words):
        ideal({k: v for k, v in (load | changes).items() if v is not None})
