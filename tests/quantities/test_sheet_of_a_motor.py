"""What a sheet releases is told apart from the crank that its force slows down."""

import numpy as np

from exu_press import Scene, simulate

SHEET = {
    "kind": "sheet",
    "height": 3e-3,
    "thickness": 2e-3,
    "shear_strength": 3e8,
    "cut_length": 0.02,
    "penetration": 0.4,
    "crack_time": 2e-4,
}


def test_a_crank_that_a_sheet_slows_down_pulls_nothing():
    """With ideal joints the output is where its crank has it: nothing is stored, none returns."""
    result = simulate(
        Scene(
            mechanism="slider_crank",
            joints={},
            revolutions=1.0,
            drive={"rated_torque": 30.0, "inertia": 0.5},
            load={"part": SHEET},
            solver={"tolerance": 1e-4},
        )
    )
    assert result.completed
    falls = np.ptp(result["crank_speed"]) / result["crank_speed"].mean()
    assert falls > 0.05  # a light flywheel
    assert result.quantity("loads.part.peak_force").value > 1e4
    assert result.quantity("loads.part.reverse_share").value < 0.02
    assert result.quantity("loads.part.stack_up").value < 1e-8
