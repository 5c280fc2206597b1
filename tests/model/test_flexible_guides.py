"""Flexible bodies in guides: statics are those of the solid; test_flexible_slots has the limit."""

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.joints.history import history
from exu_press.model import build
from exu_press.model.placement import placed_parts
from exu_press.model.system import System
from exu_press.result.flexible import guided_motion
from exu_press.result.record_run import record
from exu_press.scene import mechanism_of

pytest.importorskip("ngsolve")

from netgen.occ import Box, Cylinder, Pnt, Sphere, Z

pytestmark = pytest.mark.usefixtures("sound_files")

WRIST = -0.353  # m, of the shipped slider-crank at top dead centre
WIDTH, BORE, LENGTH, MESH = 0.08, 0.02, 0.3, 0.08
STEEL = 2.1e11


def block(length=LENGTH):
    """Return a square slider with a bore near its upper end, as drawn, mm."""
    half, low = 500.0 * WIDTH, 1e3 * (WRIST - length)
    solid = Box(Pnt(-half, low, -half), Pnt(half, 1e3 * WRIST + 60.0, half))
    return solid - Cylinder(Pnt(0, 1e3 * WRIST, -100), Z, r=1e3 * BORE, h=200)


@pytest.fixture(scope="module")
def slider(tmp_path_factory):
    """Return a function that writes a solid and returns the slider-crank with it as its slider."""
    folder = tmp_path_factory.mktemp("sliders")

    def scene(solid=None, name="block", body=None, **keys):
        path = folder / f"{name}.step"
        if not path.exists():  # a file has the time in it, and another one is reduced again
            (solid or block()).WriteStep(str(path))
        own = {"flexible": str(path), "mesh_size": MESH, "modes": 12, **(body or {})}
        given = {"mechanism": "slider_crank", "joints": {}, "bodies": {"slider": own}, **keys}
        return Scene(**given)

    return scene


PUSH = {"kind": "table", "crank_angle_deg": [5, 20, 40], "force": [0.0, 1e4, 0.0]}
BOTTOM = {"y": [WRIST - LENGTH - 1e-3, WRIST - LENGTH + 1e-3]}
GUIDEWAYS = {
    "clearance": 2e-5,
    "friction": "coulomb",
    "length": 0.2,
    "width": WIDTH,
    "lateral_stiffness": 2e8,
}


def test_in_its_clearance_a_soft_slider_touches_with_its_guided_faces(slider):
    """Both ends lie where the mean motion of the guide's faces puts them; the balance closes."""
    soft = {"youngs_modulus": 0.01 * STEEL, "modes": 8}
    run = {"revolutions": 0.06, "speed_rpm": 200.0, "solver": {"tolerance": 1e-4}}
    load = {"push": {**PUSH, "face": BOTTOM}}
    model = build(slider(body=soft, load=load, guide=GUIDEWAYS, **run))
    result = record(model, model.solve())
    held = guided_motion(model, "slider").position
    low, high = (
        history(model.states, end, result.time).eccentricity[:, 0]
        for end in model.guideways["slider"]
    )
    assert np.abs(0.5 * (low + high) - held[:, 0]).max() < 1e-9
    assert np.abs((low - high) / GUIDEWAYS["length"] - np.sin(held[:, 2])).max() < 1e-8
    assert np.abs(held[:, 2] - result["slider_tilt"]).max() > 3e-7
    assert np.abs(result["guide_force"]).max() > 100.0
    summary = result.summary()
    assert summary["quantities"]["energy.residual"]["value"] < 1e-3
    assert (
        0.0
        < summary["quantities"]["guides.slider.dissipated"]["value"]
        <= summary["quantities"]["energy.dissipated"]["value"]
    )


