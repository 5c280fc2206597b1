"""Loads against virtual work: what they put in the drive takes out, on any body and point.

With ideal joints and a crank at constant speed a load F at a point with velocity v changes the
drive's torque by -F v / omega and nothing else.
"""

import numpy as np
import pytest
from pressed import FORMING

from exu_press import Scene, simulate
from exu_press.scene import mechanism_of

CUSHION = {"kind": "table", "height": [0.0, 0.02], "force": [4e4, 0], "acts": "both"}
IDEAL = {"joints": {}, "revolutions": 0.5, "solver": {"tolerance": 1e-5}}
LOADS = {
    "over time": {"kind": "table", "time": [0.02, 0.05, 0.1], "force": [0.0, 2e4, -1e4]},
    "over the crank angle": {
        "kind": "table",
        "crank_angle_deg": [30, 90, 150],
        "force": [0, 5e4, 2e4],
    },
    "a spring over the height": {
        "kind": "table",
        "height": [0.0, 0.005, 0.015],
        "force": [2e5, 4e4, 0],
        "acts": "both",
    },
    "a forming force": {
        "kind": "table",
        "height": [0.0, 0.001, 0.005, 0.015],
        "force": [2e5, 3e5, 4e4, 0],
    },
    "on a link, off its middle": {
        "kind": "blanking",
        "force": 1e5,
        "rise": 0.02,
        "fall": 0.03,
        "end_angle_deg": 160.0,
        "body": "link_5_right",
        "offset": [0.05, 0.02],
        "direction": [1.0, 2.0],
    },
}


@pytest.fixture(scope="module")
def free():
    return simulate(Scene(**IDEAL))


@pytest.mark.parametrize("name", LOADS)
def test_the_drive_takes_out_what_a_load_puts_in(name, free):
    scene = Scene(**IDEAL, load={"one": LOADS[name]})
    result = simulate(scene)
    assert result.completed and free.completed
    load, speed = scene.applied_loads["one"], scene.angular_speed
    angle = speed * result.time
    motion = mechanism_of(scene).motion(angle, speed)
    position, velocity, _ = mechanism_of(scene).ideal_slider(angle, speed)
    force = load.force(
        result.time, (angle, result["crank_speed"]), (position - position.min(), velocity)
    )
    power = force * (
        motion[load.body].point_motion(load.point).velocity[:, :2] @ np.array(load.direction)
    )
    without = np.interp(result.time, free.time, free["drive_torque"])
    changed = result["drive_torque"] - without
    expected = -power / speed
    assert np.abs(expected).max() > 100.0
    assert np.abs(changed - expected).max() < 1e-4 * np.abs(expected).max()
    # velocities may be 1e-5 of the largest off, and a force fades over 1e-3 of it
    close = 1e-4 if load.fade is None else 2e-3
    assert result["load_one_force"] == pytest.approx(force, abs=close * np.abs(force).max())
    assert result.quantity("energy.residual").value < 5e-4
    assert ("load_one_moment" in result) == (name == "on a link, off its middle")


def test_the_balance_closes_with_clearance_and_guides_that_give_way():
    loads = {name.replace(" ", "_").replace(",", ""): load for name, load in LOADS.items()}
    scene = Scene(
        revolutions=0.12,
        guide={"lateral_stiffness": 1e9},
        load=loads,
        solver={"tolerance": 1e-2},
    )
    result = simulate(scene)
    assert result.completed
    told = result.summary()["quantities"]
    assert told["energy.residual"]["value"] < 1e-3
    assert {name.split(".")[1] for name in told if name.startswith("loads.")} == set(loads)
    for name in loads:
        assert told[f"loads.{name}.work"]["value"] == result[f"load_{name}_work"][-1]


@pytest.mark.parametrize("name", ["over time", "over the crank angle"])
def test_steps_end_on_the_corners(name):
    scene = Scene(joints={}, revolutions=0.5, load={"one": LOADS[name]})
    time = simulate(scene).time
    given = LOADS[name].get("time") or np.array(LOADS[name]["crank_angle_deg"]) / 360.0 * 0.25
    for corner in given:
        assert np.abs(time - corner).min() < 1e-9


