"""The scripts that show the library: each runs, reduced, and ends in the numbers it should."""

import math
import re

import pytest
from running import SCRIPTS, run

from exu_press import Result

FOUR_BAR = 87.8798  # N


@pytest.mark.long
def test_run_press(tmp_path):
    printed = run("run_press.py", tmp_path)
    out = tmp_path / "out" / "run_press"
    result = Result.load(out / "run.nc")
    assert result.completed
    assert f"{1e3 * result.quantity('stroke').value:.5g}" in printed
    assert {"slider.png", "orbit.png", "force.png"} <= {path.name for path in out.glob("*.png")}


@pytest.mark.long
def test_compare_variants(tmp_path):
    head, status, *_ = run("compare_variants.py", tmp_path).splitlines()
    assert head.split() == ["ideal", "dry", "lubricated"]
    assert status.split() == ["status", *["completed"] * 3]
    assert (tmp_path / "out" / "compare_variants" / "compare_slider.png").exists()


@pytest.mark.long
def test_error_vs_runtime(tmp_path):
    printed = run("error_vs_runtime.py", tmp_path)
    (orders,) = re.findall(r"my_slider_crank  fixed step +step +(\S+)", printed)
    assert float(orders) == pytest.approx(2.0, abs=0.3)
    assert list((tmp_path / "out" / "error_vs_runtime").glob("*.png"))


@pytest.mark.long
def test_my_own_part(tmp_path):
    printed = run("my_own_part.py", tmp_path)
    tip, beam = map(float, re.findall(r"([\d.]+) um", printed))
    assert tip == pytest.approx(beam, rel=0.005)
    assert "mass 1.8840 kg" in printed
    assert (tmp_path / "out" / "my_own_part" / "modes.png").exists()


@pytest.mark.long
def test_joint_in_your_model(tmp_path):
    """A rod that falls from the horizontal swings through with 5/2 of its weight."""
    printed = run("joint_in_your_model.py", tmp_path, quick=False)
    film, force = map(float, re.findall(r"([\d.]+) (?:um|N)", printed))
    assert 0.0 < film < 50.0
    assert force == pytest.approx(2.5 * 10.0 * 9.81, rel=0.01)
    assert len((SCRIPTS / "joint_in_your_model.py").read_text("utf-8").splitlines()) <= 30


@pytest.mark.long
def test_your_own_model(tmp_path):
    """Largest pivot force of a four-bar, against 5e4 fixed steps of Exudyn's own: 87.8798 N.

    They were off by six to ten tolerances while accelerations were not looked at.
    """
    printed = run("your_own_model.py", tmp_path, quick=False)
    forces = [float(force) for force in re.findall(r"tolerance \S+: (\S+) N", printed)]
    for force, tolerance in zip(forces[:3], (1e-2, 1e-3, 1e-4), strict=True):
        assert abs(force / FOUR_BAR - 1.0) < 3.0 * tolerance
    assert forces[3] == pytest.approx(forces[5], rel=1e-2)


@pytest.mark.long
def test_ablation(tmp_path):
    """Half the safety is twice the care: less error, more work."""
    rows = run("ablation.py", tmp_path).splitlines()
    (cells,) = (row for row in rows if row.startswith("safety half"))
    error, work = (float(value) for value in cells.split()[-3::2])
    assert error < 1.0 < work


@pytest.mark.long
def test_dry_press_peaks(tmp_path):
    """A tenth of a revolution at ten times the default tolerance, against the independent model."""
    printed = run("dry_press_peaks.py", tmp_path)
    (off,) = re.findall(r"([+-][\d.]+)%", printed)
    assert abs(float(off)) < 2.0
    assert re.search(r"independent model +[\d.]+$", printed.strip())


@pytest.mark.long
def test_dry_press_steps(tmp_path):
    """A period is off by about its phase's square over 12: 2 % of an oscillation at 33 steps."""
    printed = run("dry_press_steps.py", tmp_path)
    after_one, at_the_end = map(int, re.findall(r"(?:after one|that contact): (\d+)", printed))
    assert abs(after_one - math.sqrt((2.0 * math.pi) ** 3 / (12.0 * 0.02))) < 2.0
    (oscillations,) = map(int, re.findall(r"s, (\d+) oscillations", printed))
    assert at_the_end == pytest.approx(after_one * math.sqrt(oscillations), rel=0.03)
    assert all(float(share) > 50.0 for share in re.findall(r" (\d+)%  ", printed))


@pytest.mark.long
def test_press_work_precision(tmp_path):
    """A tenth of a revolution: the tolerance and Radau have the true peak, the fixed step not."""
    printed = run("press_work_precision.py", tmp_path, "--out", "picture.png")
    errors = re.findall(r"^(tolerance|step|Radau) +\S+ +([\d.]+)%", printed, re.MULTILINE)
    assert len(errors) == 6
    for solver, off in errors:
        assert (float(off) > 5.0) is (solver == "step")
    assert (tmp_path / "picture.png").exists()
