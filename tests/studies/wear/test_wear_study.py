"""Wear over strokes: by hand, independent of the jump, resumed, and what is refused."""

import json
import shutil

import numpy as np
import pytest
from heavy_wheel import HEAVY_WHEEL
from scipy.optimize import brentq

from exu_press import InputError, Scene
from exu_press.cli import main
from exu_press.laws.profile import profile
from exu_press.studies.wear import WearStudy, wear
from exu_press.studies.wear.run import run_worn
from exu_press.studies.wear.shape import ANGLES, Depths, worn_scene

WEAR = {"coefficient": 1e-4, "hardness": 2e9, "length": 0.1}
STROKES = 400
GUIDED = {"clearance": 2e-5}


def scene(**keys):
    given = {
        "mechanism": HEAVY_WHEEL,
        "joints": {"shaft": {"kind": "dry", "clearance": 5e-5, "radius": 0.05}},
        "contact": {"length": 0.1},
        "friction": {"law": "coulomb", "mu_kinetic": 0.02},
        "speed_rpm": 20.0,
        "revolutions": 2.0,
        "settle": 1.0,
        "wear": WEAR,
    }
    return Scene(**{**given, **keys})


def study(**keys):
    return WearStudy(scene(), wear={"strokes": STROKES, "tolerance": 0.05, **keys})


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    directory = tmp_path_factory.mktemp("coarse")
    return wear(study(), directory), directory


def test_what_is_worn_off_is_archards_volume(coarse):
    """V = k F s / H of a wheel's weight over all strokes, off journal and bearing alike."""
    report, _ = coarse
    by_hand = 1e-4 / 2e9 * 500.0 * 9.81 * 2.0 * np.pi * 0.05 * STROKES
    area = 2.0 * np.pi * 0.05 * WEAR["length"]
    last = report.course[-1]
    assert last.strokes == STROKES
    for depths in (last.depths["shaft"].journal, last.depths["shaft"].bearing):
        assert depths.mean() * area == pytest.approx(by_hand, rel=2e-3)
    shape = last.depths["shaft"].accessible(5e-5)
    assert shape.bearing.mean() * area == pytest.approx(by_hand, rel=0.02)  # smooth, none lost


def test_the_dent_is_as_wide_and_deep_as_the_pin_that_bores_it(coarse):
    """w = e cos - c in the dent of a pin that presses nowhere else, with Archard's volume."""
    report, _ = coarse
    area = 2.0 * np.pi * 0.05 * WEAR["length"] / len(ANGLES)
    volume = 1e-4 / 2e9 * 500.0 * 9.81 * 2.0 * np.pi * 0.05 * STROKES
    round_clearance = 5e-5 + volume / area / len(ANGLES)  # the pin wears evenly

    def dent(eccentricity):
        return np.maximum(eccentricity * np.cos(ANGLES - 1.5 * np.pi) - round_clearance, 0.0)

    bored = brentq(lambda e: dent(e).sum() * area - volume, round_clearance, 3.0 * round_clearance)
    depths = report.course[-1].depths["shaft"]
    assert depths.bearing.max() == pytest.approx(dent(bored).max(), rel=0.03)
    assert report.clearances("shaft")[-1] == pytest.approx(bored, rel=0.01)
    wide = np.count_nonzero(depths.bearing > 0.01 * depths.bearing.max())
    assert wide == pytest.approx(np.count_nonzero(dent(bored)), abs=3)


@pytest.mark.long
def test_jumps_of_other_lengths_lead_to_the_same_clearance(coarse, tmp_path):
    report, _ = coarse
    finer = wear(study(tolerance=0.02), tmp_path)
    assert len(finer.course) > len(report.course)
    ends = [one.clearances("shaft")[-1] for one in (report, finer)]
    assert ends[0] == pytest.approx(ends[1], abs=0.05 * 5e-5)


