"""Steps follow a tolerance or keep to a grid; those that do not resolve impacts say so."""

import json
import math
import re
from types import SimpleNamespace

import exudyn as exu
import exudyn.utilities as items
import numpy as np
import pytest
from patched import PATCHED

from exu_press import Result, Scene, SolverStatus, simulate, solve_dynamic
from exu_press.cli import main
from exu_press.integrate.settings import SolverTuning
from exu_press.integrate.stepping import FixedSteps, StepControl
from exu_press.mechanism.press import PAPER_LAWS

DRY = {
    "mechanism": "slider_crank",
    "joints": {"crank_pin": "dry"},
    "revolutions": 0.1,
    "start": "centred",
    "contact": PAPER_LAWS["contact"],
    "friction": PAPER_LAWS["friction"],
}
REASON = re.compile(
    r"under-resolved at t = (\S+) s, crank angle (\S+) deg: (\d+)% of the largest inertia force "
    r"\((slider|rod)\) within a step of (\S+) s; peaks are the step's; "
    r"try solver\.(step|tolerance) = (\S+)"
)


def run(**changes):
    return simulate(Scene.from_dict(DRY).replace(changes))


def peak(result):
    return np.abs(result["slider_acceleration"]).max()


@pytest.fixture(scope="module")
def reference():
    return run(**{"solver.tolerance": 1e-5})


@pytest.mark.parametrize("step", [pytest.param(1e-3, marks=pytest.mark.long), 2e-4])
def test_a_step_that_leaps_over_impacts_names_one_that_does_not(step, reference):
    coarse = run(**{"solver.step": step})
    assert coarse.completed, "it reached its end"
    assert coarse.info["status"] == "under-resolved"
    match = REASON.fullmatch(coarse.info["reason"])
    assert match, coarse.info["reason"]
    assert peak(coarse) < 0.6 * peak(reference), "and its peak is the step's"
    assert match[6] == "step"
    fine = run(**{"solver.step": float(match[7])})
    assert fine.info["status"] == "completed", fine.info["reason"]
    assert peak(fine) == pytest.approx(peak(reference), rel=0.03)


@pytest.mark.parametrize(
    "changes",
    [
        {"solver.tolerance": 1e-3},
        {"solver.step": 2e-5},
        {"solver.step": 1e-3, "contact.damping_max": 0.0},  # soft: the impact lasts many steps
        {"solver.step": 1e-3, "joints": {}},
    ],
    ids=str,
)
def test_resolved_runs_are_completed(changes):
    assert run(**changes).info["status"] == "completed"


def test_an_impact_on_the_frame_says_which_step_resolves_it():
    coarse = run(**{"joints": {"shaft": "dry"}, "solver.step": 1e-3})
    assert coarse.info["status"] == "under-resolved"
    assert re.search(r"try solver\.step = \d", coarse.info["reason"])


@pytest.mark.parametrize("changes", [{}, {"film.viscosity": 1.0}], ids=str)
def test_a_film_that_starts_from_rest_is_no_impact(changes):
    """Its accelerations ring for some steps."""
    result = run(**{"joints": {"crank_pin": "lubricated"}, "solver.step": 1e-4, **changes})
    assert result.info["status"] == "completed", result.info["reason"]


@pytest.mark.parametrize("rise", [1e-4, 1e-5])
def test_a_pulse_shorter_than_the_step_is_not_resolved_either(rise):
    load = {
        "load.blanking.kind": "blanking",
        "load.blanking.force": 1e6,
        "load.blanking.rise": rise,
        "load.blanking.fall": 2.0 * rise,
    }
    changes = {"joints": {}, "load.blanking.end_angle_deg": 20.0, **load}
    leapt = run(**changes, **{"solver.step": 1e-3})
    assert leapt.info["status"] == "under-resolved"
    assert leapt["load_blanking_force"].max() < 0.9e6, "the pulse's peak was missed"
    advice = re.search(r"load\.blanking .* try solver\.step = (\S+)", leapt.info["reason"])
    fine = run(**changes, **{"solver.step": float(advice[1])})
    assert fine.info["status"] == "completed"
    assert fine["load_blanking_force"].max() > 0.9e6
    assert run(**changes).info["status"] == "completed", "a tolerance steps on its corners"


