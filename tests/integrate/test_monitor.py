"""Exudyn's calls reach the user's own functions, whose word counts."""

import exudyn as exu

from exu_press import SolverStatus, solve_dynamic
from exudyn_examples import EXAMPLES

EXAMPLE = EXAMPLES["IFToMM pendulum"]


def system():
    mbs = exu.SystemContainer().AddSystem()
    EXAMPLE.build(mbs)
    mbs.Assemble()
    return mbs


def test_all_of_the_users_functions_are_called_and_stay():
    mbs, calls = system(), {"step": 0, "residual": 0, "newton": 0, "end": 0}

    def called(name, answer):
        def function(mbs, *state):
            calls[name] += 1
            return answer

        return function

    mbs.SetPreStepUserFunction(called("step", True))
    mbs.SetPreNewtonResidualUserFunction(called("residual", None))
    mbs.SetPostNewtonUserFunction(called("newton", [0.0, -1.0]))
    mbs.SetPostStepUserFunction(called("end", True))
    functions = mbs.GetPreStepUserFunction(), mbs.GetPostNewtonUserFunction()
    outcome = solve_dynamic(mbs, EXAMPLE.settings(0.5), sample=0.0)
    tries = outcome.steps + outcome.rejected_steps
    assert calls["newton"] == tries
    assert calls["step"] == 1 + tries  # at the start it is seen whether it moves constraints
    assert calls["residual"] >= outcome.newton_iterations
    assert calls["end"] == outcome.steps + 1  # at the start too, as Exudyn does
    assert (mbs.GetPreStepUserFunction(), mbs.GetPostNewtonUserFunction()) == functions


def test_a_step_that_the_user_wants_shorter_is_repeated():
    mbs, tried = system(), []

    def at_most(mbs, time):
        step = time - mbs.systemData.GetTime(exu.ConfigurationType.StartOfStep)
        tried.append(step)
        return [2.0, 1e-3] if step > 1.01e-3 else [0.0, -1.0]

    mbs.SetPostNewtonUserFunction(at_most)
    outcome = solve_dynamic(mbs, EXAMPLE.settings(0.1))
    assert outcome.status is SolverStatus.COMPLETED
    assert outcome.rejected_steps == sum(step > 1.01e-3 for step in tried) > 0
    assert outcome.steps >= 100


def test_without_them_fewer_steps_are_taken():
    assert solve_dynamic(system(), EXAMPLE.settings(0.1)).steps < 50


def test_a_function_that_asks_to_stop_before_a_step_ends_the_run():
    mbs = system()
    mbs.SetPreStepUserFunction(lambda mbs, time: time < 0.05)
    outcome = solve_dynamic(mbs, EXAMPLE.settings(0.1))
    assert outcome.status is SolverStatus.INTERRUPTED
    assert outcome.reason.startswith("stopped by a user function at t = 0.0")
