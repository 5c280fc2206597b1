"""Bottom dead centres, drive, shaking and guides; of whole revolutions after the start."""

from dataclasses import replace

import numpy as np
import pytest

from exu_press import InputError, Scene, simulate
from exu_press.quantities import lowest_of_strokes
from exu_press.quantities.dead_centre import behind_cut_centre
from exu_press.result.windows import interpolated_window
from exu_press.scene import mechanism_of


def strokes(angle, depth, shift=0.3):
    """Position and velocity of a slider whose lowest point comes `shift` rad late."""
    return (depth * np.cos(angle - shift), -depth * np.sin(angle - shift))


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
        (1.571, 4.712, 1),
        (2.0, 12.0, 1),
        (-7.0, 12.0, 3),
        (3.14, 3.14, 0),
    ],
)
def test_a_stroke_counts_where_the_record_holds_a_quarter_turn_on_either_side(begin, end, count):
    angle = np.linspace(begin, end, 500 if end > begin else 1)
    assert len(lowest_of_strokes(angle, angle, *strokes(angle, 1.0), about=np.pi)) == count


@pytest.fixture(scope="module")
def run():
    scene = {
        "revolutions": 2.25,
        "load": {"blanking": {"kind": "blanking", "force": 1e4, "offset": [0.1, 0.0]}},
        "guide": {"lateral_stiffness": 1e9},
        "solver": {"tolerance": 1e-2},
    }
    return simulate(Scene.from_dict({**scene, "joints": {"crank_pin": "lubricated"}}))


def guides_of(scene):
    return {guide.body for guide in mechanism_of(scene).guides}


def test_strokes_and_peaks_are_those_of_the_channels(run):
    summary = run.summary()
    positions = [stroke["position"] for stroke in summary["strokes"]]
    spread = run.quantity("strokes.range").value
    assert len(positions) == 2
    assert spread == pytest.approx(np.ptp(positions))
    assert run.quantity("strokes.standard_deviation").value == pytest.approx(spread / np.sqrt(2))
    assert abs(run.quantity("strokes.mean").value - 0.47) < 1e-4
    assert min(positions) == pytest.approx(run.quantity("bottom_dead_centre").value, abs=1e-7)
    tilts = [abs(stroke["tilt"]) for stroke in summary["strokes"]]
    assert run.quantity("slider_tilt").value >= max(tilts) > 0.0
    assert run.quantity("guides.slider.peak_force").value == np.abs(run["guide_force"]).max()
    vertical, horizontal = run["shaking_force"][:, 1], run["frame_force"][:, 0]
    assert run.quantity("shaking.vertical").value == np.abs(vertical).max()
    assert run.quantity("shaking.frame.horizontal").value == np.abs(horizontal).max()
    assert run.quantity("drive.peak_torque").value == np.abs(run["drive_torque"]).max()


def test_no_mean_over_a_part_of_a_step_is_above_the_peak():
    """Forces alternate from step to step: their means over 1 ms were 11 % above the peaks."""
    coarse = {"solver": {"step": 5e-3}, "speed_rpm": 240.0, "revolutions": 1.0}
    run = simulate(Scene(mechanism="slider_crank", joints={}, **coarse))
    for direction in ("horizontal", "vertical"):
        peak, mean = (f"shaking.frame.{direction}{end}" for end in ("", "_mean_1ms"))
        assert 0.9 * run.quantity(peak).value < run.quantity(mean).value <= run.quantity(peak).value


def test_means_are_over_the_last_whole_revolutions(run):
    """Two of the 2.25 revolutions."""
    time = run.time
    begin = time[-1] - 2 * 60 / 240

    def change(values):
        return values[-1] - np.interp(begin, time, values)

    power = run["drive_power"]
    work = np.concatenate([[0.0], np.cumsum(np.diff(time) * (power[1:] + power[:-1]) / 2)])
    assert run.quantity("drive.mean_power").value == pytest.approx(change(work) / 0.5)
    assert power == pytest.approx(run["drive_torque"] * run.scene.angular_speed)
    pin = run.quantity("joints.crank_pin.mean_power").value
    assert pin == pytest.approx(change(run["crank_pin_loss"]) / 0.5)
    guides = [run.quantity(f"guides.{n}.mean_power").value for n in guides_of(run.scene)]
    lost = pin + sum(guides)
    assert lost == pytest.approx(change(run["energy_dissipated"]) / 0.5)


