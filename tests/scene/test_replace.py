"""scene.replace: the same scene with other values, of its drawing and flexible bodies too."""

import re

import pytest
from refused import refused

from exu_press import InputError, Scene
from exu_press.scene import Flexible
from exu_press.scene.scene import mechanism_of
from exu_press.scene.solver import Solver
from exu_press.schema.table import table_from

PRESS = Scene()
TABLE_LOAD = {"kind": "table", "time": [0.0, 1.0], "force": [0.0, 1.0]}


def test_what_a_change_names_is_replaced_and_all_else_is_kept():
    changed = PRESS.replace({"film.viscosity": 0.1, "speed_rpm": 200.0}).replace(
        {"film.length": 0.05}
    )
    film = changed.film
    assert (film["viscosity"], film["length"], changed.speed_rpm) == (0.1, 0.05, 200.0)
    assert PRESS.film["viscosity"] == 0.4, "the original stays as it is"
    assert changed.replace({"film.viscosity": 0.4, "film.length": 0.1, "speed_rpm": 240.0}) == PRESS
    assert PRESS.replace({}) == PRESS
    assert PRESS.replace({"guide.clearance": 4e-5}).guide.clearance == 4e-5, "a new table"
    stepped = PRESS.replace({"solver.step": 1e-4}).replace({"solver.spectral_radius": 0.7})
    assert stepped.replace({"joints.crank_pin": "dry"}).solver == stepped.solver
    assert stepped.solver.step == 1e-4
    worn = {"joints.crank_pin": "dry", "joints.crank_pin.worn.bearing_depth": [0.0, 1e-6, 0.0]}
    assert PRESS.replace(worn).joints["crank_pin"].worn.bearing_depth == (0.0, 1e-6, 0.0)


def test_made_dry_it_loses_its_film_and_made_ideal_everything():
    dry = PRESS.replace({"joints.crank_pin": "dry"})
    assert dry.film is None
    assert dry.joints["crank_pin"].clearance == PRESS.joints["crank_pin"].clearance
    ideal = dry.replace({"joints.crank_pin": "ideal", "joints.balls": "ideal"})
    assert not ideal.joints.with_clearance
    assert ideal.contact is ideal.friction is None
    assert dry.replace({"joints.crank_pin": "lubricated"}) == PRESS
    other = PRESS.replace({"mechanism": "slider_crank"})
    assert other.press is None and other.replace({"mechanism": "press"}) == PRESS


def test_a_joints_own_law_follows_the_scenes_where_it_says_nothing():
    own = PRESS.replace({"joints.crank_pin.film.law": "pi_film"}).replace({"film.viscosity": 0.1})
    film = own.joints["crank_pin"].film
    assert (film.law.kind, film.viscosity, own.film["law"]) == ("pi_film", 0.1, "finite")
    stopped = own.replace({"film.at_contact": "mixed", "joints.crank_pin.friction.law": "none"})
    assert stopped.joints["crank_pin"].friction.law.kind == "none"
    assert stopped.replace({"film.at_contact": "stop"}).joints["crank_pin"].friction is None
    oil = {"viscosity_cst": (68.0, 8.7), "density": 870.0, "supply_celsius": 40.0}
    shared = {"film.law": "finite", "film.viscosity": None, "film.oil": oil}
    warm = PRESS.replace({**shared, "joints.crank_pin.film": {"oil": {"conductance": 5.0}}})
    oil = warm.replace({"film.oil.supply_celsius": 60.0}).joints["crank_pin"].film.oil
    assert (oil.supply_celsius, oil.conductance) == (60.0, 5.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"joints.crank_pin": "dry", "film.viscosity": 0.1}, r"\[film\]: not used"),
        ({"joints.crank_pin": "ideal", "joints.crank_pin.clearance": 1e-4}, "clearance: not used"),
        ({"joints.crank_pin": "dry", "joints.crank_pin.film.law": "short"}, "film: not used"),
        ({"mechanism": "slider_crank", "joints.balls": "dry"}, "slider_crank has no such joint"),
        ({"mechanism": "slider_crank", "press.slider_mass": 1.0}, r"\[press\]: not used"),
    ],
)
def test_what_the_change_itself_names_is_not_dropped_in_silence(change, message):
    with pytest.raises(InputError, match=message):
        PRESS.replace(change)


