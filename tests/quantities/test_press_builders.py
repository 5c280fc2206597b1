"""Bottom dead centres, drive, shaking and guides in the summary."""

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.quantities import lowest_of_strokes
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
        (2.0, 12.0, 1),
        (-7.0, 12.0, 3),
        (3.14, 3.14, 0),
    ],
)
def test_a_stroke_counts_where_the_record_holds_a_quarter_turn_on_either_side(begin, end, count):
    angle = np.linspace(begin, end, 500 if end > begin else 1)
    assert len(lowest_of_strokes(angle, angle, *strokes(angle, 1.0), about=np.pi)) == count


def test_stroke_and_dead_centre_lie_between_the_steps():
    """An ideal slider-crank's stroke is twice its crank; of the steps it was 2.6 um less."""
    ideal = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=1.25))
    assert ideal.quantity("stroke").value == pytest.approx(0.06, abs=1e-9)


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


def test_strokes_tilt_and_guides(run):
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
    guides = {"slider", "slide", "plunger_left", "plunger_right", "counterweight"}
    assert guides_of(run.scene) == guides
    assert run.quantity("guides.slider.peak_moment").value > 0.0
    assert run.quantity("guides.slider.dissipated").value > 0.0
    assert all(run.quantity(f"guides.{name}.peak_force").value > 0.0 for name in guides)


def test_peaks_are_those_of_the_channels(run):
    largest = np.linalg.norm(run["shaft_force"], axis=1).max()
    expected = {
        "joints.shaft.peak_force": pytest.approx(largest, rel=1e-12),
        "guides.slider.peak_force": np.abs(run["guide_force"]).max(),
        "shaking.vertical": np.abs(run["shaking_force"][:, 1]).max(),
        "shaking.frame.horizontal": np.abs(run["frame_force"][:, 0]).max(),
        "drive.peak_torque": np.abs(run["drive_torque"]).max(),
    }
    assert {name: run.quantity(name).value for name in expected} == expected
    mean = run.quantity("shaking.vertical_mean_1ms").value
    assert mean < run.quantity("shaking.vertical").value


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
