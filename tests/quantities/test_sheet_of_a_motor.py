"""What a sheet releases is told apart from a crank that gathers speed."""

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


def test_a_crank_that_a_motor_speeds_up_is_no_reverse_load():
    """With ideal joints the output is where its crank has it: nothing is stored, none returns.

    Beside the motion of a crank of constant speed it would be 0.23 of the largest load.
    """
    result = simulate(
        Scene(
            mechanism="slider_crank",
            joints={},
            revolutions=1.0,
            drive={"rated_torque": 1e3, "slip": 0.2, "no_load_speed_rpm": 300.0, "inertia": 1.0},
            load={"part": SHEET},
            solver={"tolerance": 1e-4},
        )
    )
    assert result.completed
    assert result.quantity("loads.part.peak_force").value > 1e4
    assert result.quantity("loads.part.reverse_share").value < 0.01
    assert result.quantity("loads.part.stack_up").value < 1e-8