def test_a_stiff_table_is_a_spring():
    """Of 5e8 N/m under the slider of a dry slider-crank, against Exudyn's own spring there."""
    from exudyn.itemInterface import MarkerNodeCoordinate, ObjectConnectorCoordinateSpringDamper

    scene = Scene(
        mechanism="slider_crank",
        joints={"crank_pin": "dry"},
        revolutions=0.03,
        solver={"tolerance": 1e-4},
    )
    start = mechanism_of(scene).ideal_slider(np.zeros(1), 1.0)[0][0]
    stiffness, top = 5e8, start - mechanism_of(scene).bottom
    table = {
        "kind": "table",
        "height": [top - 0.1, top + 0.1],
        "force": [stiffness * 0.1, -stiffness * 0.1],
        "acts": "both",
    }
    from exu_press.result import record

    loaded = simulate(scene.replace({"load.spring": table}))
    model = scene.build()
    still = model.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=0, coordinate=0))
    slider = model.mbs.AddMarker(
        MarkerNodeCoordinate(nodeNumber=model.nodes["slider"], coordinate=0)
    )
    reference = model.rigid["slider"].reference[1]
    model.mbs.AddObject(
        ObjectConnectorCoordinateSpringDamper(
            markerNumbers=[still, slider], stiffness=stiffness, offset=start - reference
        )
    )
    model.mbs.Assemble()
    held = record(model, model.solve())
    assert loaded.completed and held.completed
    there = np.interp(held.time, loaded.time, loaded["slider_position"])
    assert np.abs(there - held["slider_position"]).max() < 2e-6
    assert loaded.info["newton_iterations"] < 2.0 * held.info["newton_iterations"]


def test_a_try_that_is_no_number_is_repeated():
    """Newton's method tries eccentricities beyond a film's clearance: all that follows is nan."""
    scene = Scene(
        mechanism="eccentric_press",
        speed_rpm=60.0,
        revolutions=1.0,
        joints={"crank_pin": "lubricated", "balls": "dry"},
        film={"at_contact": "stop", "viscosity": 0.003},
        load={"cushion": CUSHION},
        solver={"tolerance": 3e-2},
    )
    result = simulate(scene)
    assert result.completed
    assert result.quantity("energy.residual").value < 1e-3


def work_of(load):
    """Return the work of forming on the whole way down, J."""
    return float(np.trapezoid(load["force"], load["height"]))


@pytest.mark.parametrize("joints", [{}, {"crank_pin": "lubricated", "balls": "dry"}], ids=str)
def test_a_forming_force_takes_out_its_area_and_gives_nothing_back(joints):
    film = {"film": {"at_contact": "mixed"}} if joints else {}
    scene = Scene(
        mechanism="eccentric_press",
        speed_rpm=60.0,
        start_angle_deg=60.0,
        revolutions=0.68,
        joints=joints,
        load={"draw": FORMING},
        solver={"tolerance": 3e-3},
        **film,
    )
    result = simulate(scene)
    assert result.completed
    force, done = result["load_draw_force"], result["load_draw_work"]
    assert done[-1] == pytest.approx(-work_of(FORMING), rel=1e-3 if not joints else 3e-2)
    quadrature = 1e-6 * abs(done[-1])  # of the step in which the slider turns round
    assert (np.diff(done) <= quadrature).all(), "it never pushes"
    assert (force[result["slider_velocity"] >= 0.0] == 0.0).all()
    assert force.max() == pytest.approx(260e3, rel=1e-3)
    assert result.quantity("energy.residual").value < 1e-3
    if not joints:
        spring = simulate(scene.replace({"load.draw.acts": "both"}))
        assert abs(spring["load_draw_work"][-1]) < 0.01 * work_of(FORMING)
