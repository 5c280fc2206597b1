"""Parallel cranks pass their change points, where ideal joints are nearly redundant."""

import pytest

from exu_press import Scene, simulate
from exu_press.mechanism import Body, Joint, Mechanism, Output
from exu_press.mechanism.parts import GROUND

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
