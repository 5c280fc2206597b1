"""What a run that stops advises is what helps."""

from exu_press import Scene, simulate


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
