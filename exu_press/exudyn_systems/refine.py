"""Refinement: runs with rising numbers of steps, until the stated error is within the tolerance."""

import itertools
import math
from dataclasses import dataclass, field

from exu_press.exudyn_systems.difference import at_peaks, differences, excess_step, scales_of
from exu_press.exudyn_systems.level import OUT_OF_TIME, Level, Levels
from exu_press.exudyn_systems.samples import MOST_SAMPLES, Variables
from exu_press.numerics.arrays import Array
from exu_press.numerics.convergence import ORDER, PLAUSIBLE, SAFETY, Judgement, judge

__all__ = ["Refinement", "grid"]

COARSEST = 8  # the user's own number of steps over that of the coarsest level, at most
FACTORS = 2, 8  # least and largest factor to the next level's number of steps
MARGIN = 0.7  # error over the tolerance at which the last level is aimed
AT_ONCE = 4  # largest factor to the last level: orders of coarse levels do not hold further
SURE, CONFIRMS = 0.5, 1.5  # factor below which the next level only confirms, and that level's
GIVE_UP = 16  # times the user's own number of steps, after which a refinement that fails ends
ALIGNED = 1.35  # largest factor by which steps are raised to put rows at equal distances


@dataclass
class Refinement:
    """Levels of a system, and the error that follows from them."""

    runs: Levels
    variables: Variables
    tolerance: float
    users: int  # the user's own number of steps
    rows: int  # of output that the settings ask for
    max_steps: int  # of all levels together
    levels: list[Level] = field(default_factory=list)  # the last ones, the coarsest first
    failures: list[Level] = field(default_factory=list)  # that did not get to the end
    judgement: Judgement | None = None  # of the last three levels, if they can decide
    orders: list[float] = field(default_factory=list)  # observed, of the worst quantity
    remembers: bool = False  # whether a run on the user's system differed from its copy
    cost: list[tuple[int, float]] = field(default_factory=list)  # steps and processor time, s

    def refine(self, coarsest: int) -> Level:
        """Run levels from a number of steps on; return the one that the system holds."""
        held: Level | None = None
        try:
            self._keep(*self.runs.run_beside([coarsest, FACTORS[0] * coarsest]))
            while not self.solver_gives_up():
                numbers, last = self._next()
                repeats = bool(self.levels) and numbers[-1] == self.levels[-1].steps
                if last and (held is None or (repeats and self.meets_tolerance())):
                    held = self._run_last(numbers, repeats=repeats)
                    if repeats or not self.levels or self.meets_tolerance():
                        return held
                elif held is not None and (repeats or not (self.runs.build or self.runs.spares)):
                    return held
                else:
                    self._keep(*self.runs.run_beside(numbers))
            return held or self.failures[-1]
        finally:
            for spare in self.runs.spares:
                spare.end()

    def meets_tolerance(self) -> bool:
        """Return whether the finest level is within the tolerance."""
        if self.judgement is None or self.remembers:
            return False
        return self.judgement.decided and self.judgement.error <= self.tolerance

    def scales(self) -> Array:
        """Return the scales of the finest level."""
        finest = self.levels[-1]
        return scales_of(finest.samples, self.variables, finest.step * finest.steps)

    def excess(self, level: Level) -> float:
        """Return a level's step over the longest one of a level that decides."""
        return excess_step(level.samples, level.step, self.variables, self.scales(), self.tolerance)

    def differences(self, first: Level, second: Level) -> Array:
        """Return the differences of two levels over the scales, (instants, quantities)."""
        return differences(first.samples, second.samples, self.variables) / self.scales()

    def newton_failures(self) -> list[Level]:
        """Return the levels at which Newton's method failed."""
        return [level for level in self.failures if level.failure != OUT_OF_TIME]

    def budget_left(self) -> tuple[float, float]:
        """Return the number of steps that max_steps allows for, and that the time left does."""
        used, elapsed = sum(steps for steps, _ in self.cost), self.runs.elapsed_time()
        return self.max_steps - used, (self.runs.max_time / elapsed - 1.0) * used

    def solver_gives_up(self) -> bool:
        """Return whether the solver gave up at the last level, and that had many steps."""
        last = max([run.steps for run in self.newton_failures()], default=0)
        finest = max([run.steps for run in self.levels], default=0)
        return last > finest and last >= GIVE_UP * self.users

    def _run_last(self, numbers: list[int], *, repeats: bool) -> Level:
        """Run a level on the user's system; compare it with the one that it repeats, if any."""
        *earlier, level = self.runs.run_beside(numbers, last=True)
        if repeats and not level.failure:
            copy, self.levels[-1] = self.levels[-1], level
            self.remembers = bool(self.differences(copy, level).max() > self.tolerance)
            self.cost.append((level.steps, level.seconds))
        else:
            self._keep(*earlier, level)
        return level

    def _keep(self, *levels: Level) -> None:
        """Keep levels, and judge the last one where three have short enough steps."""
        for level in levels:
            self.cost.append((level.steps, level.seconds))
            (self.failures if level.failure else self.levels).append(level)
            if level.failure:
                continue
            self.levels, deciding, self.judgement = self.levels[-4:], self._deciding(), None
            if len(deciding) == 3:
                samples = list(itertools.pairwise(level.samples for level in deciding))
                apart = [differences(*pair, self.variables) for pair in samples]
                peaks = [at_peaks(*pair, d) for pair, d in zip(samples, apart, strict=True)]
                relative = [(d / self.scales()).max(axis=0) for d in apart]
                numbers = [level.steps for level in deciding]
                self.judgement = judge(numbers, relative, peaks, self.tolerance)
                self.orders.append(self.judgement.order)

    def _deciding(self) -> list[Level]:
        """Return those of the last three levels whose steps are short enough."""
        return [level for level in self.levels[-3:] if self.excess(level) <= 1.0]

    def _next(self) -> tuple[list[int], bool]:
        """Return the next numbers of steps, and whether the system is to hold the last of them."""
        tried = max(level.steps for level in (*self.levels, *self.failures))
        factor, two, last = self._next_factor(tried)
        parts = 1 if tried % (2 * self.runs.samples) else 2  # halves only where samples divide them
        steps = tried * math.ceil(parts * min(factor, FACTORS[1]) - 1e-9) // parts
        near = range(steps, int(ALIGNED * steps) + 1, self.runs.samples)
        steps = next((n for n in near if n % self.rows == 0 or self.rows % n == 0), steps)
        remaining = min(self.budget_left())
        if two and 5 * steps <= remaining:  # with a repetition
            return [steps, 2 * steps], last
        last = last and not two
        if steps * (1 if last else 2) <= remaining:
            return [steps], last
        finest = self.levels[-1].steps if self.levels else tried
        return [finest * max(int(min(remaining, steps) // finest), 1)], True

    def _next_factor(self, tried: int) -> tuple[float, bool, bool]:
        """Return the next factor, whether two levels are needed, and whether the last suffices."""
        if not self.levels:
            return FACTORS[0], True, False
        finest, judgement, excess = self.levels[-1], self.judgement, self.excess(self.levels[-1])
        if excess > 1.0 or finest.steps < tried or len(self.levels) == 1:
            return max(excess, FACTORS[0]), excess > 1.0, False
        undecided = judgement is not None and not judgement.decided
        late = undecided and finest.steps >= GIVE_UP * self.users and len(self.orders) > 1
        if self.meets_tolerance() or (late and max(self.orders[-2:]) < PLAUSIBLE[0]):
            return 1.0, False, True
        if judgement is None or undecided:
            ratio, order = finest.steps / self.levels[-2].steps, ORDER  # taken for the method's
            error = SAFETY * self.differences(*self.levels[-2:]).max() / (ratio**order - 1.0)
        else:
            error, order = judgement.error, max(min(judgement.order, ORDER), PLAUSIBLE[0])
        factor = (error / (MARGIN * self.tolerance)) ** (1.0 / order)
        if factor > AT_ONCE:
            return FACTORS[0] if undecided else max(factor / AT_ONCE, FACTORS[0]), True, False
        if undecided or len(self._deciding()) < 2:
            return FACTORS[0], True, True
        return CONFIRMS if factor < SURE else max(factor, FACTORS[0]), False, True


def grid(steps: int, rows: int) -> tuple[int, int]:
    """Return the coarsest level's number of steps and of samples, on rows of output if cheap."""
    least = max(math.ceil(steps / COARSEST), 3)

    def cost(samples: int) -> tuple[int, int]:
        matches = samples % rows == 0 or rows % samples == 0
        return samples * math.ceil(least / samples) * (1 if matches else FACTORS[0]), -samples

    samples = min(range(min(MOST_SAMPLES // 2, least), MOST_SAMPLES + 1), key=cost)
    return samples * math.ceil(least / samples), samples
