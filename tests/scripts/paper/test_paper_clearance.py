"""The clearance of least cost, where it is known."""

import pytest

from exu_press import Scene
from paper.clearance import Point, choose, clearances_of, point_of, scenes_of

SIZES = (1e-5, 2.5e-5, 5e-5, 1e-4, 1.5e-4, 2e-4, 3e-4, 4e-4)


def point(pin, balls, acceleration, power):
    models = ("resolved", "mean_1ms", "differentiated_1khz")
    return Point(
        pin=pin,
        balls=balls,
        acceleration=dict.fromkeys(models, acceleration),
        force=1.0,
        eccentricity_ratio=0.1,
        deviation=balls,
        scatter=None,
        losses={"pin": power},
    )


def test_the_least_of_a_known_cost():
    """Power b / c + k c times acceleration c^1/2 is least at c^2 = b / (3 k)."""
    best = 1.2e-4
    alike = [point(c, c, c**0.5, best**2 * 3.0 / c + c) for c in SIZES]
    choice = choose(Scene(), alike, alike)
    assert choice.best[1.0] == pytest.approx(best, rel=0.03)
    assert choice.best[2.0] < choice.best[1.0] < choice.best[0.5]  # less acceleration: narrower


def test_a_cost_that_only_falls_is_least_at_the_end():
    alike = [point(c, c, 1.0, 1.0 / c) for c in SIZES]
    assert choose(Scene(), alike, ()).best[1.0] == SIZES[-1]


def test_pin_and_balls_apart():
    separate = [point(p, b, b**0.5, 1.0 / p) for p in (1e-5, 1e-4) for b in (1e-5, 1e-4)]
    choice = choose(Scene(), [], separate)
    assert choice.best_separate[1.0] == (1e-4, 1e-5)
    assert choice.best[1.0] is None
    assert choice.to_dict()["best_separate"][1] == {"weight": 1.0, "pin": 1e-4, "balls": 1e-5}


def test_scenes_and_a_run_that_stopped():
    alike, separate = scenes_of(Scene(), (1e-5, 1e-4), (1e-5, 1e-4), 4.0)
    assert [s.joints["ball_left"].clearance for s in alike] == [1e-5, 1e-4]
    pairs = {clearances_of(s) for s in separate}
    assert len(pairs) == 4 and {s.revolutions for s in separate} == {4.0}
    assert point_of(alike[0], {"status": "failed", "readings": None}) is None
