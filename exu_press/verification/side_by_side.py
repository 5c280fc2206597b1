"""Runs of several scenes and their refinements, beside each other on the cores."""

import gc
import os
import queue
import shlex
import warnings
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from itertools import zip_longest

from exu_press.files.command import command_line, executing
from exu_press.model.placement import placed_parts
from exu_press.result import Result
from exu_press.result.run import run_once
from exu_press.scene import Scene
from exu_press.terminal.progress import Progress
from exu_press.verification.refinement import plan
from exu_press.verification.run import errors_of, simulate_with_errors
from fe_models.processes import Child, ChildError, may_copy
from fe_models.temporary import remove_abandoned

__all__ = ["perform_run", "simulate_side_by_side"]

ITSELF = 1.0
"""Ratio of the run that is no refinement."""

SECONDS_BETWEEN_UPDATES = 0.2

IDEAL, DRY_PIN, FLEXIBLE, FINER = 0.1, 3.0, 3.0, -0.4
"""Time of a run with ideal joints, with a dry pin and with flexible bodies over that of others, and
the power of the tolerance with which it goes, as the press takes it. They order runs and tell when
all are done; results do not depend on them."""


@dataclass(frozen=True)
class Run:
    """A run to be done.

    Attributes:
        label: of its scene.
        ratio: of its tolerance to the scene's.
        scene: with that tolerance.
        with_errors: whether its process does the refinements, too.
        cost: time that it takes, in an arbitrary unit.
    """

    label: str
    ratio: float
    scene: Scene
    with_errors: bool
    cost: float


def simulate_side_by_side(
    scenes: Mapping[str, Scene], *, errors: bool = True, quiet: bool = True
) -> Iterator[tuple[str, Result]]:
    """Yield label and result of each scene as soon as it and its refinements are done.

    As many runs as there are cores are under way at a time; Ctrl-C ends them.

    Args:
        scenes: by label.
        errors: whether every quantity gets its error, by refinement runs.
        quiet: False shows what runs, and how long all will take.

    Raises:
        InputError: of a scene that cannot be run.
        ChildError: the process of a run failed; of a refinement, there is a warning instead.
    """
    runs = _in_order_of_time(
        [run for name, scene in scenes.items() for run in _runs(name, scene, errors)]
    )
    if not runs:
        return
    results: dict[str, dict[float, Result | ChildError]] = {label: {} for label in scenes}
    expected = {label: sum(run.label == label for run in runs) for label in scenes}
    total = sum(run.cost for run in runs)
    with (
        _Cores(min(os.cpu_count() or 1, len(runs))) as cores,
        Progress("compare", len(runs), "runs", quiet=quiet) as progress,
    ):
        waiting = {cores.submit(run): run for run in runs}
        while waiting:
            ended, _ = wait(waiting, SECONDS_BETWEEN_UPDATES, return_when=FIRST_COMPLETED)
            labels = dict.fromkeys(run.label for run, _ in list(cores.under_way.values()))
            progress.label = ", ".join(labels) or progress.label
            progress.update(len(runs) * cores.cost_done() / total)
            for future in ended:
                run = waiting.pop(future)
                try:
                    results[run.label][run.ratio] = future.result()
                except ChildError as error:
                    if run.ratio == ITSELF:
                        raise
                    results[run.label][run.ratio] = error
                if len(results[run.label]) == expected[run.label]:
                    yield run.label, _result_with_errors(results.pop(run.label), errors)


def perform_run(
    scene: Scene, with_errors: bool, command: str, report: Callable[[float], None]
) -> Result:
    """Run a scene in a process of its own for a command, and report the share that is done."""
    gc.disable()  # a tenth of the time goes into it, and a few runs leave it next to nothing
    with executing(shlex.split(command)):
        return _reported_run(scene, with_errors, report)


def _reported_run(scene: Scene, with_errors: bool, report: Callable[[float], None]) -> Result:
    if with_errors:
        return simulate_with_errors(scene, beside=False)
    if scene.bodies:  # reduced before the run's progress begins
        placed_parts(scene)
    with Progress("", scene.duration, whole=True, report=report):
        return run_once(scene, quiet=False)


