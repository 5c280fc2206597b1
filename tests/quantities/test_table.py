"""What a person reads of a run."""

from exu_press import Scene, simulate
from exu_press.quantities.table import comparison_lines, run_lines


def test_guides_without_friction_say_what_friction_would_take():
    result = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=1.0))
    power = result.quantity("guides.slider.sliding_power").value
    (line,) = (line for line in run_lines(result) if "guide friction at mu 0.1" in line)
    assert float(line.split()[-1]) == float(f"{0.1 * power:.4g}")


def test_guides_with_friction_say_what_it_takes():
    rubbing = Scene(mechanism="slider_crank", joints={}, revolutions=0.1).replace(
        {"guide": {"friction": "coulomb"}}
    )
    result = simulate(rubbing)
    lost = result.quantity("guides.slider.dissipated").value
    (line,) = (x for x in run_lines(result) if x.startswith("energy dissipated in guides, J"))
    assert lost > 0.0
    assert line.endswith(f"slider {lost:.4g}")
    assert "read from revolutions" in run_lines(result)[1]
    assert " 0 to 0.1, with the start" in run_lines(result)[1]


def test_members_of_a_group_that_are_alike_are_one():
    result = simulate(Scene(joints={"balls": "dry"}, revolutions=0.02))
    (line,) = (line for line in run_lines(result) if line.startswith("penetration"))
    assert "balls" in line and "left" not in line


def test_ideal_joints_have_their_forces_in_the_table():
    ideal = simulate(Scene(mechanism="slider_crank", joints={}, revolutions=0.1))
    dry = simulate(Scene(mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=0.02))
    (line,) = (x for x in comparison_lines({"a": ideal, "b": dry}) if x.startswith("joint force"))
    assert line.count("crank pin") == 2


def test_a_detail_repeats_no_unit():
    lines = run_lines(simulate(Scene(joints={}, revolutions=0.02)))
    first = next(n for n, line in enumerate(lines) if line.startswith("peak acceleration, m/s^2 "))
    assert lines[first + 1].startswith("  mean over 1 ms  ")


def test_a_small_machine_has_units_of_its_size():
    """A slider-crank with masses of milligrams: its forces are no zeros of kN."""
    light = dict.fromkeys(("crank_mass", "rod_mass", "slider_mass", "rod_inertia"), 1e-6)
    small = Scene(mechanism="slider_crank", joints={}, revolutions=0.1).replace(
        {f"slider_crank.{name}": mass for name, mass in light.items()}
    )
    result = simulate(small)
    (line,) = (x for x in run_lines(result) if x.startswith("joint force, max, "))
    peak = max(result.quantity(f"joints.{name}.peak_force").value for name in result.joints)
    assert line.startswith("joint force, max, uN ") and f" {1e6 * peak:.3g}" in line, (line, peak)
