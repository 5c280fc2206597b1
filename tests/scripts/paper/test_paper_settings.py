"""What is changed, one at a time."""

from paper.runs import DEFAULT, paper_runs
from paper.settings import FLEXIBLE, SETTINGS, changed
from paper.study import VARIED

RUNS = paper_runs(DEFAULT)


def test_every_setting_changes_one_of_the_runs_at_least():
    for words, changes in SETTINGS.items():
        found = [changed(RUNS[name], changes) for name in VARIED.values()]
        assert any(found), words
    assert all(changed(RUNS["no load, lubricated"], changes) for changes in FLEXIBLE.values())


def test_what_a_scene_does_not_have_is_not_changed():
    dry, lubricated = RUNS["no load, dry, rigid"], RUNS["no load, lubricated, rigid"]
    assert changed(dry, {"film.viscosity": 1.0}) is None
    assert changed(lubricated, {"contact.shape": "cylindrical"}) is None
    assert changed(lubricated, {"load.blanking.rise": 1e-2}) is None
    assert changed(lubricated, {"bodies.crank.modes": 4}) is None
    assert changed(dry, {"gravity": dry.gravity}) is None


def test_multiples_are_of_what_the_scene_has():
    wider = changed(RUNS["clearance 0.2 mm"], SETTINGS["twice the clearance of the balls"])
    assert wider.joints["ball_right"].clearance == 4e-4
    assert wider.joints["crank_pin"].clearance == 2e-4
    stiff = changed(RUNS["no load, dry"], SETTINGS["4 K"])
    assert stiff.contact.stiffness == 4.0 * RUNS["no load, dry"].contact.stiffness
