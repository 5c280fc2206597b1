"""The table: columns, gaps, files that read back to the last bit."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import netcdf_file

from exu_press import InputError, Scene
from exu_press.studies.sweep import Sweep
from exu_press.studies.sweep.report import report_of

ROWS = [
    {
        "status": "completed",
        "reason": "",
        "cost.wall_time": 1.25,
        "cost.steps": 10,
        "bottom_dead_centre": 0.1 + 0.2,
        "joints.crank_pin.min_film": None,
        "joints.crank_pin.peak_force": 1e3,
        "list": [1.0, 2.0],
        "flag": True,
    },
    {"status": "failed", "reason": 'ValueError: "a", b'},
    {
        "status": "film broke down",
        "reason": "at 0.1 s \N{GREEK SMALL LETTER MU}",
        "bottom_dead_centre": math.pi,
    },
]


@pytest.fixture
def table():
    study = Sweep(
        scene=Scene(joints={"crank_pin": "ideal", "balls": "ideal"}),
        keys={"speed_rpm": [200.0, 300.0, 400.0]},
    )
    return report_of(study, ROWS, ["1.nc", "2.nc", "3.nc"])


def test_csv_reads_back_bit_by_bit(table, tmp_path):
    table.save(tmp_path)
    with (tmp_path / "table.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["completed", "failed", "film broke down"]
    assert rows[1]["reason"] == ROWS[1]["reason"]
    assert [float(row["bottom_dead_centre"]) for row in (rows[0], rows[2])] == [0.1 + 0.2, math.pi]
    assert rows[1]["bottom_dead_centre"] == rows[0]["joints.crank_pin.min_film"] == ""
    assert rows[0]["flag"] == "true" and rows[0]["cost.steps"] == "10"


def test_netcdf_reads_back(table, tmp_path):
    table.save_netcdf(tmp_path / "table.nc")
    with netcdf_file(tmp_path / "table.nc", mmap=False) as file:
        assert file.dimensions["run"] == 3
        assert file.variables["bottom_dead_centre"][:].tolist()[::2] == [0.1 + 0.2, math.pi]
        assert np.isnan(file.variables["bottom_dead_centre"][1])
        assert file.variables["speed_rpm"].units == b"rpm"
        texts = [b"".join(row).rstrip(b"\0").decode() for row in file.variables["reason"][:]]
        assert texts == [row["reason"] for row in ROWS]


def test_which_quantities_are_shown(table):
    assert table.quantities() == ("bottom_dead_centre", "joints.crank_pin.peak_force")
    assert replace(table, selected=["cost.steps"]).quantities() == ("cost.steps",)
    with pytest.raises(InputError, match=r"--show status: allowed are .*bottom_dead_centre"):
        replace(table, selected=["status"]).quantities()
