"""What a run that stops advises is what helps; what is hard to pass is passed."""

import signal

import pytest
from exudyn.itemInterface import SensorNode

from exu_press import Scene, simulate
from exu_press.mechanism import GROUND, Body, Joint, Mechanism, Output
from exu_press.model import build


def test_fixed_steps_that_fail_in_a_singular_position_are_advised_to_follow_a_tolerance():
    """With one ball of the slide loose, two links of the press line up at the dead centre."""
    scene = Scene(
        mechanism="press",
        speed_rpm=360.0,
        start_angle_deg=179.0,
        revolutions=0.01,
        joints={"slide_joint_left": {"kind": "dry", "clearance": 2e-5}},
        solver={"step": 5e-6},
    )
    stopped = simulate(scene)
    assert stopped.info["status"] == "not converged"
    assert "tolerance" in stopped.info["reason"] and "linearSolver" not in stopped.info["reason"]
    assert simulate(scene.replace({"solver.step": None, "solver.tolerance": 1e-3})).completed


def test_a_body_that_is_too_light_for_its_neighbours_is_named_and_no_tolerance():
    pin = {"kind": "dry", "clearance": 5e-5, "radius": 0.02}
    scene = Scene(
        mechanism="slider_crank",
        joints={"crank_pin": pin, "wrist_pin": pin},
        contact={"length": 0.03},
        slider_crank={"rod_mass": 1e-9, "rod_inertia": 1e-11},
        revolutions=0.02,
    )
    cure = simulate(scene).info["reason"].partition("; try ")[2]
    assert cure.startswith("another value, as this one is hardly meant: bodies.rod.mass = 1e-09 kg")
    assert "tolerance" not in cure
    usual = {"slider_crank.rod_mass": 20.0, "slider_crank.rod_inertia": 0.3}
    assert simulate(scene.replace(usual)).completed


SIZES = {"clearance": 3e-5, "radius": 0.02}
LAWS = {
    "dry": {"contact": {"length": 0.03}},
    "lubricated": {
        "contact": {"length": 0.03},
        "film": {"length": 0.03, "viscosity": 0.05, "at_contact": "mixed", "roughness": 4e-7},
    },
}
GUIDES = [None, {"friction": "coulomb", "mu_kinetic": 0.1}, {"clearance": 5e-5, "length": 0.2}]


@pytest.mark.parametrize("guide", GUIDES, ids=["ideal", "rubbing", "loose"])
@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("start", ["centred", "loaded"])
def test_the_first_instants_are_passed_at_all_tolerances(start, kind, guide):
    """In the middle of a film, in a gap, and with surfaces that touch from the first instant on."""
    scene = Scene(
        mechanism="slider_crank",
        speed_rpm=60.0,
        start_angle_deg=40.0,
        revolutions=0.004,
        start=start,
        joints={"crank_pin": {"kind": kind, **SIZES}},
        guide=guide,
        **LAWS[kind],
    )
    for tolerance in (1e-2, 1e-5):
        assert simulate(scene.replace({"solver.tolerance": tolerance})).completed, tolerance


CRANKS = Mechanism(
    name="three_cranks",
    bodies=(
        Body("crank", 1.0, 0.02, (0.1350755, 0.2103675)),
        Body("coupler", 2.0, 0.3, (0.770151, 0.520735)),
        Body("rocker", 1.5, 0.03, (1.1350755, 0.2103675)),
        Body("middle", 1.5, 0.03, (0.6350755, 0.5103675)),
    ),
    joints=(
        Joint("shaft", (0.0, 0.0), "crank", GROUND),
        Joint("pin", (0.270151, 0.420735), "crank", "coupler"),
        Joint("knuckle", (1.270151, 0.420735), "coupler", "rocker"),
        Joint("pivot", (1.0, 0.0), "rocker", GROUND),
        Joint("pin2", (0.770151, 0.720735), "coupler", "middle"),
        Joint("pivot2", (0.5, 0.3), "middle", GROUND),
    ),
    guides=(),
    crank="crank",
    output=Output("coupler", (1.0, 0.0)),
)


@pytest.mark.parametrize("tolerance", [2.5e-4, pytest.param(1e-3, marks=pytest.mark.long)])
def test_one_dry_pin_carries_parallel_cranks_over(tolerance):
    """Omega^2 r is 78.957 m/s^2. Finer steps stopped at 302.7 deg, with thousands of m/s^2."""
    run = simulate(
        Scene(
            mechanism=CRANKS,
            speed_rpm=120.0,
            start_angle_deg=300.0,
            revolutions=6.0 / 360.0,
            joints={"pin2": {"kind": "dry", "radius": 0.02, "clearance": 5e-5}},
            contact={"length": 0.03},
            solver={"tolerance": tolerance},
        )
    )
    assert run.completed
    peak = run.quantity("peak_acceleration.resolved").value
    assert peak == pytest.approx(78.957, rel=1e-3)


def test_ctrl_c_while_a_model_is_built_is_no_error_of_exudyn(monkeypatch):
    """Exudyn makes an error of its own of what the Python code of its items raises."""

    def interrupt(item):
        signal.raise_signal(signal.SIGINT)
        yield from ()

    monkeypatch.setattr(SensorNode, "__iter__", interrupt)
    with pytest.raises(KeyboardInterrupt):
        build(Scene(mechanism="slider_crank", joints={}))
