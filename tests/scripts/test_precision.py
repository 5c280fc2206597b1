"""scripts/precision.py, in its reduced form and reduced further."""

import json

import pytest
from running import assert_refused, run


@pytest.mark.long
def test_one_case_of_the_table(tmp_path):
    options = ["--quiet", "--case", "slider_crank_ideal", "--out", str(tmp_path)]
    assert run("precision.py", tmp_path, *options) == ""
    report = json.loads((tmp_path / "precision.json").read_text())
    assert {row["case"] for row in report["rows"]} == {"slider_crank_ideal"}
    assert (tmp_path / "precision_slider_crank_ideal.png").stat().st_size > 10_000


def test_an_unknown_case_is_refused(tmp_path):
    assert_refused("precision.py", tmp_path, "--case", "nothing", named="--case nothing")
