"""A run goes on from the end of another one: with contact history, bristles, film and motor."""

import json
from functools import cache

import numpy as np
import pytest

from exu_press import InputError, Result, Scene, simulate
from exu_press.cli import main
from exu_press.studies.bifurcation.run import rescale_state

PIN = {"clearance": 1e-4, "radius": 0.03}
MOTOR = {"rated_torque": 200.0, "inertia": 2.0}
DRY = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "dry", **PIN}},
    contact={"length": 0.05},
    revolutions=0.05,
)
FILM = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", **PIN}},
    film={"length": 0.05, "viscosity": 0.1},
    revolutions=0.1,
)
SCENES = {
    "restitution": DRY,
    "bristle": DRY.replace({"friction.law": "lugre"}),
    "film": FILM,
    "pulse by a motor": DRY.replace(
        {
            "drive": MOTOR,
            "load": {"blanking": {"kind": "blanking", "force": 1e3, "end_angle_deg": 20.0}},
        }
    ),
    "balls": Scene(joints={"balls": "dry"}, revolutions=0.03),
    "guideways": FILM.replace({"guide": {"clearance": 5e-5, "width": 0.1}}),
}


def difference(one, other, name):
    """Return the largest difference after the first piece, over the largest value."""
    time = np.linspace(other.time[0], other.time[-1], 500)
    whole, piece = (np.interp(time, run.time, run[name]) for run in (one, other))
    return np.abs(whole - piece).max() / np.abs(one[name]).max()


@cache
def first_piece(name):
    return simulate(SCENES[name])


@pytest.mark.parametrize("name", SCENES)
def test_two_pieces_are_one_run(name):
    scene, first = SCENES[name], first_piece(name)
    whole = simulate(scene.replace({"revolutions": 2.0 * scene.revolutions}))
    state = json.loads(json.dumps(first.info["state"]))  # as its file has it
    second = simulate(scene, start=state)
    assert second.completed
    assert second.time[0] == first.time[-1]
    assert second.time[-1] == pytest.approx(whole.time[-1], rel=1e-12)
    assert difference(whole, second, "slider_position") < 1e-6
    assert difference(whole, second, "slider_velocity") < 1e-4


def test_loads_and_samples_are_where_the_crank_is():
    """At another speed, with the state's scaled, and whatever the start angle, which moves none."""
    force = {"kind": "table", "crank_angle_deg": [90, 135, 180], "force": [0, 1e3, 0]}
    scene = FILM.replace({"revolutions": 0.25, "load": {"forming": force}})
    state = rescale_state(simulate(scene).info["state"], 240.0, 120.0)
    changes = {"speed_rpm": 120.0, "start_angle_deg": 45.0, "output": {"samples": [100.0]}}
    run = simulate(scene.replace(changes), start=state)
    peak = run["crank_angle"][run["load_forming_force"].argmax()]
    assert np.degrees(peak) == pytest.approx(135.0)
    assert np.degrees(run.samples.at_angle(100.0)["crank_angle"]) == pytest.approx(100.0)
    stopped = simulate(scene.replace({**changes, "solver.max_steps": 20}), start=state)
    assert f"crank angle {np.degrees(stopped['crank_angle'][-1]):.2f} deg" in stopped.info["reason"]


def test_a_bearing_too_small_for_its_journal_is_refused():
    state = first_piece("film").info["state"]
    small = FILM.replace({"joints.crank_pin.clearance": 0.01 * PIN["clearance"]})
    with pytest.raises(InputError, match=r"crank_pin starts with an eccentricity of"):
        simulate(small, start=state)


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("film", {"speed_rpm": 120.0}, "speed_rpm = 120: the crank of the state turns at 240 rpm"),
        ("film", {"film.at_contact": "mixed"}, r"clearance joint 0: .* remember \[0, 5\] numbers"),
        ("restitution", FILM, r"remember \[0\] numbers, those of the state \[5\]"),
        ("film", SCENES["restitution"], r"remember \[5\] numbers, those of the state \[0\]"),
        ("film", {"joints.crank_pin": "ideal"}, "1 joints with clearance, the scene 0"),
        ("film", {"drive": MOTOR}, "has 3 constraint forces, the scene 2: allowed is a run of the"),
    ],
)
def test_a_state_of_another_model_is_refused(name, changes, message):
    state = first_piece(name).info["state"]
    scene = changes if isinstance(changes, Scene) else SCENES[name].replace(changes)
    with pytest.raises(InputError, match=message):
        simulate(scene, start=state)


def test_the_command(tmp_path, capsys):
    scene = tmp_path / "scene.toml"
    FILM.save(scene)
    command = ["run", str(scene), "--no-error", "--no-pictures", "--quiet", "--out"]
    assert main([*command, str(tmp_path / "one")]) == 0
    first = str(tmp_path / "one" / "run.nc")
    assert main([*command, str(tmp_path / "two"), "--from", str(tmp_path / "one")]) == 0
    second = Result.load(tmp_path / "two" / "run.nc")
    assert second.time[0] == Result.load(first).time[-1]
    assert main([*command, str(tmp_path / "three"), "--from", str(tmp_path / "no.nc")]) == 2
    for change, message in (
        ("start_angle_deg=90", "start_angle_deg = 90.0 does nothing"),
        ("start=centred", "start = 'centred' does nothing"),
        ("joints.crank_pin=ideal", "joints.crank_pin.kind = 'ideal'; allowed is 'lubricated'"),
        ("joints.crank_pin=dry", "joints.crank_pin.kind = 'dry'; allowed is 'lubricated'"),
        ("film.at_contact=mixed", "joints.crank_pin.film.at_contact = 'mixed'; allowed is 'stop'"),
        ("speed_rpm=120", "speed_rpm = 120.0; allowed is 240.0, as in that run"),
        ("slider_crank.rod_length=0.384", "joints.wrist_pin.at of the mechanism = (0.0, -0.354"),
        ("bodies.rod=linkage", "bodies = ['rod']; allowed is []"),
        ("mechanism=press", "mechanism = 'press'; allowed is 'slider_crank', as in that run"),
    ):
        went_on = [*command, str(tmp_path / "three"), "--from", first, "--set", change]
        assert main(went_on) == 2
        assert message in capsys.readouterr().err
    assert not (tmp_path / "three").exists()
    was = (tmp_path / "one" / "run.nc").read_bytes()
    assert main([*command, str(tmp_path / "one"), "--from", first, "--overwrite"]) == 2
    assert "would delete the one that it goes on from" in capsys.readouterr().err
    assert (tmp_path / "one" / "run.nc").read_bytes() == was


@pytest.mark.long
def test_after_ten_revolutions_two_pieces_are_the_longer_run_to_the_last_digit():
    """A longer run goes on from such a state itself, in each tenth revolution."""
    scene = DRY.replace({"revolutions": 10.0})
    state = json.loads(json.dumps(simulate(scene).info["state"]))
    second = simulate(scene, start=state)
    whole = simulate(scene.replace({"revolutions": 20.0}))
    last = len(second.time) - 1  # the first instant is the last one of the first piece
    for name in ("slider_position", "slider_velocity", "crank_pin_force"):
        assert np.array_equal(whole[name][-last:], second[name][1:])
    assert np.array_equal(whole.time[-last:], second.time[1:])