def test_the_command_exits_with_3_and_does_not_speak_of_a_stop(tmp_path, capsys):
    out = tmp_path / "out"
    arguments = [
        "--set",
        "joints.crank_pin=dry",
        "--set",
        "revolutions=0.05",
        "--set",
        "solver.step=1e-3",
        "--set",
        "start=centred",
    ]
    assert (
        main(["run", "slider_crank", *arguments, "--no-pictures", "--no-error", "--out", str(out)])
        == 3
    )
    error = capsys.readouterr().err
    assert "\nexu-press: under-resolved at t = " in f"\n{error}"
    summary = json.loads((out / "summary.json").read_text())
    assert summary["status"] == "under-resolved"
    assert Result.load(out / "run.nc").completed


def task(**changes):
    usual = {"largest": 1e-3, "smallest": 1e-9, "first": 1e-3, "start": 0.0, "end": 1.0}
    usual["no_shorter"] = 1.001e-9
    return SimpleNamespace(**{**usual, "impacts": True, "tuning": SolverTuning(), **changes})


def test_fixed_steps_return_to_their_grid_after_a_halved_one():
    control, times = FixedSteps(task()), [0.0]
    for i in range(20):
        step = control.next_step(times[-1]) * (0.25 if i == 5 else 1.0)
        control.accept(step)
        times.append(times[-1] + step)
    off_grid = [abs(time / 1e-3 - round(time / 1e-3)) > 1e-9 for time in times]
    assert [i for i, off in enumerate(off_grid) if off] == [6, 7]
    assert np.diff(times)[-12:] == pytest.approx(1e-3)


class Estimate:
    """Errors that go with the cube of the step; 1 at a step (s)."""

    def __init__(self, good):
        self.good = good

    def __call__(self, step):
        return (step / self.good) ** 3

    def accept(self, shortened):
        pass

    def change_of_speed(self):
        return 0.0


class Jump(Estimate):
    """Of a jump that lies in every step, and is too much for the smallest one."""

    def __init__(self, change):
        self.change, self.step = change, 0.0

    def __call__(self, step):
        self.step = step
        return 1e3

    def of_jump(self, step):
        return 1e2

    def change_of_speed(self):
        return self.change(self.step)


@PATCHED
@pytest.mark.parametrize(
    ("change", "accepted"), [(lambda h: 1e6 * h, True), (lambda h: 0.1, False)]
)
def test_the_smallest_step_is_good_enough_for_a_force_that_jumps(change, accepted):
    """It changes speeds with the step; what changes them by as much in any step is a blow."""
    control = StepControl(task(), Jump(change), lambda time: math.inf, lambda time: math.inf)
    step, tries = control.next_step(0.0), 0
    while step > 1e-9 and (shorter := control.shorter(step)):
        step, tries = max(shorter, 1e-9), tries + 1
    assert tries > 3
    assert control.shorter(1e-9) > 0.0
    assert control.of_force is accepted
    control.accept(1e-3)  # beyond the steps that failed
    assert control.shorter(1e-9) > 0.0
    assert not control.of_force, "theirs was another jump"


def steps(good, corner=math.inf, period=math.inf, **changes):
    """Sizes of accepted steps to the end, and the number of repeated ones."""
    asked = task(**changes)

    def sample(time):
        return period if time < period else (round(time / period) + 1) * period

    control = StepControl(
        asked, Estimate(good), lambda time: corner if time < corner else math.inf, sample
    )
    time, sizes, repeated = 0.0, [], 0
    while asked.end - time > 1e-12:
        step = control.next_step(time)
        while shorter := control.shorter(step):
            step, repeated = shorter, repeated + 1
        control.accept(step)
        sizes.append(step)
        time += step
    return sizes, repeated


@PATCHED
def test_steps_grow_slowly_to_what_their_errors_allow():
    sizes, repeated = steps(good=1e-3, first=1e-5, end=0.1)
    growth = np.array(sizes[1:-2]) / sizes[:-3]
    assert growth.max() == pytest.approx(SolverTuning().factor_max)
    aim = SolverTuning().safety ** (1.0 / 3.0) * 1e-3
    assert aim / SolverTuning().factor_max <= sizes[-5] <= aim
    assert repeated == 0


