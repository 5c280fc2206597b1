"""A scene pushed to its extremes, the verdicts, the report and the map."""

import dataclasses
from dataclasses import replace

import numpy as np
import pytest

from exu_press import Scene, simulate
from exu_press.integrate.resolution import ImpactResolution
from exu_press.mechanism.press import PAPER_LAWS
from exu_press.studies.stability import (
    Row,
    StabilityReport,
    StabilityStudy,
    extremes,
    stability,
)
from exu_press.studies.stability import judge as judging
from exu_press.studies.stability.cases import PAIRS
from exu_press.studies.stability.checks import agreement, checks_of
from exu_press.studies.stability.judge import finer, judge
from exu_press.verification.run import with_errors

SHORT = {"mechanism": "slider_crank", "revolutions": 0.04, "start": "centred"}
DRY = {"joints.crank_pin": "dry", "contact": PAPER_LAWS["contact"]}


def judged(**changes):
    scene = Scene.from_dict(SHORT).replace(changes)
    return judge({"name": "a case", "scene": scene.to_dict()})


def test_a_run_that_was_not_resolved_has_stopped_and_without_a_word_would_be_wrong(monkeypatch):
    """The checks, not the status, find it: the verdict does not rest on the run's own word."""
    row = judged(**DRY, **{"solver.step": 1e-3})
    assert (row["verdict"], row["status"]) == ("stopped", "under-resolved")
    assert "solver.step" in row["reason"]
    monkeypatch.setattr(ImpactResolution, "worst", lambda resolution: None)
    row = judged(**DRY, **{"solver.step": 1e-3})
    assert row["status"] == "completed"
    assert row["verdict"] == "wrong"
    assert "difference from a finer run" in row["reason"] or "energy" in row["reason"]


def test_a_finer_run_that_stops_leaves_a_case_unchecked_which_is_wrong(monkeypatch):
    monkeypatch.setattr(
        judging, "finer", lambda scene: finer(scene).replace({"solver.max_steps": 5})
    )
    row = judged()
    assert row["verdict"] == "wrong"
    assert row["reason"].startswith("the finer run: 5 steps were used up")


@pytest.fixture(scope="module")
def run():
    return simulate(Scene.from_dict(SHORT).replace(DRY))


@pytest.fixture(scope="module")
def told(run):
    """The run with its errors."""
    return with_errors(run, beside=False)


def changed(result, **values):
    return result.with_values(values)


def failed(result):
    return [check.name for check in checks_of(result) if not check.is_within_limit]


def test_each_check_can_fail(run):
    assert failed(run) == []
    given, lost = run["energy_input"], run["energy_dissipated"]
    scale = np.abs(given).max()
    rising = np.linspace(0.0, 1.0, len(given))
    off = changed(run, energy_stored=run["energy_stored"] + 2e-3 * scale * rising)
    assert failed(off) == ["energy residual"]
    made = changed(
        run,
        energy_dissipated=lost - 0.1 * scale * rising,
        energy_stored=run["energy_stored"] + 0.1 * scale * rising,
    )
    assert failed(made) == ["energy created in joints"]
    open_joint = run["body_position"].copy()
    open_joint[-1, run.bodies.index("slider"), 0] += 2e-9
    assert failed(changed(run, body_position=open_joint)) == ["constraint drift, m"]
    deep = run["crank_pin_eccentricity"].copy()
    deep[-1] = [0.0, -2e-3]
    assert failed(changed(run, crank_pin_eccentricity=deep)) == ["contact energy out of nothing"]


@pytest.mark.parametrize(
    ("channel", "factor", "named"),
    [
        ("slider_acceleration", 1.2, "peak_acceleration.resolved"),
        ("slider_velocity", 1.05, "peak_"),
        ("crank_pin_force", 1.2, "joints.crank_pin.peak_force"),
        ("energy_dissipated", 1.2, "energy.dissipated"),
    ],
)
def test_agreement_sees_a_difference_that_is_not_stated(run, told, channel, factor, named):
    assert agreement(told, run).value == 0.0
    check = agreement(changed(told, **{channel: factor * run[channel]}), run)
    assert not check.is_within_limit
    assert check.note.startswith(named)


