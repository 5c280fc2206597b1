"""Keys of laws that the chosen law does not use are refused, and dropped by a change."""

import pytest

from exu_press import InputError, Scene
from exu_press.laws.contact import DAMPING_LAWS
from exu_press.scene.contact import DAMPING
from exu_press.scene.friction import FRICTION
from exu_press.scene.usage import LAWS
from exu_press.schema.table import plain

PIN = {"kind": "dry", "clearance": 5e-5, "radius": 0.03}
BASE = {"mechanism": "slider_crank", "joints": {"crank_pin": PIN}, "contact": {"length": 0.05}}
MIXED = {**PIN, "kind": "lubricated", "film": {"at_contact": "mixed"}}


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


def test_a_ball_has_no_cylindrical_contact_of_its_own():
    with pytest.raises(InputError, match=r"joints\.balls\.contact\.shape = 'cylindrical': a ball"):
        Scene().replace({"joints.balls": "dry", "joints.balls.contact.shape": "cylindrical"})
    scene = Scene(joints={"balls": "dry", "crank_pin": "dry"}, contact={"shape": "cylindrical"})
    assert Scene.from_dict(scene.to_dict()) == scene, "that of the pins may stand in [contact]"


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
