"""Which method a system takes, and what is refused."""

import exudyn as exu
import pytest
from exudyn.itemInterface import ObjectGround
from exudyn_systems.models import settings
from stand_in_system import oscillator, planar_body

from exu_press import InputError, SolverStatus, add_dry_revolute, solve_dynamic
from exu_press.exudyn_systems.solve import RefinedOutcome
from exu_press.laws.contact import hertz, hunt_crossley
from exu_press.laws.friction import no_friction


def pendulum_with_clearance():
    """Return a bar on a dry pin, at rest in its bearing's middle."""
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.AddObject(ObjectGround())
    body, _ = planar_body(mbs, 1.0, 0.1, [0.5, 0.0, 0.0])
    add_dry_revolute(
        mbs,
        (ground, (0.0, 0.0)),
        (body, (-0.5, 0.0)),
        radius=0.01,
        clearance=1e-4,
        contact=hunt_crossley(hertz(1e9), 0.7),
        friction=no_friction(),
    )
    mbs.Assemble()
    return mbs


def test_every_system_without_clearance_is_refined_unless_the_choice_is_overruled():
    outcome = solve_dynamic(pendulum_with_clearance(), settings(0.01, 100))
    assert outcome.status is SolverStatus.COMPLETED
    assert not isinstance(outcome, RefinedOutcome)
    assert isinstance(solve_dynamic(oscillator()[0], settings(1.0, 100)), RefinedOutcome)
    adaptive = solve_dynamic(oscillator()[0], settings(1.0, 100), method="adaptive", sample=0.5)
    assert not isinstance(adaptive, RefinedOutcome)
    refined = solve_dynamic(pendulum_with_clearance(), settings(1e-3, 1000), method="refine")
    assert isinstance(refined, RefinedOutcome)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tolerance": None}, r"tolerance = None: .* mbs\.SolveDynamic has fixed"),
        ({"tolerance": 1.0}, r"tolerance = 1\.0: allowed is a number from 1e-08 to 0\.1"),
        ({"tolerance": "fine"}, "tolerance = 'fine'"),
        ({"method": "best"}, "method = 'best': allowed are"),
        ({"sample": 0.01}, "sample: allowed with error-controlled steps"),
        ({"method": "adaptive", "max_time": 1.0}, "max_time: allowed with refinement"),
    ],
)
def test_wrong_options_are_refused(options, message):
    with pytest.raises(InputError, match=message):
        solve_dynamic(oscillator()[0], settings(1.0, 100), **options)


def test_explicit_solvers_stay_with_exudyn():
    solver = "RK44"
    chosen = settings(1.0, 100)
    chosen.timeIntegration.solverType = getattr(exu.DynamicSolverType, solver)
    with pytest.raises(InputError, match=rf"solverType = {solver}: .* stay with mbs.SolveDynamic"):
        solve_dynamic(oscillator()[0], chosen)


def test_what_is_no_system_or_no_run_is_refused():
    mbs = exu.SystemContainer().AddSystem()
    mbs.AddObject(ObjectGround())
    with pytest.raises(InputError, match="mbs is not assembled"):
        solve_dynamic(mbs, settings(1.0, 100))
    with pytest.raises(InputError, match=r"endTime = 0\.0: allowed is a time after"):
        solve_dynamic(oscillator()[0], settings(0.0, 100))
    chosen = settings(1.0, 100)
    chosen.solution.restart.continueIfAvailable = True
    with pytest.raises(InputError, match="continueIfAvailable"):
        solve_dynamic(oscillator()[0], chosen)
