"""What a scene must not say, and the one line that names it, what is allowed, and the cure."""

import tomllib
from functools import partial

import pytest
from refused import refused

from exu_press import Scene
from exu_press.scene.joint import DryJoint, LubricatedJoint
from exu_press.scene.load import LOAD_KINDS
from exu_press.scene.usage import TABLES, table_keys
from exu_press.schema.checks import checked_value
from exu_press.schema.table import declared_keys

refusal = partial(refused, Scene.from_dict)

KEYS = {
    **{name: table_keys(name) for name in TABLES},
    **{f"load.{name}": declared_keys(kind) for name, kind in LOAD_KINDS.items()},
    **{kind.__name__: declared_keys(kind) for kind in (Scene, DryJoint, LubricatedJoint)},
}
"""Table -> key -> its declaration."""

NEEDED = {
    "drive": {"rated_torque": 400.0, "inertia": 50.0},
    "guide": {"lateral_stiffness": 1e9},
}
"""Keys without which a table is refused."""

CASES = """
=
film.grooves = [{width_deg = 9}] -> film.grooves = [{'angle_deg': 0.0, 'width_deg': 9.0}]: not used
film = {at_contact = 'mixed', roughness = 4e-5} -> film.roughness * film.asperity_onset = 0.00012
friction.velocity = 1.0 -> allowed are law, mu_kinetic, regularisation_velocity, mu_static, strib
revolutions = 2e-4; speed_rpm = 2.4e5 -> revolutions = 0.0002 at speed_rpm = 240000 is a run of
revolutions = 2; settle = 1.9999999 -> settle = 1.9999999: allowed is a number < revolutions = 2.0
solver = {step = 1e-5, tolerance = 1e-3} -> solver.tolerance = 0.001: not used .. (solver.step is
solver = {step = 1e-5, max_step_deg = 1.5} -> solver.max_step_deg = 1.5: not used .. solver.step
solver = {step = 1e-5, min_step = 1.0} -> solver.min_step = 1.0: not used .. (solver.step is given)
friction.mu_static = 0.005 -> friction.mu_static = 0.005: allowed is a number >= friction.mu_kin
press.linkage_length = 0.02 -> press: linkage and slide lock .. deg
press.link_5_length = 0.1655 -> press.link_5_length .. deg
press.link_7_length = 0.005 -> press.link_7_length .. deg
crank_pin = 'dry' -> crank_pin = 'dry': is joints.crank_pin now
= mechanism = 'four_bar'
joints.crankpin = 'dry' -> joints.crankpin = 'dry': four_bar has no such joint .. mean 'crank_pin'
joints.crank_pin = 'lubricated'; film = {law = 'grooved', grooves = [{}]} -> clearance (radial \
.. radius .. film.grooves.0.width_deg (around the bearing .. film.viscosity .. film.length
= mechanism = 'scotch_yoke'
joints.yoke_slot = 'dry' -> yoke_slot is a guide or slot of scotch_yoke; allowed is [guide.
= mechanism = 'slider_crank'
press = {} -> [press]: not used .. mechanism is 'slider_crank'
= joints = {}
= joints.balls = 'dry'
film.viscosity = 0.1 -> [film]: not used .. no joint is 'lubricated'

# joints
=
joints.crank_pin = 'wet' -> joints.crank_pin.kind = 'wet': allowed is one of 'ideal', 'dry',
joints.crank_pin = {} -> joints.crank_pin needs kind, one of 'ideal', 'dry', 'lubricated'
joints.pivots = {kind = 'dry', clearance = 2, radius = 1} -> clearance = 2.0: allowed is .. < radius
joints.pivots = {kind = 'ideal', clearance = 1} -> joints.pivots.clearance: not used .. is 'ideal'
joints.pivots = {kind = 'dry', film = {}} -> joints.pivots.film: not used .. is 'dry'
joints.balls = {kind = 'dry', contact = {length = 0.1}} -> joints.balls.contact.length = 0.1: not us
joints.balls = {kind = 'dry', worn = {bearing_depth = [0, 1e-6, 0]}} -> is a ball
= joints.balls.kind = 'lubricated'
joints.balls.film.length = 0.1 -> film.length = 0.1: not used .. (the joint is spherical)
joints.balls.film.socket_angle_deg = 30.0 -> socket_angle_deg = 30.0: allowed is .. >= 45 and <= 90
= joints.crank_pin.kind = 'lubricated'
joints.crank_pin.film.socket_angle_deg = 60.0 -> film.socket_angle_deg = 60.0: not used
joints.crank_pin.friction.law = 'none' -> crank_pin.friction: not used .. film.at_contact is 'stop'
joints.crank_pin.film = {at_contact = 'mixed', roughness = 1e-4} -> = 0.0003: allowed is .. < clear
= joints.crank_pin.kind = 'dry'; bodies.linkage = 'linkage'
joints.crank_pin.worn.bearing_depth = [0, 1e-6, 0] -> flexible
= mechanism = 'slider_crank'; joints.crank_pin.kind = 'dry'
joints.crank_pin.worn = {} -> bearing_depth, journal_depth or both
joints.crank_pin.worn.bearing_depth = [1e-5, 0] -> at least 3
joints.crank_pin.worn.bearing_depth = [1e-5, -1e-6, 0] -> >= 0
joints.crank_pin.worn = {bearing_depth = [0, 1e-6, 0], journal_depth = [0, 0, 0, 0]} -> as many
joints.crank_pin.worn = {bearing_depth = [0, 1e-6, 0], angle_deg = [0, 90, 80]} -> increasing
joints.crank_pin.worn = {bearing_depth = [0, 1e-6, 0], angle_deg = [0, 90, 400]} -> one turn
joints.crank_pin.worn.bearing_depth = [0, 0, 0, 0, 0, 0, 5e-4, 0, 0, 0, 0, 0] -> fast

# keys of laws that another choice has
= mechanism = 'slider_crank'; joints.crank_pin = {kind = 'dry', clearance = 5e-5, radius = 0.03}
contact = {damping = 'hu_guo', damping_max = 1} -> contact.damping_max = 1 .. belongs to 'step')
contact = {shape = 'point', length = 0.1} -> contact.length = 0.1: not used .. shape is 'point'
contact = {shape = 'point', stiffness = 1, modulus = 1} -> contact.modulus = 1 .. stiffness is given
friction = {law = 'coulomb', mu_static = 0.1} -> friction.mu_static = 0.1: not used .. 'coulomb'
joints.crank_pin.friction.mu_static = 0.2 -> crank_pin.friction.mu_static = .. (friction.law is 'cou
joints.crank_pin.friction.law = 'lugre'; friction = {law = 'lugre_steady', \
regularisation_velocity = 1e-4} -> friction.regularisation_velocity = .. pin.friction.law is 'lugre'
drive = {table_speed_rpm = [0, 300], table_torque = [9, 0], inertia = 9, slip = 1} -> is given
guide = {friction = 'coulomb', width = 0} -> guide.width = 0 .. guide.clearance is not given

# output and wear
=
output.channels = 'some' -> output.channels = 'some': allowed is one of 'all', or a list
output.samples = [] -> output.samples: allowed is at least one crank angle
output.samples = [360.0] -> output.samples = 360.0: allowed are numbers from 0 to < 360
output.samples = [90.0, 90.0] -> output.samples = 90.0 after 90.0: allowed is increasing
output.samples = [0.0]; solver.step = 1e-5 -> output.samples: allowed with solver.tolerance
= mechanism = 'slider_crank'; joints.crank_pin = 'dry'; wear = {coefficient = 1e-4, hardness = 2e9}
speed_rpm = 200 -> length
wear = {length = 0.1, joints.shaft.length = 0.1} -> do not touch
wear = {length = 0.1, guides.slider.length = 0.1} -> (guides.slider has no clearance)

# guides
= mechanism = 'slider_crank'; joints = {}
wear = {coefficient = 1e-4, hardness = 2e9, length = 0.1} -> no revolute joint is dry
guide.friction = 'lugre'; friction.mu_kinetic = 0.2 -> friction.mu_kinetic = 0.2: not used .. guides
guide.friction = 'coulomb'; friction.sigma_0 = 2e4 -> [friction]: not used .. no joint is 'dry'
guide.clearance = 2e-5; contact.modulus = 1e11 -> contact.modulus = 1
guide.clearance = 2e-5; contact.damping = 'step' -> guide.clearance needs contact.damping_max
guide = {friction = 'coulomb', viscosity = 0.1} -> guide.viscosity = 0.1: not used .. clearance is
= mechanism = 'slider_crank'; joints = {}; guide = {clearance = 2e-5, length = 0.3, width = 0.1}
guide.damping_ratio = 0.1 -> guide.damping_ratio = 0.1: not used .. [contact] has
guide.slider.length = 0.2 -> guide.length = 0.3: not used by this scene (every guide has its own
guide.tilting_stiffness = 1e6 -> guide.tilting_stiffness = 1000000.0: not used
guide.viscosity = 0.1 -> guide.viscosity needs guide.face_width .. no default
guide = {viscosity = 0.1, face_width = 0.1} -> guide.viscosity needs guide.contact_gap
guide = {viscosity = 0.1, face_width = 0.1, contact_gap = 3e-5} -> gap = 3e-05: allowed is .. < guid
guide = {viscosity = 0.1, face_width = 1e-3, contact_gap = 2e-6} -> face_width = 0.001: allowed are
= mechanism = 'slider_crank'; joints = {}; guide = {lateral_stiffness = 1e9, damping_ratio = 0.1, \
lateral_damping = 9.0}
guide.tilting_damping = 9.0 -> guide.damping_ratio = 0.1: not used .. lateral_damping and
guide.slider = {damping_ratio = 0.2, tilting_damping = 9.0} -> guide.slider.damping_ratio = 0.2: not
guide = {length = 0.3, tilting_stiffness = 1e6} -> guide.length = 0.3: not used .. tilting_stiffn
guide.slider.tilting_stiffness = 1e6; guide.length = 0.3 -> guide.length = 0.3: not used .. its own
=
guide.ram.clearance = 1e-5 -> guide.ram: press has no such guide; allowed are slide,
guide.length.clearance = 1e-5 -> guide.length: is a key of [guide], so that
guide.slide.kind = 'dry' -> guide.slide.kind = 'dry': allowed is a guide with clearance
guide.slide.width = 0.1 -> guide.slide.width = 0.1: not used by this scene (guide.slide.
guide.slide = {clearance = 1e-5, viscosity = 0.1} -> slide.viscosity needs guide.slide.face_width

= mechanism = 'scotch_yoke'
guide.lateral_stiffness = 1e9 -> slots.yoke_slot holds a pin; .. guide.yoke_slot =
= mechanism = 'scotch_yoke'; wear = {coefficient = 1e-4, hardness = 2e9, length = 0.1}
guide.yoke_slot.clearance = 2e-5 -> and no guide has clearance, nor a slot clearance and its pin's
guide = {clearance = 2e-5, yoke_slot.width = 0}; wear.guides.yoke_slot.length = 0.2 -> guide.yoke_s\
lot.width = 0: slots.yoke_slot holds a pin

# motors
= drive.inertia = 50.0
drive = {} -> [drive] needs drive.rated_torque (at rated speed
drive = {rated_torque = 4.0, clutch_torque = 9.0, stop_time = []} -> (an empty list is as good as
drive = {rated_torque = 400.0, breakdown_torque = 300.0} -> drive.breakdown_torque = 300.0: allowed
drive.table_torque = [1.0, 0.0] -> table_speed_rpm, drive.table_torque: 0 and 2 values
drive = {table_torque = [1, 0], table_speed_rpm = [2, 1]} -> = 1.0 after 2.0: allowed is increasing
drive = {table_torque = [1, 0], table_speed_rpm = [-2, -1]} -> drive.table_speed_rpm = -1.0 at the e
=
joints = {}; start = 'loaded' -> start = 'loaded': not used .. every joint is ideal

# films and their oil
= mechanism = 'slider_crank'; joints.crank_pin = 'lubricated'; film.oil = {viscosity_cst = [68, 8],\
 density = 870, supply_celsius = 40, conductance = 5}
film.viscosity = 0.1 -> film.viscosity and film.oil: allowed is one
film.oil.viscosity_cst = [8, 68] -> the larger one first, as oil thins
film.oil.at_celsius = [100, 40] -> the lower one first
film.oil.viscosity_cst = [5.0, 1.5] -> ASTM D341
film.oil.conductance = 0; film.oil.frame_celsius = 20.0 -> frame_celsius .. not used
film.oil.conductance = 0; film.law = 'pi_film' -> a long bearing has no side flow
mechanism = 'press'; joints.balls = 'lubricated' -> the film of a ball does not warm .. joints.balls

= mechanism = 'slider_crank'; joints.crank_pin = 'lubricated'
film.oil = {density = 870.0, supply_celsius = 40.0} -> needs film.oil.viscosity_cst
film.oil = {viscosity_cst = [68.0, 8.7]} -> needs film.oil.density .. density = 870

= mechanism = 'slider_crank'; joints.crank_pin = {kind = 'lubricated', clearance = 1e-4, \
radius = 0.05}; film = {law = 'grooved', length = 0.05, viscosity = 0.05}
speed_rpm = 10 -> film.grooves: missing; allowed is one .. or film.tilt > 0
film.grooves = [] -> film.grooves = .. allowed is a list of tables
film.grooves = [{}] -> joints.crank_pin needs film.grooves.0.width_deg (around the .. in [film] or
film.grooves = [{}, {width_deg = 9}, {}] -> film.grooves.0.width_deg .. film.grooves.2.width_deg
film.grooves = [{width_deg = 9, angle_deg = 90}, {width_deg = 9, angle_deg = 98}] -> at 90 and 98
film.grooves = [{width_deg = 359.9999}] -> <= 359, which leaves 1 deg of bearing
film.grooves = [{width_deg = 10.0, length = 0.051}] -> film.grooves.0.length = 0.051
film.grooves = [{width_deg = 9, pressure = 1e5}] -> film.grooves.0.pressure = 100000.0: .. length <
film.grooves = [{width_deg = 360.0}] -> film.grooves: .. shorter than the bearing
film = {grooves = [{width_deg = 9}], tilt_direction_deg = 9} -> film.tilt_direction_deg = 9.0: not
film.tilt = 4e-3 -> film.tilt = 0.004: allowed is a number < 2 * clearance .. = 0.004
film = {tilt = 1e-3, at_contact = 'mixed'} -> 'mixed' with film.tilt: allowed is 'stop'
film.grooves = [{width_deg = 360, length = 5e-3, pressure = 1e5}]; film.tilt = 1e-3 -> with pressure
film = {tilt = 1e-3, law = 'finite'} -> film.law is 'finite'; it belongs to 'grooved'

# flexible bodies
=
bodies = 'flexible' -> bodies = 'flexible': allowed is a table for each flexible body
bodies.linkage.modes = 4 -> bodies.linkage.flexible: missing
= mechanism = 'six_bar'; bodies.rod.matrices = 'rod.toml'
bodies.rod.mesh_size = 0.1 -> bodies.rod.mesh_size = 0.1: not used .. matrices in place of a solid
bodies.rod.flexible = 'rod.step' -> allowed is one of the two
bodies.rod.matrices = 'rod.mtx' -> matrices = 'rod.mtx': allowed is the path of a description
= bodies.crank.flexible = 'crank'
bodies.crank = {flexible = 'crank', modes = 4, flexibility_error = 0.1} -> modes and flexibility_err
bodies.crank.faces.pins = 'pin' -> crank.faces.pins: crank has no such joint
bodies.crank.faces.drive.z = [0, 1] -> drive = {'z' .. allowed is a face's name
bodies.crank.faces.drive = ['pin', 'web'] -> faces.drive = ['pin', 'web']: allowed
bodies.crank.faces.crank_pin.z = [1, 0] -> pin.z = [1.0, 0.0]: allowed

# loads
=
load.'a b'.kind = 'blanking' -> load: 'a b' is no name
load.a.force = 1.0 -> load.a needs kind, one of 'blanking', 'table'
load.a.kind = 'blanking' -> load.a needs force (peak force; in N) .. give it in [load.a]
load.a.kind = 'spring' -> load.a needs height (of .. in m), travel (of .. give them in [load.a]

# what is missing, all at once
= mechanism = 'six_bar'; joints = {crank_pin = 'dry', rod_pin = 'dry'}
start = 'loaded' -> joints.crank_pin, joints.rod_pin need clearance (radial .. in [joints.NAME] .. \
joints.crank_pin, joints.rod_pin need contact.length .. in [contact] or [joints.NAME.contact], as in
joints.rod_pin = 'lubricated' -> crank_pin needs contact.length .. rod_pin needs film.viscosity
drive = {begins = 'standing'} -> [drive] needs drive.rated_torque .. drive.inertia .. 'standing' \
needs drive.clutch_torque .. joints.crank_pin, joints.rod_pin need clearance
guide = {clearance = 1e-5, viscosity = 0.1} -> joints.rod_pin need clearance .. guide.face_width
wear = {} -> need clearance .. joints.crank_pin, joints.rod_pin need wear.coefficient
load = {a = {kind = 'spring'}, b = {kind = 'blanking'}} -> clearance .. load.a needs .. load.b needs
load = {a = {force = 1.0}}; joints.wrist_pin.radius = 0.1 -> need clearance .. joints.wrist_pin \
needs kind, one of 'ideal' .. load.a needs kind

# loads
= load.a = {kind = 'blanking', force = 1e4}
load.a = {start_angle_deg = 9, end_angle_deg = 10} -> start_angle_deg and end_angle_deg: allowed is
load.a.time = [0, 1] -> load.a.time = [0, 1]: not used by this scene
load.a.body = 'slidr' -> press has no such body (did you mean 'slider'?)
load.a.direction = [0, 0] -> load.a.direction = [0, 0]: allowed is a direc
load.a = {rise = 0.2, fall = 0.06} -> load.a.rise + fall = 0.26: allowed is at
load.a.acts = 'both' -> load.a.acts = 'both': not used by this scene
load.a = {joint = 'ball_left', offset = [0, 1]} -> load.a.joint and offset: allowed is one
load.a.face = 'a' -> load.a.face: slider is rigid; allowed are joint and offset, or [bodies.s
= load.a = {kind = 'blanking', force = 1, body = 'linkage'}; bodies.linkage = 'linkage'
speed_rpm = 10 -> load.a: acts on the flexible linkage, which .. one of crank_pin, slide_pin, or
load.a.face = {} -> load.a.face = {}: allowed is a face's name, or ranges
load.a.face.x = [1, 0] -> load.a.face.x = [1.0, 0.0]: allowed
= load.a.kind = 'table'
speed_rpm = 10 -> load.a.force: missing: allowed is file, a CSV, or one of time
load.a = {time = [0, 1], crank_angle_deg = [0, 1], force = [0, 1]} -> time, crank_angle_deg, force g
load.a = {file = 'a.csv', force = [0, 1]} -> load.a.file and force: allowed is one of the two
load.a = {time = [0, 1], force = [1]} -> load.a.time, force: 2 and 1 values
load.a = {crank_angle_deg = [0, 400], force = [0, 1]} -> from 0.0 to 400.0: allowed is less than a r
load.a = {crank_angle_deg = [0, 360], force = [0, 1]} -> whole one that ends with the force with whi
"""
"""Behind "=" what the next lines have in common; then a case: keys, and what the message says."""


