"""Bottom dead centres, drive, shaking and guides in the summary."""

import json

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.observe import lowest_of_strokes
from exu_press.scene import mechanism_of

SECTION = {"strokes", "slider_tilt", "slider_lateral", "drive", "shaking", "guides"}


def strokes(angle, depth, shift=0.3):
    """Position and velocity of a slider whose lowest point comes `shift` rad late."""
    return (
        depth * np.cos(angle - shift),
        -depth * np.sin(angle - shift),
    )


def test_minimum_lies_between_the_samples():
    """Hermite's polynomials find it to the fourth power of the step: 0.1 rad here."""
    angle = np.arange(0.0, 4 * np.pi, 0.1)
    found = lowest_of_strokes(angle, angle, *strokes(angle, 1.0), about=np.pi)
    assert len(found) == 2
    for number, centre in enumerate(found):
        assert centre.position == pytest.approx(-1.0, abs=1e-6)
        assert centre.crank_angle == pytest.approx(np.pi + 0.3 + 2 * np.pi * number, abs=1e-3)
        assert centre.time == centre.crank_angle
    assert strokes(angle, 1.0)[0].min() > -1.0 + 1e-5


@pytest.mark.parametrize(
    ("begin", "end", "count"),
    [
        (0.0, 2.0, 0),
        (0.0, 4.5, 0),
        (0.0, 4.72, 1),
        (1.56, 4.72, 1),
        (2.0, 12.0, 1),
        (-7.0, 12.0, 3),
        (3.14, 3.14, 0),
    ],
)
def test_a_stroke_counts_where_the_record_holds_a_quarter_turn_on_either_side(begin, end, count):
    angle = np.linspace(begin, end, 500 if end > begin else 1)
    assert len(lowest_of_strokes(angle, angle, *strokes(angle, 1.0), about=np.pi)) == count


