"""A start from which a run completes at one tolerance, it leaves at finer ones, too."""

import pytest

from exu_press import Scene, simulate

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
    for tolerance in (1e-2, 1e-3, 1e-4, 1e-5):
        assert simulate(scene.replace({"solver.tolerance": tolerance})).completed, tolerance