def merged(first, second):
    """Return two nested mappings as one; the second one's values count."""
    both = {**first, **second}
    for key in first.keys() & second.keys():
        if isinstance(first[key], dict) and isinstance(second[key], dict):
            both[key] = merged(first[key], second[key])
    return both


def cases():
    base = {}
    for line in CASES.splitlines():
        keys, arrow, message = line.partition(" -> ")
        if line.startswith("="):
            base = tomllib.loads(line[1:].replace("; ", "\n"))
        elif arrow:
            scene = merged(base, tomllib.loads(keys.replace("; ", "\n")))
            yield pytest.param(scene, message, id=line)


@pytest.mark.parametrize(("scene", "message"), [*cases()])
def test_what_is_refused_is_named(scene, message):
    told = refusal(scene)
    for fragment in message.split(" .. "):
        assert fragment in told
        told = told.partition(fragment)[2]


def wrong_values(field):
    """Return values that no key of its kind may have."""
    meta, of_type = field.metadata, str(field.type)
    if "above" not in meta or meta["also"] or {"part", "by_place", "list_of"} & meta.keys():
        return []
    wrong = [float("nan"), -float("inf"), {}, ["x"], [True]]
    if meta["numbers"] is None and "float" in of_type:
        wrong += [True, "1.0", 1e-31]
        for bound, step in (("above", 0.0), ("at_least", -1e-9), ("at_most", 1e-9)):
            if meta[bound] is not None:
                wrong.append(meta[bound] + step * max(abs(meta[bound]), 1.0))
    return wrong + (["no such thing"] if meta["choices"] else [])


