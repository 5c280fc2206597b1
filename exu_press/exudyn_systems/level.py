"""Runs with constant steps: in copies of the process, on systems of their own, or the user's."""

import time as clock
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from typing import Any

import exudyn as exu
import numpy as np

from exu_press.errors import InputError
from exu_press.exudyn_systems.samples import MOST_SAMPLES, Samples, Variables
from exu_press.integrate.task import set_meanwhile
from exu_press.integrate.user_functions import user_function
from fe_models.processes import Child, ChildError, why_not_copied

__all__ = ["OUT_OF_TIME", "Level", "Levels"]

OUT_OF_TIME = "the time was used up"  # why a level ended; else Newton's method failed
SPARES = 4  # copies of the process that are kept for further levels


@dataclass
class Level:
    """A run: number and size (s) of steps, processor time and end (s), why it failed, if it did."""

    steps: int
    step: float
    seconds: float
    end: float
    failure: str
    iterations: int
    samples: Samples


@dataclass
class Levels:
    """Runs of one system from the same start, with different numbers of steps."""

    mbs: exu.MainSystem  # that the last level is run on
    settings: exu.SimulationSettings
    samples: int  # the least number of them, of which each number of steps is a multiple
    max_time: float  # of all levels together, s
    build: Callable[[], exu.MainSystem] | None  # for each level; None: copies of the process
    begun: float = field(default_factory=clock.monotonic)
    touched: bool = False  # whether the system has been run
    holds_last: bool = False  # whether it is of a level that was expected to be the last one
    spares: list[Child] = field(default_factory=list)  # from before that, if the last level misses

    def elapsed_time(self) -> float:
        """Return the time since the levels began, s."""
        return clock.monotonic() - self.begun

    def run_beside(self, numbers: list[int], *, last: bool = False) -> list[Level]:
        """Return levels beside each other in copies, or the last one on the user's system."""
        if self.build is not None:
            return [self.run(steps, alone=not last or steps < numbers[-1]) for steps in numbers]
        copied = numbers[:-1] if last else numbers
        if not self.touched:
            count = len(copied) + (SPARES if last else 0)
            self.spares = [Child(lambda n: self.run(n, alone=True)) for _ in range(count)]
        children = [self.spares.pop() for _ in copied[: len(self.spares)]]
        try:
            for child, steps in zip(children, copied, strict=False):
                child.request(steps)
            held = [self.run(numbers[-1])] if last else []
            return [child.answer() for child in children] + held
        except ChildError as error:  # a user function failed
            raise exu.ExudynError(str(error)) from None
        finally:
            for child in children:
                child.end()

    def run(self, steps: int, *, alone: bool = False) -> Level:
        """Return a run in this process; `alone` writes no files, no rows and no text."""
        system: Any = self.build() if self.build and self.touched else self.mbs
        if not (alone and self.holds_last):
            self.mbs, self.holds_last = system, not alone
        function = user_function(system, "PostStep")
        start, end = self.settings.timeIntegration.startTime, self.settings.timeIntegration.endTime
        factors = range(1, MOST_SAMPLES // self.samples + 1)
        count = self.samples * max(k for k in factors if steps // self.samples % k == 0)
        step, period, variables = (end - start) / steps, (end - start) / count, Variables(system)
        rows, failure, self.touched = list[Any](), "", True

        def sample(mbs: Any, time: float) -> bool:
            nonlocal failure
            go_on = not function or bool(function(mbs, time))
            if time >= start + len(rows) * period - 0.5 * step:
                rows.append(variables.row(time))
                failure = OUT_OF_TIME if self.elapsed_time() > self.max_time else ""
            return go_on and not failure

        begun = clock.process_time()
        with _constant_steps(self.settings, steps, alone=alone):
            system.SetPostStepUserFunction(sample)
            try:
                system.SolveDynamic(self.settings)
            except exu.SolverError:
                text = str(system.sys["dynamicSolver"].GetErrorString()).strip()
                failure = failure or (text or "Newton's method did not converge").splitlines()[0]
            finally:
                system.SetPostStepUserFunction(function)
        return Level(
            steps=steps,
            step=step,
            seconds=clock.process_time() - begun,
            end=float(system.systemData.GetTime()),
            failure=failure,
            iterations=int(system.sys["dynamicSolver"].it.newtonStepsCount),
            samples=Samples(*map(np.array, zip(*(rows or [variables.row(start)]), strict=True))),
        )

    def refuse_copy(self) -> None:
        """Refuse a process that cannot be copied safely, with a message that says what to do."""
        container: Any = self.mbs.GetSystemContainer()
        threads, reason = int(self.settings.parallel.numberOfThreads), why_not_copied()
        if threads > 1:
            reason = f"settings.parallel.numberOfThreads = {threads}"
        if container.renderer.IsActive():
            reason = "the renderer is running"
        if reason:
            raise InputError(
                f"mbs: earlier levels run in copies of this process, which is not safe, as {reason}"
                "; pass a function that builds and returns the assembled system instead: "
                "solve_dynamic(build, settings)"
            )


def _constant_steps(
    settings: exu.SimulationSettings, steps: int, *, alone: bool
) -> AbstractContextManager[None]:
    """Set what a level needs in Exudyn's settings, and put everything back."""
    integration, output = settings.timeIntegration, settings.solution
    values: list[tuple[Any, str, Any]] = [(integration, "numberOfSteps", steps)]
    values += [(integration, "adaptiveStep", False)]
    if alone:
        values += [(integration, name, 0) for name in ("verboseMode", "verboseModeFile")]
        values += [(owner, "write", False) for owner in (output.file, output.restart)]
        values += [(owner, "active", False) for owner in (output.sensors, integration.realtime)]
        values += [(output, "recordImagesInterval", -1.0), (exu.config, "printToConsole", False)]
    return set_meanwhile(values)
