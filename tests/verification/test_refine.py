"""A run goes on at a finer tolerance where that is needed, and as long as it is worth it."""

import time
from dataclasses import replace

import pytest

from exu_press import Scene, simulate
from exu_press.verification import refine

SCENE = Scene(mechanism="slider_crank", joints={}, revolutions=0.02)


@pytest.fixture(scope="module")
def bare():
    return simulate(SCENE)


def stated(result, part):
    """Return a run whose stroke is known to a part of it."""
    stroke = result.quantity("stroke").value
    error = {"error": part * stroke, "determined": True, "low": 0.0, "high": 2.0 * stroke}
    return replace(result, info={**result.info, "errors": {"stroke": error}})


def fake(monkeypatch, bare, part, seconds=0.0):
    """Let runs take some time and be off by a part at a tolerance; return the tolerances asked."""
    asked = []

    def run(scene, **_):
        asked.append(scene.solver.tolerance)
        time.sleep(seconds)
        return replace(stated(bare, part(scene.solver.tolerance)), scene=scene)

    monkeypatch.setattr(refine, "simulate_with_errors", run)
    return asked


def test_doubtful_is_what_is_off_by_more_than_a_twentieth_or_not_determined(bare):
    assert refine.doubtful(stated(bare, 0.04)) == []
    assert refine.doubtful(stated(bare, 0.06)) == ["stroke"]
    open_ = stated(bare, 0.0)
    open_.info["errors"]["stroke"]["determined"] = False
    assert refine.doubtful(open_) == ["stroke"]


def test_it_goes_on_until_it_is_known(bare, monkeypatch):
    asked, said = fake(monkeypatch, bare, lambda tolerance: 100.0 * tolerance, 0.2), []
    result = refine.refined(SCENE, told=said.append)
    assert asked == [1e-3, 2.5e-4]
    assert result.scene.solver.tolerance == 2.5e-4
    assert "stroke" in said[0] and len(said) == 1


def test_it_ends_when_the_time_is_spent_and_says_what_is_left(bare, monkeypatch):
    asked, said = fake(monkeypatch, bare, lambda tolerance: 1.0, seconds=0.2), []
    refine.refined(SCENE, told=said.append)
    assert 2 <= len(asked) <= 4
    assert "--set solver.tolerance=" in said[-1] and " s," in said[-1]


def test_a_run_that_is_known_is_run_once(bare, monkeypatch):
    asked = fake(monkeypatch, bare, lambda tolerance: 0.0)
    refine.refined(SCENE, told=pytest.fail)
    assert len(asked) == 1