def test_it_is_read_where_it_was_done_and_the_worn_scene_runs(coarse):
    report, directory = coarse
    runs = (directory / "runs.jsonl").read_bytes()
    again = wear(study(), directory)
    assert (directory / "runs.jsonl").read_bytes() == runs
    assert again.to_dict() == report.to_dict()
    told = json.loads((directory / "wear.json").read_text())
    assert told["joints"]["shaft"]["clearance"] == report.clearances("shaft")
    worn = Scene.load(directory / "worn.toml")
    row = run_worn({"scene": worn.to_dict()})
    force = "joints.shaft.peak_force"
    assert row[force] == pytest.approx(report.course[-1].row[force], rel=1e-6)


def test_dents_of_both_surfaces_stay_in_reach_of_each_other():
    dent = np.zeros(72)
    dent[10:13] = 3e-5
    shape = Depths(dent, dent).accessible(5e-5)
    journal, bearing = (profile(ANGLES, depth).sharpest for depth in (shape.journal, shape.bearing))
    assert -2.5e-5 <= journal < 0.0
    assert journal + bearing >= -5e-5


def test_even_wear_is_a_larger_clearance_to_the_last_digits():
    """Of the run, and of what it wears: nothing but the clearance's mean is left."""
    even = run_worn({"scene": worn_scene(scene(), {"shaft": Depths.even(1e-5)}).to_dict()})
    larger = run_worn({"scene": scene().replace({"joints.shaft.clearance": 6e-5}).to_dict()})
    for name in ("joints.shaft.peak_force", "bottom_dead_centre", "energy.residual"):
        assert even[name] == pytest.approx(larger[name], rel=1e-12, abs=1e-15)
    for name, values in even["contacts"]["shaft"].items():
        assert values == pytest.approx(larger["contacts"]["shaft"][name], rel=1e-9, abs=1e-9), name


@pytest.mark.long
def test_too_few_jumps_end_it_with_their_reason(tmp_path):
    report = wear(study(most_jumps=1), tmp_path)
    assert "1 jumps were not enough" in report.reason
    assert report.to_dict()["status"] == "stopped"


@pytest.mark.parametrize(
    ("keys", "asked", "words"),
    [
        ({"wear": None}, {}, r"no \[wear\]"),
        ({"revolutions": 1.5}, {}, "one revolution more"),
        (
            {"joints": {}, "friction": None, "contact": {"damping": "hu_guo"}, "guide": GUIDED},
            {},
            "no joint wears",
        ),
        ({}, {"strokes": -1.0}, "strokes"),
        ({}, {"strokes": 10.0, "quantities": ["peak"]}, "quantity 'peak'"),
        ({}, {"strokse": 10.0}, "did you mean 'strokes'"),
    ],
)
def test_what_is_refused(keys, asked, words):
    with pytest.raises(InputError, match=words):
        WearStudy(scene(**keys), wear=asked or {"strokes": 10.0})


def test_the_command_and_its_page(coarse, tmp_path, capsys):
    """Of the study that is done already: rows are read."""
    _, directory = coarse
    shutil.copytree(directory, tmp_path / "out")
    scene().save(tmp_path / "scene.toml")
    text = f'scene = "scene.toml"\n[wear]\nstrokes = {STROKES}\ntolerance = 0.05\n'
    (tmp_path / "study.toml").write_text(text)
    out = str(tmp_path / "out")
    assert main(["wear", str(tmp_path / "study.toml"), "--out", out]) == 0
    printed = capsys.readouterr().out
    assert "shaft clearance, um" in printed
    assert printed.splitlines()[-1].startswith("written: wear.json, worn.toml, wear.png in")
    assert (tmp_path / "out" / "wear.png").stat().st_size > 10_000
    assert main(["report", out, "--quiet"]) == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert f"Wear over {STROKES} strokes" in page
    assert (tmp_path / "out" / "runs.jsonl").read_bytes() == (directory / "runs.jsonl").read_bytes()
    (tmp_path / "study.toml").write_text(text + "[keys]\nspeed_rpm = [1.0]\n")
    assert main(["wear", str(tmp_path / "study.toml"), "--out", out]) == 2
    assert "not used by exu-press wear" in capsys.readouterr().err
