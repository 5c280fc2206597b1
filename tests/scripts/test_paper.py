"""scripts/paper.py in its reduced form."""

import json
import re

import pytest
from running import process, run

from paper.published import published

WITH_ERROR = re.compile(r"\+- |exact| to ")


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    directory = tmp_path_factory.mktemp("paper")
    assert run("paper.py", directory, "--quiet", "--no-pictures", "--out", ".") == ""
    return directory


def read(directory):
    return json.loads((directory / "paper.json").read_text())


@pytest.mark.long
def test_every_published_number_has_ours_with_its_error_and_a_verdict(directory):
    report = read(directory)
    head, *rows = report["tables"]["numbers"]
    assert report["quick"] and len(rows) == len(published().numbers) + 1
    assert {cell for row in rows for cell in row[5::3]} <= {"agrees", "differs", "open"}
    for title, (head, *rows) in report["tables"].items():
        for row in rows:
            assert len(row) == len(head), title
            for cell in row[3::3] if title == "numbers" else row[3:4]:
                shown = row[0] == "paper" or cell in ("", "-") or WITH_ERROR.search(cell)
                assert shown, (title, row)
    for runs in report["runs"].values():
        assert all(row["status"] == "completed" for row in runs.values())


@pytest.mark.long
def test_it_goes_on_where_it_was_stopped(directory):
    rows = (directory / "runs.jsonl").read_text().splitlines()
    before = read(directory)
    (directory / "runs.jsonl").write_text("\n".join(rows[3:]) + "\n")
    next(directory.glob("*.nc")).unlink()
    again = process("paper.py", directory, "--out", ".")
    assert again.returncode == 0 and "runs that are finished: " in again.stderr
    assert "REDUCED FORM" in again.stdout and "72 of 72 runs" in again.stdout
    assert read(directory)["tables"] == before["tables"]
    assert len(list(directory.glob("*.nc"))) == 2 * 4 + 2  # the ideal press has no contact
    pictures = {path.stem for path in directory.glob("*.png")}
    assert {"numbers", "sweeps", "clearance", "c_max_2.5545e8_no_load_orbit_dry"} <= pictures
    assert len(pictures) == 3 + 3
