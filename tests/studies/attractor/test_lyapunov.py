"""Lyapunov exponents: of maps with known ones through the same mean, and of presses."""

import json
import math

import numpy as np
import pytest

from exu_press import Scene
from exu_press.cli import main
from exu_press.quantities import quantities_of
from exu_press.studies.attractor import attractor
from exu_press.studies.attractor.lyapunov import combine_exponents
from exu_press.studies.attractor.orbit import NoMotion, Orbit

FILM = Scene(
    mechanism="slider_crank",
    joints={"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.03}},
    film={"law": "short", "length": 0.05, "viscosity": 0.1},
    solver={"tolerance": 1e-3},
)


def grown(step, x, distance, count):
    """Return logarithms of growth of two neighbours of a map, brought back in every step."""
    y, found = x + distance, []
    for _ in range(count):
        x, y = step(x), step(y)
        apart = float(np.linalg.norm(y - x))
        found.append(math.log(apart / distance))
        y = x + (y - x) * distance / apart
    return np.array(found)


def logistic(x):
    return 4.0 * x * (1.0 - x)


def henon(x):
    return np.array([1.0 - 1.4 * x[0] ** 2 + x[1], 0.3 * x[0]])


@pytest.mark.parametrize(
    ("step", "start", "known"),
    [(logistic, [0.3], math.log(2.0)), (henon, [0.1, 0.1], 0.4192)],
    ids=["logistic", "Henon: Sprott 2003, 5.2"],
)
def test_a_map_has_its_exponent(step, start, known):
    growths = [grown(step, np.array(start), d, 4000) for d in (1e-6, 1e-7)]
    found = combine_exponents(growths, (1e-6, 1e-7), 1e-15, (0.0, 0.0))
    assert found.low < known < found.high < found.low + 0.1
    assert found.sign == "chaotic"


def test_a_contraction_is_known_down_to_the_error():
    growths = [np.full(40, math.log(0.5)) + 1e-3 * np.arange(40) for _ in range(2)]
    found = combine_exponents(growths, (1e-2, 1e-3), 1e-6, (0.0, 0.0))
    assert found.value == pytest.approx(math.log(0.5), abs=0.03)
    assert found.sign == "regular"
    below = combine_exponents(
        [np.full(40, math.log(1e-6 / d)) for d in (1e-2, 1e-3)], (1e-2, 1e-3), 1e-6, (2.0, 2.0)
    )
    assert below.low == -math.inf
    assert below.high == pytest.approx(math.log(3.0 * 1e-6 / 1e-2))  # three errors, of the farther
    assert below.sign == "regular"


@pytest.fixture(scope="module")
def lubricated():
    return attractor(FILM, revolutions=20, skip=2, most=4)


@pytest.mark.long
def test_a_lubricated_press_is_regular_and_comes_back(lubricated):
    assert lubricated.period.revolutions == 1
    assert lubricated.exponent.high < 0.0
    assert lubricated.exponent.sign == "regular"
    assert lubricated.per_second[2] == pytest.approx(4.0 * lubricated.exponent.high)
    assert lubricated.transient[-1] < 1e-2


@pytest.mark.long
def test_a_press_from_the_centre_has_the_exponent_that_it_tends_to():
    """-0.238 a revolution after some 30; in those before, neighbours come together faster."""
    found = attractor(
        Scene(start="centred", speed_rpm=500.0, film={"law": "pinkus"}),
        revolutions=20,
        skip=8,
        most=2,
        names=["peak_velocity"],
    ).exponent
    assert found.low < -0.238 < found.high
    assert found.high - found.low < 1.0


def test_a_command_of_few_revolutions_keeps_the_figures_of_each(tmp_path, capsys, monkeypatch):
    """A fifth of those that an exponent needs, which stays undecided."""
    for module in ("motion", "lyapunov"):
        monkeypatch.setattr(f"exu_press.studies.attractor.{module}.BATCHES", 2)
    scene, out = tmp_path / "film.toml", tmp_path / "out"
    FILM.replace({"solver.tolerance": 1e-2}).save(scene)
    given = ["attractor", str(scene), "--revolutions", "4", "--skip", "2", "--longest", "1"]
    assert main([*given, "--no-pictures", "--out", str(out)]) == 3
    printed = capsys.readouterr()
    assert "the period is undecided" in printed.err
    assert "largest Lyapunov exponent" in printed.out
    figures = json.loads((out / "attractor.json").read_text())["figures"]
    values = np.array(figures["joints.crank_pin.peak_force"])
    assert values.shape == (4,)
    assert np.ptp(values) < 1e-2 * values.mean()
    assert set(figures) == {
        name for name, placed in quantities_of(FILM).items() if placed.quantity.headline
    }


def stops_after(count):
    """Return an advance of orbits that fails in its revolution of this number."""
    advance, done = Orbit.advance, []

    def advanced(orbit, **how):
        done.append(None)
        if len(done) > count:
            raise NoMotion("no motion in the long run: a step is too short")
        return advance(orbit, **how)

    return advanced


@pytest.mark.parametrize("reached", [0, 5])
def test_a_motion_that_stops_leaves_what_it_reached(tmp_path, monkeypatch, capsys, reached):
    """Four orbits: of 5 revolutions too few are in the section, of more there are some."""
    monkeypatch.setattr(Orbit, "advance", stops_after(5 * reached))
    scene, out = tmp_path / "film.toml", tmp_path / "out"
    FILM.replace({"solver.tolerance": 1e-1}).save(scene)
    given = ["attractor", str(scene), "--revolutions", "20", "--skip", "2", "--longest", "4"]
    given += ["--quantity", "joints.crank_pin.peak_force"]
    assert main([*given, "--no-pictures", "--out", str(out)]) == 3
    assert "a step is too short" in capsys.readouterr().err
    assert out.exists() == bool(reached)
    if reached:
        told = json.loads((out / "attractor.json").read_text())
        assert 3 <= told["revolutions"] < 20 and "a step is too short" in told["stopped"]
        assert told["lyapunov_exponent"]["high"] is None
        assert list(told["figures"]) == ["joints.crank_pin.peak_force"]


def test_an_interval_that_has_not_aligned_holds_the_exponent_that_it_tends_to():
    """Two contractions, by 0.3 and 0.238 a revolution; a neighbour begins in the faster one."""
    turn = np.arange(1, 41)
    growths = [
        np.diff(np.log(np.hypot(np.exp(-0.30 * turn), part * np.exp(-0.238 * turn))))
        for part in (0.02, 0.5)
    ]
    found = combine_exponents(growths, (1e-2, 1e-3), 1e-9, (0.0, 0.0))
    assert found.low < -0.3 and found.high > -0.245
