"""Fits recover the keys that synthetic measurements were made with."""

import re

import pytest

from fit_recovers import main
from recovery.cases import CASES


@pytest.mark.long
def test_forty_measurements_of_three_scenes(tmp_path, capsys):
    assert sum(case.measurements for case in CASES.values()) == 40
    assert main(["--quiet", "--out", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert 36.0 <= float(re.search(r"hold the true key: ([\d.]+) of 40", printed)[1]) <= 40.0