def test_balls_carry_a_flexible_ram(tmp_path):
    """Of the eccentric press; ideal balls hold half, along the parallel guides."""
    mechanism = mechanism_of(Scene(mechanism="eccentric_press"))
    balls = [joint for joint in mechanism.joints if joint.spherical]
    reach = max(abs(joint.at[0]) for joint in balls) + 0.06
    top = balls[0].at[1]
    solid = Box(Pnt(-1e3 * reach, 1e3 * top - 150, -60), Pnt(1e3 * reach, 1e3 * top, 60))
    for ball in balls:
        solid -= Sphere(Pnt(1e3 * ball.at[0], 1e3 * top, 0), 30)
    path = tmp_path / "ram.step"
    solid.WriteStep(str(path))
    scene = Scene(
        mechanism="eccentric_press",
        joints={"balls": "ideal"},
        bodies={"ram": {"flexible": str(path), "mesh_size": 0.1, "modes": 8}},
        revolutions=0.3,
    )
    result = simulate(scene)
    assert result.completed
    assert result.quantity("energy.residual").value < 2e-3
    carried = sum(result[f"{ball.name}_force"][:, 1] for ball in balls)
    lifted = result.info["solids"]["ram"]["mass"] * (9.81 + result["slider_acceleration"])
    sign = 1.0 if balls[0].journal == "ram" else -1.0
    assert sign * carried == pytest.approx(lifted, rel=1e-2)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"body": {"faces": {"guide": {"radius": 1.0}}}}, r"faces\.guide\.radius = 1\.0: unknown"),
        ({"body": {"faces": {"guide": {}}}}, r"faces\.guide = \{\}: allowed is a face's name, or"),
        (
            {"body": {"faces": {"wrist_pin": {"x": [0, 1]}}}},
            r"faces\.wrist_pin\.x = \[0\.0, 1\.0\]: unk",
        ),
        (
            {"body": {"faces": {"guide": {"x": [1.0, 2.0]}}}},
            r"no face for guide lies wholly within x = \[1, 2\]; the solid fills x = \[-0\.04, 0\.",
        ),
        (
            {"body": {"angle_deg": 45.0, "origin": [-0.2496, -0.1034]}},
            r"lies about wrist_pin|no plane faces on both sides across the guide",
        ),
        (
            {"body": {"faces": {"guide": {"x": [-0.021, 0.021], "y": [-0.38, -0.33]}}}},
            r"wrist_pin and guide hold the same face",
        ),
    ],
)
def test_what_is_refused_in_one_line(slider, keys, message):
    with pytest.raises(InputError, match=message) as refused:
        placed_parts(slider(**{**keys, "body": {"modes": 0, **keys.get("body", {})}}))
    assert "\n" not in str(refused.value)


def test_a_ball_lies_in_the_plane(tmp_path):
    solid = Box(Pnt(-250, -653, -60), Pnt(250, -503, 160))
    for x in (-165.5, 165.5):
        solid -= Sphere(Pnt(x, -503, 50), 30)
    solid.WriteStep(str(tmp_path / "ram.step"))
    body = {"flexible": str(tmp_path / "ram.step"), "mesh_size": 0.1, "modes": 0}
    with pytest.raises(InputError, match=r"ball_left has its centre at z = 0\.05 m of .*ra"):
        placed_parts(Scene(mechanism="eccentric_press", joints={}, bodies={"ram": body}))


def test_the_start_fits_what_a_guide_holds(tmp_path):
    """A flexible and a rigid slider, which two balls, one on a flexible plunger, tilt if ideal."""
    joints = {joint.name: joint.at for joint in mechanism_of(Scene()).joints}
    x, y = (1e3 * value for value in joints["plunger_pin_right"])
    low = 1e3 * joints["ball_right"][1]
    plunger = Box(Pnt(x - 50, low, -50), Pnt(x + 50, y + 60, 50)) + Sphere(Pnt(x, low, 0), 39)
    plunger -= Cylinder(Pnt(x, y, -100), Z, r=25, h=200)
    slider = Box(Pnt(-260, low - 200, -80), Pnt(260, low, 80))
    for side in (-x, x):
        slider -= Sphere(Pnt(side, low, 0), 40)
    bodies = {}
    for name, solid in {"plunger_right": plunger, "slider": slider}.items():
        solid.WriteStep(str(tmp_path / f"{name}.step"))
        path = str(tmp_path / f"{name}.step")
        bodies[name] = {"flexible": path, "mesh_size": 0.1, "modes": 2}
        result = simulate(Scene(joints={"balls": "dry"}, bodies=bodies, revolutions=0.001))
        assert np.abs(result["slider_tilt"][0]) < 1e-9  # the mean of the whole body's
        # what was left of the tilt, 7e-6 rad, made 1e5 N m of steps of 2e-8 s; now it hangs free
        assert np.abs(result["guide_moment"]).max() < 100.0


def test_the_damping_of_a_guide_is_that_of_the_solids_mass(slider):
    """2 D sqrt(k m) of the body that moves, not of the drawn one."""
    system = System(
        scene := slider(body={"modes": 0}, guide={"lateral_stiffness": 2e8}), placed_parts(scene)
    )
    (guide,) = system.mechanism.guides
    part, ratio = system.parts["slider"], scene.guide.support.damping_ratio
    drawn = mechanism_of(scene).body("slider").mass
    assert abs(drawn / part.reduced.mass - 1.0) > 0.1
    assert guide.lateral.damping == 2.0 * ratio * np.sqrt(2e8 * part.reduced.mass)
    stiffness = guide.tilting.stiffness
    assert guide.tilting.damping == 2.0 * ratio * np.sqrt(stiffness * part.inertia)