@pytest.mark.parametrize("table", KEYS)
def test_every_key_has_its_kind_and_its_range(table):
    for name, field in KEYS[table].items():
        for value in wrong_values(field):
            told = refused(checked_value, field, f"{table}.{name}", value)
            assert told.startswith(f"{table}.{name} = {value!r:.80}") and ": allowed is " in told
            assert all(repr(choice) in told for choice in field.metadata["choices"])


@pytest.mark.parametrize("table", ["", *TABLES])
def test_every_key_of_a_scene_is_checked_and_known_by_its_name(table):

    def scene(keys):
        if isinstance(keys, dict):
            keys = NEEDED.get(table, {}) | keys
        mechanism = {"mechanism": table} if table == "slider_crank" else {}
        return {**mechanism, table: keys} if table else keys

    for name, field in KEYS[table or "Scene"].items():
        if "meaning" in field.metadata:
            path = f"{table}.{name}" if table else name
            told = refusal(scene({name: float("nan")}))
            assert told.startswith(f"{path} = nan: ") and ("allowed" in told or "not used" in told)
            told = refusal(scene({f"{name}x": 1.0}))
            assert told.startswith(f"{path}x = 1.0: unknown key (did you mean '")
    for value in (5, "pinkus", True, [], [{}]) if table else (None, 3, [], "press"):
        told = refusal(scene(value))
        assert f"{value!r}: allowed is a table" in told
