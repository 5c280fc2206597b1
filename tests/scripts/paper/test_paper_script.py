"""scripts/paper.py in its reduced form."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "scripts" / "paper.py"

KEYS = {
    "quantity",
    "figure",
    "published",
    "resolved",
    "mean_1ms",
    "differentiated_1khz",
    "ratio",
    "verdict",
    "reason",
}


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    directory = tmp_path_factory.mktemp("paper")
    assert run("--quiet", "--no-pictures", "--out", str(directory)).returncode == 0
    return directory


def run(*arguments):
    """Start the script as a user does."""
    words = [sys.executable, str(SCRIPT), "--quick", *arguments]
    return subprocess.run(words, capture_output=True, text=True, timeout=200)


def test_every_published_number_has_a_row(directory):
    report = json.loads((directory / "paper.json").read_text())
    assert report["quick"] and report["observation_model"] == "mean_1ms"
    assert list(report["dampings"]) == ["2.5545e8", "0.01"]
    for found in report["dampings"].values():
        every_row_is_there(found, report["frequencies"])


def every_row_is_there(found, frequencies):
    rows = [*found["rows"], *frequencies]
    assert all(row.keys() >= KEYS for row in rows)
    assert {row["verdict"] for row in rows} <= {"agrees", "trend", "differs"}
    assert all(row["reason"] for row in rows if row["verdict"] == "differs")
    numbers = [row["published"] for row in rows if not isinstance(row["published"], str)]
    for published in (0.47, 0.466, 0.4688, 0.467, 17.8, 29.4, 57.44, 40.4, 70.2, 105.0, 1e-4,
                      0.438, 0.904, 34.0, 445.0, 23.5, 69.1, 538.192, 12973.3):  # fmt: skip
        assert published in numbers
    assert all(run["status"] == "completed" for run in found["runs"].values())


def test_peaks_side_by_side(directory):
    """The almost undamped contact has no peaks that are hidden between samples."""
    report = json.loads((directory / "paper.json").read_text())
    damped, undamped = (found["peaks"][0] for found in report["dampings"].values())
    assert damped["names"] == undamped["names"] and len(damped["names"]) == 9
    assert damped["resolved_over_mean_1ms"] > 3.0 > 1.1 > undamped["resolved_over_mean_1ms"]
    assert damped["distances"]["resolved"] > undamped["distances"]["resolved"] > 0.0


def test_sensitivity_and_clearance(directory):
    report = json.loads((directory / "sensitivity.json").read_text())["dampings"]["2.5545e8"]
    assert report["distances_of_peaks"].keys() >= {"observation model = resolved"}
    by_name = {number["name"]: number for number in report["numbers"]}
    factors = {f["factor"]: f for f in by_name["acceleration_200um"]["factors"]}
    wider = next(s for s in factors["clearance of the balls"]["settings"] if s["label"] == "twice")
    assert wider["change"] > 0.1  # the balls' fall is longer
    choice = json.loads((directory / "clearance.json").read_text())["2.5545e8"]
    assert len(choice["alike"]) == 2 and len(choice["separate"]) == 4
    film = {point["pin"]: point["losses"]["pin"] for point in choice["alike"]}
    assert 3.0 < film[5e-5] / film[2e-4] < 4.0  # sheared four times as hard; the wide one pressed


def test_it_goes_on_where_it_was_stopped(directory):
    rows = (directory / "runs.jsonl").read_text().splitlines()
    report = (directory / "paper.json").read_text()
    (directory / "runs.jsonl").write_text("\n".join(rows[:-5]) + "\n")
    next((directory / "runs").glob("*.nc")).unlink()
    again = run("--no-pictures", "--out", str(directory))
    assert again.returncode == 0
    assert len((directory / "runs.jsonl").read_text().splitlines()) == len(rows)
    assert "are there" in again.stderr
    assert "REDUCED FORM" in again.stdout and "largest" not in again.stderr
    before, after = (json.loads(text)["dampings"] for text in (report, read(directory)))
    assert before == after


def read(directory):
    return (directory / "paper.json").read_text()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [(["--workers", "0"], "workers = 0"), (["--out", "/dev/null/paper"], "/dev/null/paper")],
)
def test_wrong_input_is_refused_in_one_line(arguments, named, tmp_path):
    refused = run("--out", str(tmp_path), *arguments)
    assert refused.returncode == 2
    assert named in refused.stderr and refused.stderr.count("\n") == 1
