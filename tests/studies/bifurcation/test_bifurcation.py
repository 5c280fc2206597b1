"""Bifurcation studies: branches with carried states, resumption, picture, refusals."""

import numpy as np
import pytest
from slider_cranks import FILM

from exu_press import InputError
from exu_press.cli import main
from exu_press.model.state import State
from exu_press.studies.attractor.orbit import Orbit
from exu_press.studies.bifurcation import Bifurcation, bifurcation
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