def test_step_clears_the_tolerance_and_the_other_way_round():
    """Interface: one of the two decides."""
    stepped = PRESS.replace({"solver.step": 1e-4})
    assert (stepped.solver.step, stepped.solver.tolerance) == (1e-4, None)
    tolerant = stepped.replace({"solver.tolerance": 1e-2})
    assert (tolerant.solver.step, tolerant.solver.tolerance) == (None, 1e-2)
    with pytest.raises(InputError, match=r"solver\.tolerance"):
        PRESS.replace({"solver.step": 1e-4, "solver.tolerance": 1e-3})


@pytest.mark.parametrize(
    ("key", "near"),
    [
        ("flim.viscosity", "film"),
        ("film.viscocity", "viscosity"),
        ("lode.a.force", "load"),
        ("joints.crank_pin.frction.mu_kinetic", "friction"),
        ("joints.crank_pin.friction.mu_kinetc", "mu_kinetic"),
        ("joints.crank_pin.worn.bearing_dept", "bearing_depth"),
        ("joints.crank_pim.clearance", "crank_pin"),
        ("mechanism.bodys.rod.mass", "bodies"),
    ],
)
def test_a_typo_in_any_part_of_a_key_names_the_nearest_one(key, near):
    with pytest.raises(InputError, match=re.escape(f"(did you mean {near!r}?)")):
        Scene(mechanism="slider_crank").replace({key: 0.1})


@pytest.mark.parametrize(
    ("change", "remaining"),
    [
        ("load.cushion", {"load": {"ejector": TABLE_LOAD}}),
        ("load", {"load": {}}),
        ("bodies.crank", {"bodies": {"linkage": "linkage"}}),
        ("bodies", {"bodies": {}}),
        ("joints.balls", {"joints": {"crank_pin": "lubricated"}}),
        ("speed_rpm", {"speed_rpm": Scene().speed_rpm}),
        ("film.law", {"film": {}}),
    ],
)
def test_what_is_none_is_left_out(change, remaining):
    tables = {
        "speed_rpm": 100.0,
        "load": {"cushion": TABLE_LOAD, "ejector": TABLE_LOAD},
        "bodies": {"crank": "crank", "linkage": "linkage"},
        "joints": {"crank_pin": "lubricated", "balls": "dry"},
        "film": {"law": "short"},
    }
    assert Scene(**tables).replace({change: None}) == Scene(**{**tables, **remaining})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (5, "5: allowed is a mapping of dotted names"),
        ({5: 5}, "allowed is a mapping of dotted names"),
        ({".": 1}, r"^'\.': allowed is the name of a key"),
        ({"contact..length": 1}, r"^'contact\.\.length': allowed is the name of a key"),
        ({"contact": 5, "contact.length": 0.1}, "^contact = 5: allowed is a table of keys"),
        ({"joints.balls": "dri"}, r"^joints\.balls\.kind = 'dri': allowed is one of"),
        ({"load.X": None}, "^load.X = None: there is none to leave out"),
        ({"joints.crank_pim": None}, "there is none to leave out .*'crank_pin'"),
    ],
)
def test_changes_that_are_none_are_refused(changes, message):
    with pytest.raises(InputError, match=message):
        Scene().replace(changes)


def test_a_mechanism_that_is_left_out_is_the_usual_one():
    scene = Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, speed_rpm=60.0)
    assert scene.replace({"mechanism": None}) == scene.replace({"mechanism": "press"})
    assert Scene(speed_rpm=60.0).replace({"mechanism": None}) == Scene(speed_rpm=60.0)