def test_a_difference_that_is_stated_is_right(run, told):
    """Bounds of a figure that is not determined hold 19 in 20 runs: 1.5 times as far is allowed."""
    value = told.quantity("stroke").value
    off = changed(run, slider_position=1.1 * run["slider_position"])
    for half, determined, right in (
        (0.2 * value, True, True),
        (0.07 * value, True, False),
        (0.08 * value, False, True),
        (0.03 * value, False, False),
    ):
        entry = {
            "error": half, "determined": determined, "low": value - half, "high": value + half
        }  # fmt: skip
        said = dataclasses.replace(told, info={**told.info, "errors": {"stroke": entry}})
        assert agreement(said, off).is_within_limit is right
    finer = dataclasses.replace(off, info={**off.info, "errors": said.info["errors"]})
    assert agreement(said, finer).value == pytest.approx(0.1 / (1.5 * 0.03 + 0.03), rel=1e-2)


def test_every_number_that_a_scene_uses_is_pushed_both_ways():
    scene = Scene.from_dict({**SHORT, "film": {"law": "pinkus", "viscosity": 0.3}})
    table = extremes(scene, "mine")
    assert len({case.name for case in table}) == len(table)
    assert table[0].scene.replace({"solver.max_steps": scene.solver.max_steps}) == scene
    reached = [case.scene.film["viscosity"] for case in table if case.axis == "film.viscosity"]
    assert min(reached) == pytest.approx(3e-4) and max(reached) == pytest.approx(300.0)
    assert all(case.scene.to_dict() != table[0].scene.to_dict() for case in table[1:])
    tolerances = [case.scene.solver.tolerance for case in table if case.axis == "solver.tolerance"]
    assert max(tolerances) <= 0.1, "more is refused"
    keys = {case.axis for case in table}
    assert {"speed_rpm", "film.length", "joints.crank_pin.clearance", "solver.tolerance"} <= keys
    assert not any(key.startswith(("slider_crank.", "gravity", "revolutions")) for key in keys)


def test_rows_are_kept_and_not_run_again(tmp_path):
    class Few(StabilityStudy):
        @property
        def cases(self):
            table = extremes(self.scene, "mine")
            return [table[0], next(case for case in table if case.axis == "film.viscosity")]

    study = Few(Scene.from_dict(SHORT))
    first = stability(study, tmp_path, workers=1)
    assert sum(first.counts().values()) == 2
    assert [row.name for row in first.rows] == [case.name for case in study.cases]
    lines = (tmp_path / "runs.jsonl").read_text()
    assert stability(study, tmp_path, workers=1) == first
    assert (tmp_path / "runs.jsonl").read_text() == lines


def test_a_worker_that_fails_gives_a_wrong_case_and_the_map_shows_all(tmp_path):
    scene = Scene.from_dict(SHORT)
    table = extremes(scene, "mine")
    pair = replace(table[1], axis=PAIRS, value="one + other", name="one + other, mine")
    verdicts = ["right", "stopped", "wrong"]
    rows = tuple(
        Row(
            case.name, case.axis, case.value, case.scene.to_dict(), verdicts[i], "completed",
            reason="why" * bool(i), residual=None if i else 1e-5, wall_time=1.0,
        )
        for case, i in zip([*table, pair], [0, 1, 2, *[0] * 999], strict=False)
    )  # fmt: skip
    report = StabilityReport(scene, True, rows)
    assert report.counts() == {"right": len(rows) - 2, "stopped": 1, "wrong": 1}
    assert f"wrong: {rows[2].name}" in report.lines()
    assert report.lines()[-1].endswith(f"{1 / len(rows):.1%} others), 1 wrong")
    assert report.exit_status == 1
    figure = report.pictures()[0].draw(report)
    assert len(figure.axes[0].collections) == len(rows) - 1
