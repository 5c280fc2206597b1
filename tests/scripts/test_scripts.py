"""Scripts run, reduced, and end in the numbers they should; what they refuse, they name."""

import json
import math
import re
import runpy
import sys

import pytest
from running import SCRIPTS, assert_refused, run

FOUR_BAR = 87.8798
"""Largest pivot force of the four-bar against 5e4 fixed steps of Exudyn's own, N."""


@pytest.mark.parametrize("script", sorted(SCRIPTS.glob("*.py")), ids=lambda path: path.stem)
def test_help_is_all_that_help_does(script, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [script.name, "--help"])
    monkeypatch.setattr(sys, "path", [*sys.path])
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(script), run_name="__main__")
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith(f"usage: {script.name}")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("script", "options", "named"),
    [
        ("precision", ["--case", "nothing"], "--case nothing"),
        pytest.param(  # 200 scenes are made before
            "stability", ["--axis", "nothing"], "--axis nothing", marks=pytest.mark.long
        ),
        ("stability", ["--workers", "0"], "workers = 0"),
        ("paper", ["--out", "/dev/null/paper"], "/dev/null/paper"),
    ],
)
def test_wrong_input_is_refused_in_one_line(script, options, named, tmp_path):
    assert_refused(f"{script}.py", tmp_path, *options, named=named)


@pytest.mark.long
@pytest.mark.parametrize(
    ("script", "options", "printed", "picture"),
    [
        ("benchmark_joint_cost", [], "chain, user functions", None),
        ("benchmark_modes", [], "ratio", None),
        ("benchmark_sweep", [], "sweep, 2 workers", None),
        ("benchmark_step", [], "over the first: minimum", None),
        ("flexible_convergence", ["--out", "out"], "error 0.01", None),
        ("flexible_parts", ["--out", "out"], "second shapes", None),
        ("sweep_clearance", [], "4 runs: 4 completed", "sweep_clearance/sweep.png"),
        ("sweep_speed", [], "2 runs: 2 completed", "sweep_speed/sweep.png"),
        ("sweep_blanking_force", [], "2 runs: 2 completed", "sweep_blanking_force/sweep.png"),
        ("my_own_part", [], "mass 1.8840 kg", "my_own_part/modes.png"),
        (
            "stability",
            ["--axis", "bearing length", "--workers", "1", "--out", "out"],
            "4 cases: 4 right, 0 stopped with a reason",
            "stability.png",
        ),
    ],
)
def test_script(script, options, printed, picture, tmp_path):
    assert printed in run(f"{script}.py", tmp_path, *options)
    if picture:
        assert (tmp_path / "out" / picture).stat().st_size > 10_000


@pytest.mark.long
def test_contact_restitution(tmp_path):
    assert "(Table 2)" in run("contact_restitution.py", tmp_path, quick=False)


@pytest.mark.long
def test_one_case_of_the_precision_table(tmp_path):
    options = ["--quiet", "--case", "slider_crank_ideal", "--out", str(tmp_path)]
    assert run("precision.py", tmp_path, *options) == ""
    report = json.loads((tmp_path / "precision.json").read_text())
    assert {row["case"] for row in report["rows"]} == {"slider_crank_ideal"}


@pytest.mark.long
def test_a_calibration_goes_on_where_it_was_stopped(tmp_path):
    options = ["--seed", "5", "--out", "errors"]
    run("calibrate_errors.py", tmp_path, "--scenes", "1", *options, quick=False)
    file = tmp_path / "errors" / "seed_5.jsonl"
    (first,) = map(json.loads, file.read_text().splitlines())
    assert first["status"] == "completed" and first["figures"]
    table = run("calibrate_errors.py", tmp_path, "--scenes", "2", *options, quick=False)
    rows = [json.loads(line) for line in file.read_text().splitlines()]
    assert rows[0] == first and len(rows) == 2
    assert "how they ended: completed (2)" in table


@pytest.mark.long
def test_fixed_steps_have_second_order(tmp_path):
    printed = run("error_vs_runtime.py", tmp_path)
    (orders,) = re.findall(r"my_slider_crank  fixed step +step +(\S+)", printed)
    assert float(orders) == pytest.approx(2.0, abs=0.3)


@pytest.mark.long
def test_your_own_model(tmp_path):
    printed = run("your_own_model.py", tmp_path, quick=False)
    forces = [float(force) for force in re.findall(r"tolerance \S+: (\S+) N", printed)]
    for force, tolerance in zip(forces[:3], (1e-2, 1e-3, 1e-4), strict=True):
        assert abs(force / FOUR_BAR - 1.0) < 3.0 * tolerance
    assert forces[3] == pytest.approx(forces[5], rel=1e-2)


@pytest.mark.long
def test_ablation(tmp_path):
    """Half the safety: less error, more work."""
    rows = run("ablation.py", tmp_path).splitlines()
    (cells,) = (row for row in rows if row.startswith("safety half"))
    error, work = (float(value) for value in cells.split()[-3::2])
    assert error < 1.0 < work


@pytest.mark.long
def test_dry_press_peaks(tmp_path):
    """A tenth of a revolution at ten times the default tolerance, against the independent model."""
    (off,) = re.findall(r"([+-][\d.]+)%", run("dry_press_peaks.py", tmp_path))
    assert abs(float(off)) < 2.0


@pytest.mark.long
def test_dry_press_steps(tmp_path):
    """A period is off by about its phase's square over 12: 2 % of an oscillation at 33 steps."""
    printed = run("dry_press_steps.py", tmp_path)
    after_one, at_the_end = map(int, re.findall(r"(?:after one|that contact): (\d+)", printed))
    assert abs(after_one - math.sqrt((2.0 * math.pi) ** 3 / (12.0 * 0.02))) < 2.0
    (oscillations,) = map(int, re.findall(r"s, (\d+) oscillations", printed))
    assert at_the_end == pytest.approx(after_one * math.sqrt(oscillations), rel=0.03)


@pytest.mark.long
def test_press_work_precision(tmp_path):
    """A tenth of a revolution: the tolerance and Radau have the true peak, the fixed step not."""
    printed = run("press_work_precision.py", tmp_path, "--out", "picture.png")
    errors = re.findall(r"^(tolerance|step|Radau) +\S+ +([\d.]+)%", printed, re.MULTILINE)
    assert len(errors) == 6
    for solver, off in errors:
        assert (float(off) > 5.0) is (solver == "step")


@pytest.mark.long
def test_a_test_hands_its_numbers_to_the_page(tmp_path):
    printed = run("validation.py", tmp_path, "tests/laws/test_contact.py", quick=False)
    (row,) = [line for line in printed.splitlines() if line.startswith("| stiffness of a pin")]
    assert "stiffness, kN/um (3 values)" in row and "exact" in row
    assert "`tests/laws/test_contact.py::test_cylindrical_slope" in printed
