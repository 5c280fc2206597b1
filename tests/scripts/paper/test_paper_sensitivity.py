"""Settings that scenes accept, and tornados of known effects."""

import json

import pytest

from paper.damping import with_damping
from paper.plan import Plan
from paper.published import published
from paper.runs import paper_runs, rigid_twin
from paper.sensitivity import tornado_of
from paper.settings import FLEXIBLE, SETTINGS, Setting, Times

RUNS = paper_runs()


@pytest.mark.parametrize(
    "name",
    [
        "no load, dry, flexible",
        "no load, lubricated, flexible",
        "10 kN, lubricated, flexible",
        "clearance 0.2 mm",
        "500 rpm",
        "blanking 40 kN",
    ],
)
def test_every_setting_that_applies_makes_a_scene_of_its_own(name):
    scene = rigid_twin(RUNS[name])
    for setting in SETTINGS:
        if setting.applies(scene) and setting.changes:
            changed = setting.on(scene).to_dict()
            assert changed != scene.to_dict(), setting
            json.dumps(changed)


def test_settings_on_flexible_bodies():
    for setting in FLEXIBLE:
        assert setting.applies(RUNS["clearance 0.2 mm"])
        setting.on(RUNS["clearance 0.2 mm"])


def test_what_a_scene_does_not_have_is_not_varied():
    dry = rigid_twin(RUNS["no load, dry, flexible"])
    lubricated = rigid_twin(RUNS["no load, lubricated, flexible"])
    loaded = rigid_twin(RUNS["blanking 40 kN"])
    varied = {s.factor for s in SETTINGS if s.applies(dry)}
    assert "viscosity, A-11" not in varied and "pin's contact" in varied
    pulse = next(s for s in SETTINGS if s.factor.startswith("blanking pulse"))
    assert pulse.applies(loaded) and not pulse.applies(lubricated)


def test_what_a_scene_is_already_is_not_varied():
    scene = rigid_twin(RUNS["clearance 0.2 mm"])
    printed = next(s for s in SETTINGS if s.words == "contact damping c_max = 2.5545e8")
    assert not printed.applies(scene)
    assert printed.applies(with_damping(scene, "0.01"))


def test_every_assumption_is_varied_but_the_topology():
    factors = " ".join(setting.factor for setting in SETTINGS)
    for number in range(2, 15):
        assert f"A-{number}" in factors, number


def test_multiples_are_of_what_the_scene_has():
    twice = Setting("", "", {"joints.balls.clearance": Times(2.0)})
    assert twice.on(RUNS["clearance 0.05 mm"]).joints["ball_left"].clearance == pytest.approx(1e-4)


def row(acceleration):
    if acceleration is None:
        return {"status": "time limit", "reason": "", "readings": None}
    return {
        "status": "completed",
        "readings": {
            "peak_acceleration": {
                "resolved": 10.0 * acceleration,
                "mean_1ms": acceleration,
                "differentiated_1khz": 0.9 * acceleration,
            }
        },
    }


def test_a_tornado_of_known_effects():
    number = next(n for n in published().numbers if n.name == "acceleration_lubricated")
    runs = [
        (Setting("weak", "low"), row(19.0)),
        (Setting("strong", "low"), row(10.0)),
        (Setting("strong", "high"), row(28.0)),
        (Setting("failed", "high"), row(None)),
        (Setting("observation model", "resolved", model="resolved"), row(20.0)),
    ]
    tornado = tornado_of(number, "rigid", row(20.0), runs)
    assert list(tornado.factors()) == ["observation model", "strong", "weak", "failed"]
    assert tornado.nearest().value == 28.0
    report = tornado.to_dict()
    assert [factor["swing"] for factor in report["factors"]] == pytest.approx([180, 18, 1, 0])
    strong = report["factors"][1]["settings"]
    assert [setting["change"] for setting in strong] == pytest.approx([-0.5, 0.4])
    assert report["factors"][3]["settings"][0]["status"] == "time limit"
    assert tornado_of(number, "rigid", row(None), runs) is None


def test_observed_from_the_start_on():
    number = next(n for n in published().numbers if n.name == "acceleration_lubricated")
    baseline = {**row(20.0), "whole": row(31.0)["readings"]}
    tornado = tornado_of(
        number, "rigid", baseline, [(Setting("span", "all", whole_run=True), baseline)]
    )
    assert (tornado.baseline, tornado.effects[0].value) == (20.0, 31.0)


def test_equal_runs_are_planned_once():
    plan = Plan()
    scene = {"speed_rpm": 240.0}
    first = plan.add({"scene": scene})
    assert plan.add({"scene": dict(scene), "save": "a.nc"}) == first
    assert plan.add({"scene": dict(scene), "save": "b.nc"}) == first
    assert plan.add({"scene": {"speed_rpm": 200.0}}) != first
    assert [task.get("save") for task in plan.tasks] == ["a.nc", None]
