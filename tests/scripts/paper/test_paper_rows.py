"""Verdicts."""

import pytest

from paper.published import published
from paper.rows import frequency_rows, number_rows, trend_rows
from paper.sensitivity import tornado_of
from paper.settings import AS_THEY_ARE, Setting


def run(acceleration=20.0, low=0.4699):
    models = ("resolved", "mean_1ms", "differentiated_1khz")
    return {
        "status": "completed",
        "reason": "",
        "readings": {
            "peak_acceleration": {"resolved": 500.0, "mean_1ms": acceleration,
                                  "differentiated_1khz": 1.0},
            "bottom_dead_centre": dict.fromkeys(models, low),
            "peak_velocity": dict.fromkeys(models, 0.4),
        },
    }  # fmt: skip


def number(name):
    return next(n for n in published().numbers if n.name == name)


def trend(name):
    return next(t for t in published().trends if t.name == name)


@pytest.mark.parametrize(
    ("acceleration", "verdict"),
    [(29.4, "agrees"), (36.7, "agrees"), (36.8, "differs"), (22.1, "agrees"), (22.0, "differs")],
)
def test_agreement_is_within_a_quarter_under_the_mean_over_1_ms(acceleration, verdict):
    one = number("acceleration_lubricated")
    (row,) = number_rows([one], {one.run: run(acceleration)}, {})
    assert row.verdict == verdict
    assert row.ratio == pytest.approx(acceleration / 29.4)
    assert (row.published, row.resolved, row.mean_1ms) == (29.4, 500.0, acceleration)


def test_bottom_dead_centres_are_judged_by_how_far_they_lie_below_the_ideal():
    one = number("bottom_dead_centre_lubricated")
    (row,) = number_rows([one], {one.run: run(low=0.4699)}, {})
    assert row.mean_1ms == 0.4699 and row.ratio == pytest.approx(1e-4 / 4e-3)
    assert row.verdict == "differs"
    (row,) = number_rows([one], {one.run: run(low=0.4659)}, {})
    assert row.verdict == "agrees"


def test_the_reason_names_what_moves_it_and_what_would_meet_the_paper():
    one = number("acceleration_lubricated")
    varied = [
        (Setting("viscosity", "1 Pa s"), run(19.0)),
        (Setting("ball", "twice"), run(28.0)),
        (Setting("nothing", "much"), run(20.0)),
    ]
    tornado = tornado_of(one, "rigid", run(20.0), varied)
    (row,) = number_rows([one], {one.run: run(20.0)}, {one.name: tornado})
    assert "met with ball = twice: 28" in row.reason
    assert (
        "ball (twice +40 %), viscosity (1 Pa s -5 %)" in row.reason and "nothing" not in row.reason
    )


def test_the_reason_says_so_where_rigid_bodies_meet_the_paper():
    one = number("acceleration_200um")
    tornado = tornado_of(one, "rigid", run(86.0), [(Setting("ball", "twice"), run(105.0))])
    (row,) = number_rows([one], {one.run: run(47.0)}, {one.name: tornado})
    assert row.verdict == "differs"
    assert row.reason.startswith("rigid bodies meet the paper's as they are")


def test_bottom_dead_centres_are_explained_in_micrometres():
    one = number("bottom_dead_centre_lubricated")
    varied = [(Setting("datum", "0.466 m"), run(low=0.46598)), (Setting("oil", "thin"), run())]
    tornado = tornado_of(one, "rigid", run(low=0.46998), varied)
    (row,) = number_rows([one], {one.run: run(low=0.46998)}, {one.name: tornado})
    assert "met with datum = 0.466 m: 4020.0 µm" in row.reason
    assert "oil (thin: 100.0 µm)" in row.reason


def test_a_run_that_stopped_early_has_no_verdict_of_agreement():
    one = number("acceleration_lubricated")
    stopped = {"status": "time limit", "reason": "over 900 s", "readings": None}
    (row,) = number_rows([one], {one.run: stopped}, {})
    assert (row.verdict, row.reason, row.mean_1ms) == ("no run", "over 900 s", None)


def test_trends():
    one = trend("acceleration_over_clearance")
    rising = {name: run(20.0 + 5.0 * i) for i, name in enumerate(one.runs)}
    (row,) = trend_rows([one], rising, {})
    assert row.verdict == "trend" and row.mean_1ms == (20.0, 25.0, 30.0, 35.0)
    flat = {name: run(20.0) for name in one.runs}
    settings = {one.name: {"a = 1": [20.0, 20.0, 20.0, 20.0], "b = 2": [1.0, 2.0, 3.0, 4.0]}}
    (row,) = trend_rows([one], flat, settings)
    assert row.verdict == "differs"
    assert "appears under 1 of 2 changes" in row.reason and "b = 2" in row.reason
    settings[one.name][AS_THEY_ARE] = [1.0, 2.0, 3.0, 4.0]
    (row,) = trend_rows([one], flat, settings)
    assert row.reason.endswith("with rigid bodies it appears")


def test_trends_of_bottom_dead_centres_are_of_how_far_they_lie_below():
    one = trend("bottom_dead_centre_over_speed")
    lower = {name: run(low=0.4699 - 1e-4 * i) for i, name in enumerate(one.runs)}
    (row,) = trend_rows([one], lower, {})
    assert row.verdict == "trend"


def test_frequencies():
    hz = [100.0 * mode for mode in range(1, 21)]
    rows = frequency_rows({"crank": {"hz": hz, "reason": ""}})
    assert len(rows) == 5
    assert rows[0].resolved == 200.0 and rows[0].ratio == pytest.approx(200.0 / 538.192)
    assert rows[0].verdict == "differs"


def test_frequencies_of_a_part_that_could_not_be_computed():
    rows = frequency_rows({"crank": {"status": "worker died", "reason": "killed by SIGKILL"}})
    assert [row.verdict for row in rows] == ["no run"] * 5
    assert rows[0].resolved is None and rows[0].reason == "killed by SIGKILL"