class _Cores(AbstractContextManager["_Cores", None]):
    """Processes that do runs, each looked after by a thread; a context manager that ends them.

    Attributes:
        under_way: core -> its run, and the share of it that is done.
    """

    def __init__(self, count: int) -> None:
        self.under_way: dict[int, tuple[Run, float]] = {}
        self._done = 0.0
        self._command = command_line()
        self._idle: queue.SimpleQueue[int] = queue.SimpleQueue()
        self._children: list[Child] = []
        self._threads = ThreadPoolExecutor(count)
        function = perform_run if may_copy() else f"{__name__}:{perform_run.__name__}"
        try:
            for core in range(count):  # before any thread: copies have none
                progress = partial(self._report, core)
                self._children.append(Child(function, one_thread=True, progress=progress))
                self._idle.put(core)
        except BaseException:
            self.__exit__()
            raise

    def __exit__(self, *_: object) -> None:
        for child in self._children:
            child.kill()
        self._threads.shutdown(cancel_futures=True)
        for child in self._children:
            child.end()
        remove_abandoned()  # of children that were killed as they wrote

    def submit(self, run: Run) -> "Future[Result]":
        """Return the future result of a run; runs begin in the order in which they come."""
        return self._threads.submit(self._perform, run)

    def cost_done(self) -> float:
        """Return the cost of what is done of all runs."""
        return self._done + sum(run.cost * share for run, share in list(self.under_way.values()))

    def _report(self, core: int, share: float) -> None:
        self.under_way[core] = self.under_way[core][0], share

    def _perform(self, run: Run) -> Result:
        core = self._idle.get()
        self.under_way[core] = run, 0.0
        try:
            self._children[core].request(run.scene, run.with_errors, self._command)
            result: Result = self._children[core].answer()
            return result
        finally:
            del self.under_way[core]
            self._done += run.cost
            self._idle.put(core)


def _runs(label: str, scene: Scene, errors: bool) -> Iterator[Run]:
    """Yield a scene's run and its refinements; one alone where films settle, as it decides them."""
    if errors and scene.warms:
        yield Run(label, ITSELF, scene, True, 3.0 * _expected_cost(scene, ITSELF))
        return
    for ratio, refined in {ITSELF: scene, **(plan(scene) if errors else {})}.items():
        yield Run(label, ratio, refined, False, _expected_cost(refined, ratio))


def _expected_cost(scene: Scene, ratio: float) -> float:
    joints = scene.joints
    kinds = {joint.kind for name, joint in joints.items() if name not in joints.spherical}
    of_joints = DRY_PIN if "dry" in kinds else 1.0 if joints.by_group else IDEAL
    return float(scene.duration * of_joints * (FLEXIBLE if scene.bodies else 1.0) * ratio**FINER)


def _in_order_of_time(runs: list[Run]) -> list[Run]:
    """Return runs in the order in which they begin: the longest first, flexible ones alternating.

    The first flexible one reduces the bodies, which the second one reads.
    """
    longest = sorted(runs, key=lambda run: -run.cost)
    flexible = [run for run in longest if run.scene.bodies]
    rigid = [run for run in longest if not run.scene.bodies]
    pairs = zip_longest(flexible, rigid)
    return [run for pair in pairs for run in pair if run is not None]


def _result_with_errors(outcomes: dict[float, Result | ChildError], errors: bool) -> Result:
    """Return a run with the errors that its refinements tell."""
    run = outcomes.pop(ITSELF)
    assert isinstance(run, Result)
    if not errors or run.scene.warms:
        return run
    failures = [outcome for outcome in outcomes.values() if isinstance(outcome, ChildError)]
    if failures:
        warnings.warn(
            f"no errors of the quantities are known: a refinement run failed ({failures[0]})",
            stacklevel=3,
        )
    usable = run.completed and not failures
    refined = [
        (ratio, outcome)
        for ratio in plan(run.scene)
        if usable and isinstance(outcome := outcomes[ratio], Result)
    ]
    return replace(run, info={**run.info, **errors_of(run, refined)})
