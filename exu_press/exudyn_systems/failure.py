"""Messages that say why a refinement did not converge."""

import itertools
import math

import numpy as np

from exu_press.exudyn_systems.difference import STEPS_IN_PERIOD, common
from exu_press.exudyn_systems.refine import Refinement
from exu_press.numerics.arrays import Array
from exu_press.numerics.convergence import ORDER, PLAUSIBLE
from exu_press.verification.growth import growth

__all__ = ["agreed_until", "why_not_converged"]

SMALL = 1e-4  # relative difference from which on growth is judged
APART = 0.1  # relative difference from which on motions are as far apart as they get
LEVELS = "three levels whose order is plausible"
A_DAY = 86400.0  # s; a budget that takes longer is no cure
GROWN = 1e3  # growth of differences in a run from which on the motion amplifies them


def agreed_until(refinement: Refinement) -> float:
    """Return the time up to which the last two levels agree within the tolerance, s."""
    times, apart = _distance(refinement)
    above = np.flatnonzero(apart > refinement.tolerance)
    return float(times[max(above[0] - 1, 0)] if len(above) else times[-1])


def _distance(refinement: Refinement) -> tuple[Array, Array]:
    """Return instants, s, and the largest difference of the last two levels there."""
    coarser, finer = refinement.levels[-2:]
    times = coarser.samples.times[common(coarser.samples, finer.samples)[0]]
    return times, refinement.differences(coarser, finer).max(axis=1)


def why_not_converged(refinement: Refinement) -> str:
    """Return what was reached, which quantity differs most, why, and what would do."""
    levels, failures = refinement.levels, refinement.newton_failures()
    if refinement.solver_gives_up() or (len(levels) < 2 and failures == refinement.failures):
        latest = max(failures, key=lambda level: level.end)
        where = f"every level{' but coarser ones' * bool(levels)}"
        steps = ", ".join(str(level.steps) for level in failures)
        when = f"at the latest at {latest.end:.4g} s: {latest.failure}"
        return f"Newton's method fails at {where} ({steps} steps), {when}"
    if len(levels) < 2:
        return _small_budget(refinement, LEVELS, 4 * refinement.failures[-1].steps)
    worst = int(refinement.differences(*levels[-2:]).max(axis=0).argmax())
    pairs = [(refinement.differences(*pair), *pair) for pair in itertools.pairwise(levels[-3:])]
    last = [f"{d[:, worst].max():.2g} from {a.steps} to {b.steps} steps" for d, a, b in pairs]
    return (
        f"the last two levels agree within the tolerance up to {agreed_until(refinement):.4g} s; "
        f"the largest difference over its scale is that of the {refinement.variables.names[worst]}"
        f": {', '.join(last)}; {_cause(refinement)}"
    )


def _cause(refinement: Refinement) -> str:
    """Return why differences are above the tolerance, and what would do."""
    finest, judgement = refinement.levels[-1], refinement.judgement
    orders = refinement.orders[-2:]  # of levels between which one alone may be low by chance
    if refinement.remembers:
        why = "as it remembers earlier ones or draws numbers"
        cure = "pass a function that builds the system"
        return f"a user function gives other results in each run, {why}; {cure}"
    if judgement is not None and not judgement.decided and max(orders) < PLAUSIBLE[0]:
        times, apart = _distance(refinement)
        rate = growth(times, apart, APART).rate or 0.0
        logs = np.log(np.maximum.accumulate(np.clip(apart, SMALL, APART)))
        window = max(len(logs) // 20, 1)  # a switch makes differences within it
        gradual = np.max(logs[window:] - logs[:-window]) < 0.5 * (logs[-1] - logs[0])
        if gradual and rate * (times[-1] - times[0]) > math.log(GROWN):
            return (
                "differences do not fall, as the motion amplifies them: they double every "
                f"{math.log(2.0) / rate:.2g} s (chaos); end the run earlier, or take its statistics"
            )
        return (
            "differences do not fall: a right-hand side jumps (a switch, dry friction, a contact, "
            "a random number) and steps do not resolve it; smooth it, or end the run before it"
        )
    steps = math.ceil(finest.steps * refinement.excess(finest))
    phase = 2.0 * math.pi / STEPS_IN_PERIOD * steps  # is off by its third power / (12 steps^2)
    by_phase = phase * math.sqrt(phase / (12.0 * refinement.tolerance))
    need, budget = LEVELS, math.ceil(max(by_phase, 4.0 * max(steps, finest.steps)))
    if steps > finest.steps:
        need = f"the shortest period or the fastest turn, in steps of which {steps} make the run"
    elif judgement is not None and judgement.decided:
        order = np.clip(judgement.order, PLAUSIBLE[0], ORDER)
        budget = math.ceil(finest.steps * (judgement.error / refinement.tolerance) ** (1.0 / order))
        need = f"the tolerance: the error is {judgement.error:.2g}; some {budget} steps have it"
    return _small_budget(refinement, need, budget)


def _small_budget(refinement: Refinement, need: str, steps: int) -> str:
    """Return that the budget was too small for a need, which a level of these steps meets."""
    by_steps, by_time = refinement.budget_left()
    used = sum(steps for steps, _ in refinement.cost)
    seconds = refinement.runs.elapsed_time() * (1.0 + 4 * steps / used)
    cure = f"max_steps = {used + 4 * steps} would do"
    if seconds > A_DAY:
        cure = f"one that would do takes about {seconds / A_DAY:.2g} days; try a larger tolerance"
    elif by_time < by_steps:
        cure = f"max_time = {seconds:.3g} would do"
    return f"the budget was too small for {need}; {cure}"
