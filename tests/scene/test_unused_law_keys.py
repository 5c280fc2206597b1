"""Keys of laws that the chosen law does not use are refused, and dropped by a change."""

import pytest

from exu_press import InputError, Scene
from exu_press.laws.contact import DAMPING_LAWS
from exu_press.scene.contact import DAMPING
from exu_press.scene.friction import FRICTION
from exu_press.scene.usage import LAWS
from exu_press.schema.table import plain

PIN = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
TABLE = {"table_speed_rpm": [0, 300], "table_torque": [9, 0], "inertia": 9.0}
RUBBING = {"friction": "coulomb"}
BASE = {"mechanism": "slider_crank", "joints": {"crank_pin": PIN}, "contact": {"length": 0.05}}
STEP = {"length": 0.05, "damping": "step", "damping_max": 1e5, "damping_depth": 1e-6}
MIXED = {**PIN, "kind": "lubricated", "film": {"at_contact": "mixed"}}


@pytest.mark.parametrize(
    ("change", "name", "reason"),
    [
        ({"contact": {**STEP, "restitution": 0.7}}, "contact.restitution", "damping is 'step'"),
        ({"contact": {**STEP, "restitution": 0.9}}, "contact.restitution", "damping is 'step'"),
        ({"contact": {"damping": "hu_guo", "damping_max": 1e5}}, "contact.damping_max",
         "(contact.damping is 'hu_guo'; it belongs to 'step')"),
        ({"contact": {"shape": "point", "length": 0.1}}, "contact.length", "shape is 'point'"),
        ({"contact": {"length": 0.1, "stiffness": 1e9}}, "contact.stiffness", "to 'point'"),
        (
            {"contact": {"shape": "point", "stiffness": 1e9, "modulus": 1e11}},
            "contact.modulus",
            "contact.stiffness is given",
        ),
        ({"friction": {"law": "none", "mu_static": 0.1}}, "friction.mu_static", "law is 'none'"),
        ({"friction": {"law": "coulomb", "mu_static": 0.1}}, "friction.mu_static", "'coulomb'"),
        ({"friction": {"sigma_0": 1e5}}, "friction.sigma_0", "friction.law is 'coulomb'"),
        (
            {"friction": {"law": "lugre", "regularisation_velocity": 1e-3}},
            "friction.regularisation_velocity",
            "friction.law is 'lugre'",
        ),
        (
            {"joints": {"crank_pin": {**PIN, "friction": {"law": "none", "mu_kinetic": 0.2}}}},
            "joints.crank_pin.friction.mu_kinetic",
            "(joints.crank_pin.friction.law is 'none'",
        ),
        (
            {"joints": {"crank_pin": {**PIN, "friction": {"mu_static": 0.2}}}},
            "joints.crank_pin.friction.mu_static",
            "(friction.law is 'coulomb'",
        ),
        (
            {"friction": {"law": "lugre_steady", "regularisation_velocity": 1e-4},
             "joints": {"crank_pin": {**PIN, "friction": {"law": "lugre"}}}},
            "friction.regularisation_velocity",
            "(joints.crank_pin.friction.law is 'lugre'",
        ),
        ({"solver": {"step": 1e-5, "max_step_deg": 1.5}}, "solver.max_step_deg", "solver.step"),
        (
            {"drive": {**TABLE, "slip": 0.05}},
            "drive.slip",
            "drive.table_torque is given",
        ),
        ({"guide": {**RUBBING, "width": 0.0}}, "guide.width", "guide.clearance is not given"),
        (
            {"joints": {"crank_pin": {**PIN, "kind": "lubricated"}}, "contact": None,
             "film": {"viscosity": 0.1, "length": 0.05, "roughness": 1e-7}},
            "film.roughness",
            "film.at_contact is 'stop'",
        ),
    ],
)  # fmt: skip
def test_an_unused_key_is_refused(change, name, reason):
    with pytest.raises(InputError, match="not used by this scene") as refused:
        Scene.from_dict({**BASE, **change})
    assert str(refused.value).startswith(f"{name} = ")
    assert reason in str(refused.value)


def test_a_key_that_one_joint_uses_is_not_refused():
    joints = {
        "crank_pin": {**PIN, "friction": {"law": "lugre"}},
        "wrist_pin": {**PIN, "friction": {"law": "none"}},
    }
    scene = Scene.from_dict({**BASE, "joints": joints, "friction": {"sigma_0": 2e5}})
    assert scene.joints["crank_pin"].friction.law.sigma_0 == 2e5
    assert plain(scene.joints["wrist_pin"].friction) == {"law": "none"}
    assert Scene.from_dict(scene.to_dict()) == scene


def test_a_change_drops_what_is_no_longer_used_but_not_what_it_names():
    scene = Scene.from_dict({**BASE, "friction": {"law": "lugre", "sigma_0": 2e5}})
    coulomb = scene.replace({"friction.law": "coulomb"})
    assert "sigma_0" not in coulomb.friction
    assert scene.replace({"joints.crank_pin": "ideal"}).friction is None
    with pytest.raises(InputError, match=r"friction\.sigma_0 = 300000\.0: not used"):
        scene.replace({"friction.law": "coulomb", "friction.sigma_0": 3e5})
    with pytest.raises(InputError, match=r"friction\.sigma_0 = 300000\.0: not used"):
        scene.replace({"friction": {"law": "coulomb", "sigma_0": 3e5}})


def test_keys_of_a_group_may_be_used_by_some_of_its_joints():
    scene = Scene.from_dict({"joints": {"balls": {"kind": "dry", "contact": {"stiffness": 1e9}}}})
    assert scene.joints["ball_left"].contact.elasticity.stiffness == 1e9
    with pytest.raises(InputError, match=r"joints\.balls\.contact\.length = 0\.1: not used"):
        Scene.from_dict({"joints": {"balls": {"kind": "dry", "contact": {"length": 0.1}}}})


def test_every_choice_says_which_keys_it_uses():
    assert set(DAMPING) == set(DAMPING_LAWS)


@pytest.mark.parametrize("law", FRICTION)
def test_a_complete_scene_can_be_given_again(law, tmp_path):
    scene = Scene.from_dict({**BASE, "joints": {"crank_pin": MIXED},
                             "film": {"viscosity": 0.1, "length": 0.05}, "contact": {},
                             "friction": {"law": law}})  # fmt: skip
    assert Scene.from_dict(scene.to_dict()) == scene
    assert scene.replace({}) == scene
    assert Scene(**{name: getattr(scene, name) for name in ("mechanism", "joints", *LAWS)}) == scene
