"""Bottom dead centres and the press section of the summary."""

import json

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.observe import bottom_dead_centres
from exu_press.scene import mechanism_of

SECTION = {
    "bottom_dead_centre",
    "slider_tilt",
    "slider_lateral",
    "drive",
    "shaking_force",
    "shaking_force_without_counterweight",
    "frame_force",
    "peak_forces",
    "peak_moments",
    "losses",
    "guide_sliding_power",
    "min_film",
}


def strokes(angle, depth, shift=0.3):
    """Position and velocity of a slider whose lowest point comes `shift` rad late."""
    return (
        depth * np.cos(angle - shift),
        -depth * np.sin(angle - shift),
    )


def test_minimum_lies_between_the_samples():
    """Hermite's polynomials find it to the fourth power of the step: 0.1 rad here."""
    angle = np.arange(0.0, 4 * np.pi, 0.1)
    found = bottom_dead_centres(angle, angle, *strokes(angle, 1.0))
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
    assert len(bottom_dead_centres(angle, angle, *strokes(angle, 1.0))) == count


def test_scatter_of_strokes_of_known_depth():
    angle = np.arange(0.0, 6 * np.pi, 0.02)
    depth = np.array([1.0, 1.2, 1.1])[(angle // (2 * np.pi)).astype(int)]
    found = bottom_dead_centres(angle, angle, *strokes(angle, depth))
    assert [c.position for c in found] == pytest.approx([-1.0, -1.2, -1.1], abs=1e-8)


@pytest.fixture(scope="module")
def run():
    scene = {"revolutions": 2.25, "blanking": {"force": 1e4, "eccentricity": 0.1}, "guide": {}}
    return simulate(Scene.from_dict({**scene, "joints": {"crank_pin": "lubricated"}}))


def test_section(run):
    summary = run.summary()
    press = summary["press"]
    assert set(press) == SECTION
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary
    centre = press["bottom_dead_centre"]
    assert len(centre["positions"]) == len(centre["tilts"]) == 2
    assert centre["range"] == pytest.approx(np.ptp(centre["positions"]))
    assert centre["standard_deviation"] == pytest.approx(centre["range"] / np.sqrt(2))
    assert abs(centre["mean"] - 0.47) < 1e-4
    assert press["slider_tilt"] >= np.abs(centre["tilts"]).max() > 0.0
    assert set(press["losses"]) == {
        "crank_pin",
        "guide",
        "slide_guide",
        "plunger_left_guide",
        "plunger_right_guide",
        "counterweight_guide",
    }
    assert press["peak_moments"].keys() == press["losses"].keys() - {"crank_pin"}
    assert {"pivot_left", "shaft", "guide", "ball_left"} < set(press["peak_forces"])
    assert press["min_film"] == summary["joints"]["crank_pin"]["min_film"]


def test_peaks_are_those_of_the_channels(run):
    press = run.summary()["press"]
    largest = np.linalg.norm(run["shaft_force"], axis=1).max()
    assert press["peak_forces"]["shaft"] == pytest.approx(largest, rel=1e-12)
    assert press["peak_forces"]["guide"] == np.abs(run["guide_force"]).max()
    assert press["shaking_force"]["vertical"] == np.abs(run["shaking_force"][:, 1]).max()
    assert press["drive"]["peak_torque"] == np.abs(run["drive_torque"]).max()
    assert press["shaking_force"]["vertical_mean_1ms"] < press["shaking_force"]["vertical"]


def test_means_are_over_the_last_whole_revolutions(run):
    """Two of the 2.25 revolutions; the drive's power there balances what the rest takes."""
    press, time = run.summary()["press"], run.time
    begin = time[-1] - 2 * 60 / 240

    def change(values):
        return values[-1] - np.interp(begin, time, values)

    load = np.concatenate([[0.0], np.cumsum(np.diff(run["energy_input"]))])
    power = run["drive_power"]
    work = np.concatenate([[0.0], np.cumsum(np.diff(time) * (power[1:] + power[:-1]) / 2)])
    assert press["drive"]["mean_power"] == pytest.approx(change(work) / 0.5)
    assert power == pytest.approx(run["drive_torque"] * run.scene.angular_speed)
    blanking = change(load) - change(work)  # what the load puts in
    taken = change(run["energy_stored"]) + change(run["energy_dissipated"])
    bound = 1e-3 * np.abs(run["energy_input"]).max()
    assert abs(change(work) + blanking - taken) < bound
    assert press["losses"]["crank_pin"]["mean_power"] == pytest.approx(
        change(run["crank_pin_loss"]) / 0.5
    )
    lost = sum(loss["mean_power"] for loss in press["losses"].values())
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
    assert result.summary()["press"]["guide_sliding_power"] == pytest.approx(mean, rel=1e-3)
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
    press = short.summary()["press"]
    assert press["bottom_dead_centre"]["positions"] == []
    assert press["bottom_dead_centre"]["mean"] is None
    assert press["bottom_dead_centre"]["range"] is None
    assert press["drive"]["mean_power"] is None
    assert press["min_film"] is None
    assert press["losses"]["crank_pin"]["mean_power"] is None


def test_without_counterweight_there_is_nothing_to_compare_with():
    scene = Scene.from_dict({"joints": {}, "revolutions": 1.0, "solver": {"step": 5e-4}})
    full = simulate(scene).summary()["press"]
    bare = simulate(scene.replace("press.counterweight", False)).summary()["press"]
    assert bare["shaking_force_without_counterweight"] is None
    alone = full["shaking_force_without_counterweight"]["vertical"]
    assert alone == pytest.approx(bare["shaking_force"]["vertical"], rel=1e-6)
    assert full["shaking_force"]["vertical"] < 0.6 * alone


def test_slider_crank_has_no_press_section():
    scene = {"mechanism": "slider_crank", "joints": {}, "revolutions": 0.01}
    assert "press" not in simulate(Scene.from_dict(scene)).summary()