@PATCHED
def test_first_steps_without_impacts_grow_until_an_error_limits_one():
    sizes, repeated = steps(good=1e-3, first=5e-6, end=0.1, impacts=False)
    tuning = SolverTuning()
    growth = np.array(sizes[1:-2]) / sizes[:-3]
    aim = tuning.safety ** (1.0 / 3.0) * 1e-3
    assert growth[:4] == pytest.approx(tuning.factor_max_at_start)
    assert growth[4:].max() < tuning.factor_max_at_start
    assert sizes[6:-2] == pytest.approx([aim] * len(sizes[6:-2]), rel=1e-6) and repeated == 0


@PATCHED
def test_a_step_that_is_too_long_is_repeated_once():
    sizes, repeated = steps(good=2e-4, end=0.01)
    assert repeated == 1
    assert sizes[0] == pytest.approx(2e-4 * SolverTuning().safety ** (1.0 / 3.0))


@PATCHED
def test_steps_end_on_corners_and_the_end():
    sizes, _ = steps(good=1.0, corner=2.3e-3, end=5.1e-3)
    times = np.cumsum(sizes)
    assert np.abs(times - 2.3e-3).min() < 1e-15 and times[-1] == pytest.approx(5.1e-3)
    assert min(sizes) > 0.5e-3, "nothing little is left before one"


@PATCHED
def test_steps_between_samples_are_of_one_size():
    sizes, _ = steps(good=3.1e-4, period=1e-3, end=0.1)
    late = np.array(sizes[-40:-10])
    assert late == pytest.approx([late[0]] * len(late), rel=1e-9)
    assert 1e-3 / late[0] == pytest.approx(round(1e-3 / late[0]), rel=1e-9)


@PATCHED
@pytest.mark.parametrize("apart", [0.0, 1e-16, 5e-13, 8e-10])
@pytest.mark.parametrize("number", range(1, 40, 6))
def test_a_corner_at_the_end_of_a_block_cuts_no_step_to_pieces(number, apart):
    """Both are multiples of a revolution, worked out differently: rounding tells them apart."""
    end = 0.1 * number / 7.0
    for corner in (end * (1.0 - apart), end * (1.0 + apart)):
        sizes, _ = steps(good=3e-4, first=1e-4, corner=corner, end=end)
        assert sum(sizes) == pytest.approx(end, rel=1e-14)
        assert min(sizes) > 0.9e-4


@PATCHED
def test_a_corner_shortly_before_the_end_costs_one_step():
    sizes, _ = steps(good=1.0, corner=4.5e-3, end=5.0e-3)
    assert sizes[-1] == pytest.approx(0.5e-3)
    assert len(sizes) == 6 and min(sizes[:-1]) > 0.7e-3


def test_a_load_that_jumps_late_in_a_run_is_passed():
    """The smallest step, 1e-8 s, is told as a difference of times with an error of 1e-5 of it."""
    mbs = exu.SystemContainer().AddSystem()
    still = mbs.AddNode(items.NodePointGround())
    node = mbs.AddNode(items.Node1D(referenceCoordinates=[0.0]))
    mbs.AddObject(items.ObjectMass1D(nodeNumber=node, mass=1.0))
    ends = [
        mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=number, coordinate=0))
        for number in (still, node)
    ]
    mbs.AddObject(items.ObjectConnectorCoordinateSpringDamper(markerNumbers=ends, stiffness=100.0))
    mbs.AddLoad(
        items.LoadCoordinate(
            markerNumber=ends[1],
            load=0.0,
            loadUserFunction=lambda mbs, time, load: 1.0 if time < 600.123 else -1e3,
        )
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.startTime, settings.timeIntegration.endTime = 600.0, 601.0
    settings.solution.file.write = False
    outcome = solve_dynamic(mbs, settings, tolerance=1e-3)
    assert outcome.status is SolverStatus.COMPLETED, outcome.reason
