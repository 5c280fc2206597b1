"""[joints.NAME]: every joint of the mechanism, with its laws, its oil and its worn surfaces."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.scene import mechanism_of
from exu_press.scene.oil import Oil
from exu_press.scene.warnings import scene_warnings
from exu_press.schema.table import plain


def press(**joints):
    return Scene(joints=joints)


def test_a_group_stands_for_its_joints():
    balls = {"balls": {"kind": "dry", "clearance": 5e-5}, "ball_left": {"clearance": 2e-4}}
    assert press(**balls).joints["ball_left"].clearance == 2e-4, "its own go before"
    assert press(**balls).joints["ball_right"].clearance == 5e-5
    scene = press(knuckles={"kind": "dry", "clearance": 5e-5})
    loose = scene.joints.with_clearance
    assert len(loose) == 4
    assert all(name.startswith("knuckle_") and j.clearance == 5e-5 for name, j in loose.items())
    assert list(scene.joints.by_group) == ["knuckles"]


def test_own_laws_differ_from_the_scenes():
    scene = Scene(
        joints={
            "crank_pin": {"kind": "lubricated", "film": {"law": "pi_film"}},
            "slide_pin": "lubricated",
            "balls": {"kind": "dry", "contact": {"damping": "flores"}, "friction": {"law": "none"}},
            "pivots": "dry",
        },
        film={"viscosity": 0.1},
    )
    films = scene.joints["crank_pin"].film, scene.joints["slide_pin"].film
    assert [(film.law.kind, film.viscosity) for film in films] == [
        ("pi_film", 0.1),
        ("finite", 0.1),
    ]
    assert scene.joints["ball_left"].contact.damping.kind == "flores"
    kept = {key: value for key, value in scene.contact.items() if key != "restitution"}
    assert plain(scene.joints["pivot_left"].contact) == kept
    given = scene.to_dict()["joints"]
    assert given["crank_pin"]["film"] == {"law": "pi_film"}, "nothing but the difference"
    assert "film" not in given["slide_pin"]
    assert Scene.from_dict(scene.to_dict()) == scene


def test_contact_and_friction_of_a_film_only_where_it_is_mixed():
    assert press(crank_pin="lubricated").joints["crank_pin"].contact is None
    mixed = Scene(joints={"crank_pin": "lubricated"}, film={"at_contact": "mixed"})
    assert plain(mixed.joints["crank_pin"].contact) == mixed.contact
    assert mixed.joints["crank_pin"].onset == pytest.approx(6e-7)


def test_a_joint_in_two_groups_is_refused():
    """The press has no such groups; a mechanism may."""
    groups = {"both": ("shaft", "crank_pin"), "some": ("shaft",)}
    mechanism = replace(mechanism_of(Scene()), groups=groups)
    with pytest.raises(InputError, match="shaft lies in both"):
        Scene(mechanism=mechanism, joints={"both": "dry", "some": "ideal"})


OIL = {"viscosity_cst": [68.0, 8.7], "density": 870.0, "supply_celsius": 40.0, "conductance": 5.0}


def scene_of(**keys):
    given = {"mechanism": "slider_crank", "joints": {"crank_pin": "lubricated"}}
    return Scene(**(given | {"film": {"oil": OIL}} | keys))


def film_of(scene, joint="crank_pin"):
    return scene.joints[joint].film


def test_joints_have_oils_of_their_own():
    own = {"kind": "lubricated", "film": {"oil": {"conductance": 1.0}}}
    constant = {"kind": "lubricated", "film": {"viscosity": 0.2}}
    scene = scene_of(joints={"crank_pin": own, "shaft": constant, "wrist_pin": "lubricated"})
    assert film_of(scene).oil == Oil(**(OIL | {"conductance": 1.0}))
    assert film_of(scene).cold_viscosity == pytest.approx(68e-6 * 870.0)
    warmer = scene.replace({"film.oil.supply_celsius": 55.0})
    assert film_of(warmer, "wrist_pin").oil == Oil(**(OIL | {"supply_celsius": 55.0}))
    assert (film_of(scene, "shaft").viscosity, film_of(scene, "shaft").oil) == (0.2, None)
    assert film_of(scene, "wrist_pin").oil == Oil(**OIL)
    assert Scene.from_dict(scene.to_dict()) == scene
    only_there = Scene(
        mechanism="slider_crank", joints={"crank_pin": {"kind": "lubricated", "film": {"oil": OIL}}}
    )
    assert only_there.film["viscosity"] == 0.4
    assert film_of(only_there).oil == Oil(**OIL)
    assert Scene.from_dict(only_there.to_dict()) == only_there
    balls = scene_of(mechanism="press", joints={"crank_pin": "lubricated", "balls": constant})
    assert balls.joints["ball_left"].film.cold_viscosity == 0.2
    assert scene_warnings(balls) == []


ANGLES = np.arange(24) * 15.0
DENT = (1e-5 * np.cos(np.radians(ANGLES - 40.0) / 2.0) ** 4).tolist()


def worn_scene(worn, **keys):
    joint = {"kind": "dry", "worn": worn, **keys}
    return Scene(mechanism="slider_crank", joints={"crank_pin": joint}, revolutions=0.05)


def test_angles_that_are_left_out_are_even():
    tables = {"angle_deg": ANGLES.tolist(), "bearing_depth": DENT}, {"bearing_depth": DENT}
    given, even = (worn_scene(table).joints["crank_pin"].worn.whole()[1] for table in tables)
    for angle in np.linspace(-4.0, 9.0, 50):
        assert given.derivatives(angle) == pytest.approx(
            even.derivatives(angle), rel=1e-9, abs=1e-15
        )


def test_the_gap_of_worn_surfaces_is_recorded_and_the_energy_closes():
    """A loaded start lies on the surface, where the first step finds its force."""
    run = simulate(worn_scene({"bearing_depth": DENT, "journal_depth": DENT[::-1]}))
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