def test_an_entry_of_a_list_is_changed_by_its_number():
    grooves = [{"width_deg": 20.0}, {"width_deg": 10.0, "angle_deg": 90.0}]
    load = {"kind": "blanking", "force": 1e4, "offset": [0.1, 0.0]}
    scene = Scene(film={"law": "grooved", "grooves": grooves}, load={"a": load})
    changed = scene.replace({"film.grooves.1.angle_deg": 80.0, "load.a.offset.0": 0.2})
    assert [groove.angle_deg for groove in changed.film["grooves"]] == [0.0, 80.0]
    assert changed.load["a"].offset == (0.2, 0.0)
    one = scene.replace({"joints.crank_pin.film.grooves.1.angle_deg": 70.0})
    assert [groove.angle_deg for groove in one.joints["crank_pin"].film.law.grooves] == [0.0, 70.0]
    assert one.film == scene.film
    for name in (
        "film.grooves.2.angle_deg",
        "joints.crank_pin.film.grooves.2.angle_deg",
        "film.grooves.angle_deg",
        "load.a.offset.2",
    ):
        with pytest.raises(InputError, match=rf"^{name} = 1.0: allowed behind .* number below 2"):
            scene.replace({name: 1.0})


def test_tables_may_be_dataclasses_or_mappings():
    by_mapping = Scene.from_dict({"film": {"viscosity": 0.1}, "solver": {"step": 1e-4}})
    solver = table_from(Solver, "solver", {"step": 1e-4})
    assert Scene(film={"viscosity": 0.1}, solver=solver) == by_mapping


def test_one_key_a_part_or_all_bodies_are_replaced():
    scene = Scene().replace({"bodies.linkage": "linkage"}).replace({"bodies.linkage.modes": 6})
    assert scene.bodies == {"linkage": Flexible("linkage", modes=6)}
    assert scene.replace({"bodies.linkage": "linkage_2"}).bodies["linkage"].modes == 20
    assert scene.replace({"bodies": {}}).bodies == {}
    assert scene.replace({"mechanism": "slider_crank"}).bodies == {}
    both = scene.replace({"bodies.linkage": "linkage_2", "bodies.linkage.modes": 3})
    assert both.bodies["linkage"] == Flexible("linkage_2", modes=3)


def test_a_uniform_rod_stays_one():
    """Its inertia is m l^2 / 12 of the new mass and length; others keep what they were given."""
    drawn = Scene(mechanism="eccentric_press")
    pin = next(joint.at for joint in mechanism_of(drawn).joints if joint.name == "crank_pin")
    place = {"mechanism.joints.wrist_pin.at.y": pin[1] - 0.6}
    changed = drawn.replace({"mechanism.bodies.rod.mass": 12.0, **place})
    rod, ram = (mechanism_of(changed).body(name) for name in ("rod", "ram"))
    assert rod.inertia == pytest.approx(12.0 * 0.6**2 / 12, rel=1e-12)
    assert ram.inertia == mechanism_of(drawn).body("ram").inertia
    assert Scene.from_dict(changed.to_dict()) == changed


@pytest.mark.parametrize(
    ("mechanism", "key", "told"),
    [
        ("six_bar", "bodies.rood.mass", "no table bodies.rood (did you mean 'rod'?)"),
        ("six_bar", "bodies.rod.mas", "unknown key (did you mean 'mass'?)"),
        ("six_bar", "joints.wrist_pin.at.z", "no table joints.wrist_pin.at"),
        ("six_bar", "joints.wrist_pin.at.left.x", "no table joints.wrist_pin.at"),
        ("six_bar", "defaults.radius", "allowed are keys of bodies, joints, guides, output"),
        ("press", "bodies.ram.mass", "are keys of [press]"),
    ],
)
def test_other_keys_of_a_drawing_are_refused(mechanism, key, told):
    message = refused(Scene(mechanism=mechanism).replace, {f"mechanism.{key}": 3.0})
    assert message.startswith(f"mechanism.{key}") and told in message
