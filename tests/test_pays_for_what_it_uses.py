"""A scene pays for what it uses: modules that are imported, Exudyn items that are built."""

import json
import subprocess
import sys

import numpy as np
import pytest

from exu_press import Scene
from exu_press.files.sources import FOR_READERS
from exu_press.joints import user_force_of

PRINTED = "\nimport sys, json; print(json.dumps(sorted(sys.modules)))\n"


def imported_after(*codes):
    """Return the names of all modules that a process has imported after each code, in order."""
    code = "".join(each + PRINTED for each in codes)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return [set(json.loads(line)) for line in done.stdout.splitlines() if line.startswith("[")]


def tops(modules):
    return {name.partition(".")[0] for name in modules}


IMPORT = "import exu_press"
COMMAND_LINE = """
from exu_press.cli import main
for option in ("--help", "--version"):
    try:
        main([option])
    except SystemExit:
        pass
"""
SCENE = "from exu_press import Scene; Scene()"
FIRST_STEPS = "import exu_press.cli.run; exu_press.simulate(Scene(revolutions=1e-6))"
IDEAL_RUN = """
from exu_press import Scene, simulate
simulate(Scene(joints={}, revolutions=1e-3))
"""
RIGID_RUN = """
result = simulate(Scene.from_dict({
    "mechanism": "press", "revolutions": 0.01, "solver": {"step": 1e-4}}))
result.summary()
result.save(r"%s")
"""
COMMAND = """
assert main(["run", "slider_crank", "--set", "revolutions=0.01", "--set", "solver.step=1e-4",
             "--out", r"%s", "--quiet", "--no-pictures"]) == 0
"""

FLEXIBLE = {"ngsolve", "netgen", "pyngcore"}
NOT_OF_AN_IDEAL_RUN = (
    "film",
    "graphics",
    "oil",
    "wear",
    "worn",
    "flexible",
    "placed_part",
    "placement",
    "studies",
)


def test_each_step_of_the_way_to_a_run_imports_what_it_uses(tmp_path):
    """In one process: a name that a step has not imported, no step before it has."""
    place = tmp_path / "out"
    face, help_text, scene, first = imported_after(IMPORT, COMMAND_LINE, SCENE, FIRST_STEPS)
    ours = {name for name in face if name.startswith(("exu_press", "fe_models"))}
    assert ours == {"exu_press", "fe_models", "fe_models.lazy"}
    assert not tops(help_text) & {"exudyn", "numpy", "scipy", "matplotlib", "tqdm", *FLEXIBLE}
    assert not tops(scene) & {"exudyn", "matplotlib", *FLEXIBLE}  # bad input is refused before
    assert {"exudyn", "numpy"} <= first  # SciPy takes twice as long to load as those two
    assert not tops(first) & {"scipy", "tqdm", "matplotlib", *FLEXIBLE}
    ideal, rigid, of_command, of_page = imported_after(
        IDEAL_RUN,
        RIGID_RUN % (tmp_path / "run.nc"),
        "from exu_press.cli import main\n" + COMMAND % place,
        "import exu_press.report.run",
    )
    assert "matplotlib" not in of_page
    ours = [name for name in ideal if tops([name]) <= {"exu_press", "fe_models"}]
    assert 50 < len(ours) <= 125
    assert not [name for name in ours if any(word in name for word in NOT_OF_AN_IDEAL_RUN)]
    assert not tops(rigid) & {"matplotlib", *FLEXIBLE}
    of_parts = {name for name in rigid if name.startswith("fe_models.")}
    assert of_parts == {"fe_models.errors", "fe_models.lazy"}
    shown = tuple(f"exu_press.{name}" for name in FOR_READERS)  # rows of a sweep do not know them
    assert not [name for name in rigid if name.startswith(shown)]
    assert "exu_press.joints.worn" not in rigid
    assert not tops(of_command) & {"matplotlib", *FLEXIBLE}
    assert (place / "run.nc").exists() and not list(place.glob("*.png"))
    read = f"from exu_press import Result; print(Result.load(r'{place / 'run.nc'}').summary())"
    (of_reading,) = imported_after(
        f"import exu_press.report.run, exu_press.report.pictures; {read}"
    )
    assert "exudyn" not in tops(of_reading)  # to show a run takes no solver


def build(**scene):
    mechanism = scene.pop("mechanism", "press")
    return Scene.from_dict({"mechanism": mechanism, **scene}).build()


def objects(model):
    mbs = model.mbs
    return [mbs.GetObject(i) for i in range(mbs.systemData.NumberOfObjects())]


def kinds(model):
    return [item["objectType"] for item in objects(model)]


def user_functions(model):
    """Return every user function that is set, of objects and of loads."""
    mbs = model.mbs
    loads = [mbs.GetLoad(i) for i in range(mbs.systemData.NumberOfLoads())]
    return [
        f"{item.get('objectType', item.get('loadType'))}.{name}"
        for item in [*objects(model), *loads]
        for name, value in item.items()
        if "UserFunction" in name and np.any(value)  # 0 where none is set
    ]


def test_an_ideal_scene_has_no_user_force_element_and_no_callback():
    model = build(joints={})
    assert "GenericODE2" not in kinds(model)
    assert user_functions(model) == []
    assert model.clearance_joints == {}
    assert user_force_of(model.mbs).item is None


@pytest.mark.parametrize(
    ("scene", "joints"),
    [
        (
            {"joints": {"crank_pin": "lubricated", "balls": "dry"}},
            ["crank_pin", "ball_right", "ball_left"],
        ),
        ({"mechanism": "slider_crank", "joints": {"crank_pin": "dry"}}, ["crank_pin"]),
    ],
    ids=str,
)
def test_clearance_joints_are_one_item_over_their_own_nodes(scene, joints):
    model = build(**scene)
    assert sorted(model.clearance_joints) == sorted(joints)
    assert kinds(model).count("GenericODE2") == 1
    assert sorted(user_functions(model)) == [
        "GenericODE2.forceUserFunction",
        "GenericODE2.jacobianUserFunction",
    ]
    item = next(item for item in objects(model) if item["objectType"] == "GenericODE2")
    bodies = {
        body
        for joint in model.mechanism.joints
        if joint.name in model.scene.joints.with_clearance
        for body in (joint.journal, joint.bearing)
    }
    assert len(item["nodeNumbers"]) == len(bodies)


def loads(model):
    return model.mbs.systemData.NumberOfLoads()


def test_gravity_is_one_load_a_body_and_blanking_one_more():
    model = build(joints={})
    assert loads(model) == len(model.mechanism.bodies) == 14
    assert loads(build(joints={}, gravity=0.0)) == 0
    pulse = {"kind": "blanking", "force": 1e4}
    assert loads(build(joints={}, load={"blanking": pulse | {"force": 0.0}})) == 14
    assert loads(build(joints={}, load={"blanking": pulse})) == 15


def test_bodies_have_the_coordinates_that_their_ideal_joints_leave():
    """Five bodies of the press slide, crank and two links turn about pivots, six are free."""
    press, slider_crank = build(), build(mechanism="slider_crank")
    assert press.mbs.systemData.ODE2Size() == 5 + 3 + 6 * 3
    assert slider_crank.mbs.systemData.ODE2Size() == 1 + 1 + 3
    with_balls = build(joints={})  # they hold the slider's angle
    assert with_balls.mbs.systemData.ODE2Size() == 4 + 3 + 7 * 3
    elastic = build(guide={"lateral_stiffness": 1e9})
    assert elastic.mbs.systemData.ODE2Size() == 3 + 11 * 3
    assert elastic.rigid["slider"].coordinates == ("x", "y", "angle")
