"""Runs of presses under force tables, and through change points: they end, and energy closes."""

import numpy as np
import pytest
from pressed import FORMING

from exu_press import Scene, simulate
from exu_press.mechanism import Body, Joint, Mechanism, Output
from exu_press.mechanism.parts import GROUND

DRAWING = {**FORMING, "offset": [0.05, 0.0]}
CUSHION = {"kind": "table", "height": [0.0, 0.02], "force": [40e3, 0.0], "acts": "both"}
PRESS = {"mechanism": "eccentric_press", "speed_rpm": 60.0}


@pytest.mark.parametrize("acts", ["closing", pytest.param("both", marks=pytest.mark.long)])
def test_dry_pins_from_the_bottom_at_a_coarse_tolerance(acts):
    """Impacts under a table load, where Newton's iterates go astray and steps are repeated."""
    pins = {"crank_pin": "dry", "wrist_pin": "dry"}
    coarse = {"start_angle_deg": 180.0, "revolutions": 0.04, "solver": {"tolerance": 3e-3}}
    result = simulate(
        Scene(**PRESS, joints=pins, load={"drawing": {**DRAWING, "acts": acts}}, **coarse)
    )
    assert result.completed, result.info["reason"]
    assert result.info["rejected_steps"] > 10
    assert result.quantity("energy.residual").value < 1e-4
    work = result.quantity("loads.drawing.work").value
    if acts == "closing":
        assert abs(work) < 1.0
    else:  # the ram rises by a millimetre
        risen = np.linspace(0.0, np.ptp(result["slider_position"]), 1000)
        force = np.interp(risen, FORMING["height"], FORMING["force"])
        assert work == pytest.approx(force.mean() * risen[-1], rel=2e-3)


def test_a_cushion_gives_back_what_it_takes():
    """A spring of 2e6 N/m under the ram, from 15 degrees before the bottom to 15 behind it."""
    result = simulate(
        Scene(
            **PRESS,
            joints={"crank_pin": "lubricated", "balls": "dry"},
            film={"at_contact": "mixed"},
            load={"drawing": DRAWING, "cushion": CUSHION},
            start_angle_deg=165.0,
            revolutions=30.0 / 360.0,
        )
    )
    assert result.completed, result.info["reason"]
    stored = (
        0.5
        * 2e6
        * (0.02**2 - (0.02 - (result["slider_position"][0] - result["slider_position"].min())) ** 2)
    )
    assert abs(result["load_cushion_work"]).max() == pytest.approx(stored, rel=0.05)
    assert abs(result.quantity("loads.cushion.work").value) < 0.05 * stored
    assert result.quantity("loads.drawing.work").value < -200.0
    assert result.quantity("energy.residual").value < 1e-3


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
