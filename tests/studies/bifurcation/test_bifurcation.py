"""Bifurcation studies: branches with carried states, maps of two keys, pictures, refusals."""

import numpy as np
import pytest
from slider_cranks import FILM

from exu_press import InputError
from exu_press.cli import main
from exu_press.model.state import State
from exu_press.studies.attractor.orbit import Orbit
from exu_press.studies.bifurcation import Bifurcation, BifurcationReport, Branch, bifurcation
from exu_press.studies.bifurcation.figure import period_map_figure
from exu_press.studies.bifurcation.run import rescale_state

SHORT = {"skip": 1, "revolutions": 20, "longest": 2}
SPEEDS = {"speed_rpm": [230.0, 240.0]}


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    directory = tmp_path_factory.mktemp("bifurcation")
    study = Bifurcation(scene=FILM, keys=SPEEDS, bifurcation=SHORT)
    return directory, study, bifurcation(study, directory, workers=2)


@pytest.mark.long
def test_both_ways_end_on_the_same_attractor_where_there_is_one(found):
    up, down = found[2].branches
    assert (up.name, up.values) == ("up", (230.0, 240.0))
    assert (down.name, down.values) == ("down", (240.0, 230.0))
    for one, other in zip(up.rows, down.rows[::-1], strict=True):
        assert one["status"] == other["status"] == "completed"
        assert one["period"] == other["period"] == 1
        assert one["motion"] == "regular"
        apart = np.linalg.norm(np.array(one["points"])[-1] - np.array(other["points"])[-1])
        assert apart < 10.0 * (one["error"] + other["error"])


def test_a_state_fits_another_speed():
    orbit = Orbit(FILM)
    state: State = orbit.state
    orbit.close()
    now = rescale_state(state, FILM.speed_rpm, 1.01 * FILM.speed_rpm)
    faster = Orbit(FILM.replace({"speed_rpm": 1.01 * FILM.speed_rpm}), now)
    before = faster.point() if faster.revolutions else None
    result = faster.advance(recorded=True)
    faster.close()
    assert before is None
    assert result["crank_speed"][0] == pytest.approx(1.01 * FILM.angular_speed, rel=1e-9)
    assert np.ptp(result["crank_speed"]) < 1e-6 * FILM.angular_speed
    turned = result["crank_angle"] / (2.0 * np.pi)
    assert turned[-1] == pytest.approx(2.0, abs=1e-6)


@pytest.mark.long
def test_the_command(tmp_path, capsys):
    FILM.replace({"solver.tolerance": 1e-3}).save(tmp_path / "film.toml")
    study = tmp_path / "speed.toml"
    study.write_text(
        'scene = "film.toml"\n[keys]\nspeed_rpm = [240.0]\n'
        '[bifurcation]\nway = "from the start"\nskip = 1\nrevolutions = 20\nlongest = 2\n'
    )
    assert main(["bifurcation", str(study), "--out", str(tmp_path / "out"), "--workers", "1"]) == 0
    assert "1 revolution" in capsys.readouterr().out
    assert (tmp_path / "out" / "bifurcation.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("keys", "own", "words"),
    [
        ({**SPEEDS, "film.viscosity": [0.2, 0.1]}, {}, "keys.film.viscosity: allowed are numbers"),
        ({"speed_rpm": {"low": 1.0, "high": 2.0}}, {}, r"allowed is \[number, ...\]"),
        ({"revolutions": [1.0, 2.0]}, {}, "keys.revolutions: bifurcation.skip and bifurcation"),
        ({"speed_rpm": [240.0, 230.0]}, {}, "keys.speed_rpm: allowed are numbers that increase"),
        (SPEEDS, {"revolutions": 20, "longest": 8}, "allowed are at least 24, for periods up to 8"),
        ({**SPEEDS, "film.viscosity": [0.1], "gravity": [9.0]}, {}, "is one key, or two for a map"),
    ],
)
def test_refused(keys, own, words):
    with pytest.raises(InputError, match=words):
        Bifurcation(scene=FILM, keys=keys, bifurcation=own)


