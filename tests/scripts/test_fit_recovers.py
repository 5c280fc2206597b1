"""Fits recover the keys that synthetic measurements were made with."""

import re

import pytest

from fit_recovers import main
from recovery.cases import CASES
from recovery.study import recover


@pytest.mark.long
def test_a_measurement_of_the_lubricated_press(tmp_path):
    found = recover("lubricated press", tmp_path, measurements=1, workers=2)
    for report in found.reports:
        assert report.chi_square < 20.0
        for key, true in found.truth.items():
            low, high = report.low[key], report.high[key]
            assert low - (high - low) < true < high + (high - low)
            assert report.values[key] == pytest.approx(true, rel=0.25)


@pytest.mark.long
def test_forty_measurements_of_three_scenes(tmp_path, capsys):
    assert sum(case.measurements for case in CASES.values()) == 40
    assert main(["--quiet", "--out", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert 36.0 <= float(re.search(r"hold the true key: ([\d.]+) of 40", printed)[1]) <= 40.0
