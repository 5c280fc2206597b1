"""A study file, its points and what is refused; the table's files read back to the last bit."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import netcdf_file

from exu_press import InputError, Scene
from exu_press.studies.base import load_study
from exu_press.studies.base.keys import keys_from
from exu_press.studies.sweep import Sweep
from exu_press.studies.sweep.report import report_of
from exu_press.studies.sweep.study import SweepTable, points_of

SCENE = '[scene]\njoints.crank_pin = "lubricated"\n'


LIST = '[sweep]\nway = "list"\n'
SAMPLE = '[sweep]\nway = "sample"\nn = 5\nseed = 2\n'


def load(tmp_path, text):
    path = tmp_path / "study.toml"
    path.write_text(text, encoding="utf-8")
    return load_study(path, Sweep)


def test_a_scene_beside_the_study(tmp_path, monkeypatch):
    (tmp_path / "scene.toml").write_text(SCENE.replace("[scene]\n", ""))
    monkeypatch.chdir("/")
    study = load(
        tmp_path,
        'scene = "scene.toml"\n[keys]\nfilm.viscosity = [0.1, 0.2]\n[sweep]\nway = "list"\n',
    )
    assert study.scene == Scene(joints={"crank_pin": "lubricated", "balls": "ideal"})
    assert [scene.film["viscosity"] for scene in study.scenes] == [0.1, 0.2]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[keys]\nspeed_rpm = [1]  # no scene\n", "no scene; allowed is scene = "),
        ("scene = 3\n[keys]\nspeed_rpm = [1]\n", "scene = 3: allowed is a table"),
        ("", r"no keys; allowed is a \[keys\] table"),
        ("# no scene\n", r"no scene and no keys; allowed is scene = .*, and a \[keys\] table"),
        ("[keys]\n", r"\[keys\]: empty"),
        ("[keys]\nspeed_rpm = []\n", r"keys.speed_rpm = \[\]: allowed is \[value"),
        ("[keys]\nspeed_rpm = 200\n", r"keys.speed_rpm = 200: allowed is \[value"),
        (
            "[keys]\nspeed_rpm = {low = 2, high = 1}\n",
            "speed_rpm: low = 2, high = 1: allowed is low < high",
        ),
        ("[keys]\nspeed_rpm = {low = 200, high = 300}\n", "with way = .grid. is a list of values"),
        (SAMPLE + "[keys]\nspeed_rpm = [200, 300]\n", "allowed with way = .sample. is"),
        (
            SAMPLE + "[keys]\nspeed_rpm = {mean = 200, deviation = 9, low = 300}\n",
            "keys.speed_rpm: mean = 200, low = 300, high = inf: allowed is low < mean < high",
        ),
        ("[sweep]\nn = 3\n[keys]\nspeed_rpm = [1]\n", "sweep.n: is not used with way = .grid."),
        (
            "[sweep]\nway = 'sample'\nn = 3\n[keys]\nspeed_rpm = {low = 1, high = 2}\n",
            "sweep.seed: is",
        ),
        (LIST + "[keys]\nspeed_rpm = [1]\ngravity = [9, 8]\n", "speed_rpm has 1, gravity has 2"),
        (
            '[keys]\nspeed_rpm = [200.0, -1.0]\n"film.viscosity" = [0.1]\n',
            r"run with speed_rpm = -1\.0, film\.viscosity = 0\.1: speed_rpm = -1\.0: allowed",
        ),
        ('[keys]\njoints.crank_pin = ["ideal"]\nfilm.viscosity = [0.1]\n', "not used by this"),
        ('scene = "nowhere.toml"\n[keys]\nspeed_rpm = [1]\n', "nowhere.toml: cannot be read"),
    ],
)
def test_what_is_refused(tmp_path, text, message):
    with pytest.raises(InputError, match=message) as refused:
        load(tmp_path, text if "scene" in text else text + SCENE)
    assert "\n" not in str(refused.value)
    assert ".toml" in str(refused.value)


def test_a_latin_hypercube_has_one_point_in_every_slice():
    ranges = {"a": {"low": 0.0, "high": 1.0}, "b": {"low": 10, "high": 1000, "log": True}}
    normal = {"c": {"mean": 5.0, "deviation": 2.0, "low": 0.0}}
    keys = keys_from(ranges | normal)
    points = points_of(keys, SweepTable(way="sample", n=20, seed=3))
    for name, each in keys.items():
        shares = each.share(np.array([point[name] for point in points]))
        assert sorted((20 * shares).astype(int)) == list(range(20))
    assert points == points_of(keys, SweepTable(way="sample", n=20, seed=3))
    assert not np.allclose(
        [p["a"] for p in points],
        [p["a"] for p in points_of(keys, SweepTable(way="sample", n=20, seed=4))],
    )


def test_too_many_runs_are_refused():
    with pytest.raises(InputError, match="runs; allowed are at most"):
        points_of(keys_from({str(n): [0] * 10 for n in range(30)}), SweepTable())
    with pytest.raises(InputError, match="runs; allowed are at most"):
        table = SweepTable(way="sample", n=10**9, seed=1)
        points_of(keys_from({"a": {"low": 0, "high": 1}}), table)


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