def test_a_scene_without_an_orbit_is_refused_before_its_runs(tmp_path):
    ideal = FILM.replace({"joints.crank_pin": "ideal", "film": None})
    with pytest.raises(InputError, match="joints: none has clearance"):
        bifurcation(Bifurcation(scene=ideal, keys=SPEEDS, bifurcation=SHORT), tmp_path)
    assert not any(tmp_path.iterdir())


KEYS = {"joints.crank_pin.clearance": [5e-5, 1e-4, 2e-4], "speed_rpm": [200.0, 240.0]}


def row(period, told=True, value=0.25):
    words = "undecided (why)" if not told else f"{period} revolutions"
    return {
        "status": "completed", "reason": "", "points": np.full((20, 4), value).tolist(),
        "period": period, "decided": told, "in_words": words, "error": 1e-3,
        "exponent": [-1.0, None, -0.5], "motion": "regular", "state": {},
    }  # fmt: skip


@pytest.fixture
def report():
    """A map with one run of each kind: periods 1 and 2, none, not told, and a failed one."""
    study = Bifurcation(scene=FILM, keys=KEYS, bifurcation={**SHORT, "way": "down"})
    values = study.values[::-1]
    lower = [row(1, value=0.1), row(2), {"status": "failed", "reason": "why not"}]
    upper = [row(None), row(None, told=False), row(1)]
    branches = [Branch("down", values, lower, 200.0), Branch("down", values, upper, 240.0)]
    return BifurcationReport(study, branches)


def test_every_point_has_both_keys(report):
    told = report.to_dict()
    assert (told["key"], told["second_key"]) == tuple(KEYS)
    places = [(one["value"], one["second"]) for one in told["branches"]["down"]]
    assert places == [(x, y) for y in (200.0, 240.0) for x in (2e-4, 1e-4, 5e-5)]
    assert "state" not in told["branches"]["down"][0]
    lines = report.lines()
    assert lines[0].split()[:4] == ["joints.crank_pin.clearance,", "m", "speed_rpm", "way"]
    assert len(lines) == 7
    assert "why not" in lines[3]


def test_the_dataset_finds_a_point_by_its_keys(report):
    pytest.importorskip("xarray")
    found = report.to_xarray()
    clearances, speeds = KEYS.values()
    assert found["points"].shape == (1, 3, 2, 20, 4)
    first = found.sel({"way": "down", "joints.crank_pin.clearance": 2e-4, "speed_rpm": 200.0})
    assert float(first["points"][0, 0]) == 0.1
    assert found["period"].sel(way="down").values.tolist() == [
        [pytest.approx(np.nan, nan_ok=True), 1.0],
        [2.0, pytest.approx(np.nan, nan_ok=True)],
        [1.0, 0.0],
    ]
    assert found["joints.crank_pin.clearance"].values.tolist() == clearances
    assert found["speed_rpm"].values.tolist() == speeds
    assert found["joints.crank_pin.clearance"].attrs["units"] == "m"
    assert np.isnan(first["exponent_low"])
    assert float(first["exponent_high"]) == -0.5
    assert found["revolution"].values[[0, -1]].tolist() == [2, 21]


def test_the_map_shows_each_cell(report):
    periods, exponents, _ = period_map_figure(report).axes
    drawn = {text.get_position(): text.get_text() for text in periods.texts}
    assert drawn == {
        (0, 0): "x", (1, 0): "2", (2, 0): "1", (0, 1): "1", (1, 1): "?", (2, 1): "-"
    }  # fmt: skip
    assert [label.get_text() for label in periods.get_xticklabels()] == ["50", "100", "200"]
    legend = [text.get_text() for text in periods.get_legend().get_texts()]
    assert legend == ["1", "2", "-: none up to 2", "?: undecided", "x: failed"]
    assert np.isnan(np.ma.filled(exponents.images[0].get_array(), np.nan)[0, 0])