def test_scatter_of_strokes_of_known_depth():
    angle = np.arange(0.0, 6 * np.pi, 0.02)
    depth = np.array([1.0, 1.2, 1.1])[(angle // (2 * np.pi)).astype(int)]
    found = lowest_of_strokes(angle, angle, *strokes(angle, depth), about=np.pi)
    assert [c.position for c in found] == pytest.approx([-1.0, -1.2, -1.1], abs=1e-8)


@pytest.fixture(scope="module")
def run():
    scene = {
        "revolutions": 2.25,
        "load": {"blanking": {"kind": "blanking", "force": 1e4, "offset": [0.1, 0.0]}},
        "guide": {},
    }
    return simulate(Scene.from_dict({**scene, "joints": {"crank_pin": "lubricated"}}))


def test_section(run):
    summary = run.summary()
    assert set(summary) > SECTION
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary
    strokes = summary["strokes"]
    assert len(strokes["positions"]) == len(strokes["tilts"]) == 2
    assert strokes["range"] == pytest.approx(np.ptp(strokes["positions"]))
    assert strokes["standard_deviation"] == pytest.approx(strokes["range"] / np.sqrt(2))
    assert abs(strokes["mean"] - 0.47) < 1e-4
    assert min(strokes["positions"]) == pytest.approx(summary["bottom_dead_centre"], abs=1e-7)
    assert summary["slider_tilt"] >= np.abs(strokes["tilts"]).max() > 0.0
    guides = summary["guides"]
    assert set(guides) == {"slider", "slide", "plunger_left", "plunger_right", "counterweight"}
    assert guides["slider"]["peak_moment"] > 0.0 and guides["slider"]["dissipated"] > 0.0
    assert all(guide["peak_force"] > 0.0 for guide in guides.values())


def test_peaks_are_those_of_the_channels(run):
    summary = run.summary()
    largest = np.linalg.norm(run["shaft_force"], axis=1).max()
    assert summary["joints"]["shaft"]["peak_force"] == pytest.approx(largest, rel=1e-12)
    assert summary["guides"]["slider"]["peak_force"] == np.abs(run["guide_force"]).max()
    shaking = summary["shaking"]
    assert shaking["vertical"] == np.abs(run["shaking_force"][:, 1]).max()
    assert shaking["frame"]["horizontal"] == np.abs(run["frame_force"][:, 0]).max()
    assert summary["drive"]["peak_torque"] == np.abs(run["drive_torque"]).max()
    assert shaking["vertical_mean_1ms"] < shaking["vertical"]


def test_means_are_over_the_last_whole_revolutions(run):
    """Two of the 2.25 revolutions; the drive's power there balances what the rest takes."""
    summary, time = run.summary(), run.time
    begin = time[-1] - 2 * 60 / 240

    def change(values):
        return values[-1] - np.interp(begin, time, values)

    load = np.concatenate([[0.0], np.cumsum(np.diff(run["energy_input"]))])
    power = run["drive_power"]
    work = np.concatenate([[0.0], np.cumsum(np.diff(time) * (power[1:] + power[:-1]) / 2)])
    assert summary["drive"]["mean_power"] == pytest.approx(change(work) / 0.5)
    assert power == pytest.approx(run["drive_torque"] * run.scene.angular_speed)
    blanking = change(load) - change(work)  # what the load puts in
    taken = change(run["energy_stored"]) + change(run["energy_dissipated"])
    bound = 1e-3 * np.abs(run["energy_input"]).max()
    assert abs(change(work) + blanking - taken) < bound
    pin = summary["joints"]["crank_pin"]["mean_power"]
    assert pin == pytest.approx(change(run["crank_pin_loss"]) / 0.5)
    lost = pin + sum(guide["mean_power"] for guide in summary["guides"].values())
    assert lost == pytest.approx(change(run["energy_dissipated"]) / 0.5)


def test_what_guides_would_take_if_they_rubbed():
    """Side forces times the ideal mechanism's speeds, over one revolution."""
    scene = Scene(joints={}, revolutions=1.0)
    result = simulate(scene)
    motion = mechanism_of(scene).motion(result["crank_angle"], scene.angular_speed)
    power = np.zeros_like(result.time)
    for body in ("slider", "slide", "plunger_left", "plunger_right", "counterweight"):
        name = "guide_force" if body == "slider" else f"{body}_guide_force"
        power += np.abs(result[name] * motion[body].velocity[:, 1])
    mean = np.trapezoid(power, result.time) / result.time[-1]
    guides = result.summary()["guides"].values()
    assert sum(guide["sliding_power"] for guide in guides) == pytest.approx(mean, rel=1e-3)
    assert mean > 100.0


def test_power_of_an_ideal_drive_is_the_rate_of_stored_energy():
    scene = {"joints": {}, "solver": {"step": 1e-4}, "revolutions": 0.5}
    result = simulate(Scene.from_dict(scene))
    rate = np.gradient(result["energy_stored"], result.time)
    error = np.abs(result["drive_power"] - rate)[40:-1]
    assert error.max() < 1e-3 * np.abs(rate).max()


def test_a_short_run_has_no_means_and_no_dead_centres():
    short = simulate(
        Scene.from_dict({"revolutions": 0.02, "joints": {"crank_pin": "dry", "balls": "dry"}})
    )
    summary = short.summary()
    assert summary["strokes"]["positions"] == []
    assert summary["strokes"]["mean"] is summary["strokes"]["range"] is None
    assert summary["drive"]["mean_power"] is None
    assert summary["joints"]["crank_pin"]["min_film"] is None
    assert summary["joints"]["crank_pin"]["mean_power"] is None
    assert summary["guides"]["slider"]["sliding_power"] is None


@pytest.mark.parametrize(
    ("mechanism", "guides"),
    [("slider_crank", {"slider"}), ("four_bar", set()), ("eccentric_press", {"slide", "ram"})],
)
def test_every_mechanism_has_them(mechanism, guides):
    """And a dead centre a stroke, wherever in the revolution the slider is lowest."""
    scene = Scene(mechanism=mechanism, joints={}, revolutions=2.0, solver={"step": 1e-3})
    summary = simulate(scene).summary()
    assert set(summary) > SECTION
    assert set(summary["guides"]) == guides
    assert summary["shaking"]["vertical"] > 0.0 and summary["drive"]["peak_torque"] > 0.0
    strokes = summary["strokes"]
    assert len(strokes["positions"]) >= 1
    assert strokes["mean"] == pytest.approx(summary["bottom_dead_centre"], abs=1e-5)