@pytest.mark.parametrize(("settle", "twist"), [(0.0, -5e-6), (1.0, -5e-6), (0.0, 5e-6)])
def test_a_revolution_is_whole_though_a_crank_twists_a_little(run, settle, twist):
    """A flexible crank's 1.99999 were one: totals were of two revolutions, means of the last."""
    two = interpolated_window(run, 0.0, 0.5)
    twisted = two.with_values({"crank_angle": two["crank_angle"] * (1.0 + twist)})
    twisted = replace(twisted, scene=run.scene.replace({"settle": settle}))
    count = 2.0 - settle
    for name in ("energy.dissipated", "joints.crank_pin.dissipated"):
        total = twisted.quantity(name).value
        assert count * twisted.quantity(f"{name}_per_stroke").value == pytest.approx(total)
    total = twisted.quantity("joints.crank_pin.dissipated").value
    mean = twisted.quantity("joints.crank_pin.mean_power").value
    assert mean * 0.25 * count == pytest.approx(total, rel=1e-5)


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
    powers = [result.quantity(f"guides.{n}.sliding_power").value for n in guides_of(scene)]
    assert sum(powers) == pytest.approx(mean, rel=1e-3)
    assert result.quantity("drive.guide_friction_power").value == pytest.approx(0.1 * sum(powers))
    assert mean > 100.0


SHEET = {
    "kind": "sheet",
    "height": 3e-3,
    "thickness": 2e-3,
    "shear_strength": 3e8,
    "cut_length": 0.02,
    "penetration": 0.4,
    "crack_time": 2e-4,
}


def test_a_crank_that_a_motor_speeds_up_is_no_reverse_load():
    """With ideal joints the output is where its crank has it: nothing is stored, none returns.

    Beside the motion of a crank of constant speed it would be 0.23 of the largest load.
    """
    result = simulate(
        Scene(
            mechanism="slider_crank",
            joints={},
            revolutions=1.0,
            drive={"rated_torque": 1e3, "slip": 0.2, "no_load_speed_rpm": 300.0, "inertia": 1.0},
            load={"part": SHEET},
            solver={"tolerance": 1e-4},
        )
    )
    assert result.completed
    assert result.quantity("loads.part.peak_force").value > 1e4
    assert result.quantity("loads.part.reverse_share").value < 0.01
    assert result.quantity("loads.part.stack_up").value < 1e-8


PIN = {"wrist_pin": {"kind": "dry", "clearance": 1e-4}}


def crank(**keys):
    return Scene(mechanism="slider_crank", joints=PIN, **keys)


def test_one_revolution_where_a_run_has_two_and_none_in_the_paper_s_press():
    assert crank(revolutions=2.0).settle_revolutions == 1.0
    assert crank(revolutions=1.9).settle_revolutions == 0.0
    assert crank(revolutions=1.9, settle=0.5).settle_revolutions == 0.5
    assert Scene(revolutions=5.0).settle_revolutions == 0.0
    with pytest.raises(InputError, match=r"settle = 2.0: allowed is a number < revolutions = 1.0"):
        crank(revolutions=1.0, settle=2.0)


@pytest.fixture(scope="module")
def settled():
    return simulate(crank(revolutions=2.1, start_angle_deg=30.0, solver={"tolerance": 1e-2}))


def test_peaks_and_energies_are_of_the_second_revolution(settled):
    turns = (settled["crank_angle"] - settled["crank_angle"][0]) / (2.0 * np.pi)
    inside = (turns >= 1.0) & (turns <= 2.0)
    assert settled.summary()["read_from"] == pytest.approx({"from": 1.0, "to": 2.0}, abs=1e-6)
    largest = np.abs(settled["slider_acceleration"][inside]).max()
    assert settled.quantity("peak_acceleration.resolved").value == pytest.approx(largest)
    lost = settled["energy_dissipated"]
    expected = np.interp(2.0, turns, lost) - np.interp(1.0, turns, lost)
    assert settled.quantity("energy.dissipated").value == pytest.approx(expected, rel=1e-6)
    at_start, later = (
        max(np.linalg.norm(joint.force[steps], axis=1).max() for joint in settled.joints.values())
        for steps in (turns < 1.0, inside)
    )
    assert settled.quantity("start_ratio").value == pytest.approx(at_start / later)
    power = settled.quantity("drive.mean_power").value
    assert power == pytest.approx(settled.quantity("energy.input").value / 0.25, rel=1e-3)


@pytest.mark.parametrize(
    ("begin", "end", "first"),
    [(180.0, 540.0, 270.0), (177.0, 560.0, 270.0), (185.0, 540.0, 270.0), (100.0, 460.0, 100.0),
     (90.01, 540.01, 90.01), (90.0, 450.0, 90.0), (0.0, 720.0, 0.0), (180.0, 530.0, 180.0)],
)  # fmt: skip
def test_where_whole_dead_centres_begin(begin, end, first):
    angle = np.radians(np.arange(begin, end + 0.5))
    index = behind_cut_centre(angle, np.pi)
    assert np.degrees(angle[index]) == pytest.approx(first, abs=1.0)
