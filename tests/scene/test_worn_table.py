"""[joints.NAME.worn]: read, saved, run, and what is refused."""

import numpy as np
import pytest

from exu_press import Scene, simulate

ANGLES = np.arange(24) * 15.0
DENT = (1e-5 * np.cos(np.radians(ANGLES - 40.0) / 2.0) ** 4).tolist()


def scene(worn, **keys):
    joint = {"kind": "dry", "worn": worn, **keys}
    return Scene(mechanism="slider_crank", joints={"crank_pin": joint}, revolutions=0.05)


def test_angles_that_are_left_out_are_even():
    tables = {"angle_deg": ANGLES.tolist(), "bearing_depth": DENT}, {"bearing_depth": DENT}
    given, even = (scene(table).joints["crank_pin"].worn.whole()[1] for table in tables)
    for angle in np.linspace(-4.0, 9.0, 50):
        assert given.derivatives(angle) == pytest.approx(
            even.derivatives(angle), rel=1e-9, abs=1e-15
        )


def test_the_gap_of_worn_surfaces_is_recorded_and_the_energy_closes():
    """A loaded start lies on the surface, where the first step finds its force."""
    run = simulate(scene({"bearing_depth": DENT, "journal_depth": DENT[::-1]}))
    joint = run.joints["crank_pin"]
    touching = joint.gap < 0.0
    assert touching[0] and touching.mean() > 0.5
    assert np.abs(joint.gap - (joint.clearance - joint.distance)).max() > 1e-7
    assert abs(run.quantity("energy.residual").value) < 1e-4
    force = np.linalg.norm(joint.force, axis=1)
    assert force[0] == pytest.approx(force[1], rel=0.1)


@pytest.mark.parametrize("at_contact", ["stop", "mixed"])
def test_a_film_between_worn_surfaces_closes_its_energy_and_is_thinner(at_contact):
    """The journal's own dent turns through the bearing's; the load stays that of the motion."""
    film = {"law": "finite", "viscosity": 0.05, "length": 0.1, "at_contact": at_contact}
    joint = {"kind": "lubricated", "clearance": 1e-4, "radius": 0.07}
    round_one = Scene(
        mechanism="slider_crank", joints={"crank_pin": joint}, film=film, revolutions=0.3
    )
    worn = {"bearing_depth": DENT, "journal_depth": DENT[::-1]}
    runs = [
        simulate(one) for one in (round_one, round_one.replace({"joints.crank_pin.worn": worn}))
    ]
    forces = [run.quantity("joints.crank_pin.peak_force").value for run in runs]
    assert forces[1] == pytest.approx(forces[0], rel=1e-2)
    assert abs(runs[1].quantity("energy.residual").value) < 1e-4
    assert 0.0 < runs[1].joints["crank_pin"].gap.min() < runs[0].joints["crank_pin"].gap.min()
