"""Runs of the same scene at other tolerances, beside the run itself, in further processes."""

import math
import multiprocessing
import pickle
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from multiprocessing.process import BaseProcess
from pathlib import Path

from exu_press.model.state import State
from exu_press.result import Result
from exu_press.scene import Scene
from exu_press.verification import refinement_process

__all__ = ["RefinementRuns", "plan"]

OF_STEPS = (2.0, 3.0, 4.0)
"""Fixed steps of the refinements over the run's: their errors and cost go with the step."""

PLANS: dict[float, tuple[float, float]] = {8.0: (0.5, 8.0), 2.0: (0.5, 2.0), 0.0: (0.25, 0.5)}
"""Tolerances of the refinements over the run's, by how much looser is allowed.

- Two, as a single one may agree with the run by chance.
- One is finer: at loose tolerances coarser runs do not follow the vibrations of bodies and contacts
  and agree with each other, and not with the truth. Of 140 random scenes without flexible bodies,
  a third of them long dry ones, runs at 4, 8 and 16 times the tolerance cover 96 % of the
  quantities, at half and 8 times 98.5 %, for a sixth more time.
- The other one is coarser where that is allowed, as it takes half as long as the run.

The least ratio is first: it tells where the trajectories diverge.
"""

LOOSEST = 0.1
"""No run has a looser tolerance."""

LARGEST_STEP = 15.0
"""degrees"""

POLL = 2e-3
"""s, between two looks for a result."""

Process = BaseProcess | subprocess.Popen[bytes]

SAID = "said_{}.txt"
"""File with the terminal output of the process of the refinement run of this number."""


def plan(scene: Scene) -> dict[float, Scene]:
    """Return the refinements of a scene, by the ratio of their tolerance (or step) to its own.

    Finer ones may take as many more steps: one that stops early tells no error.

    One that ends when its press stands goes on to the end of its revolutions in all of them: each
    stands at another instant.
    """
    if scene.drive is not None and scene.drive.ends_after is not None:
        scene = scene.replace({"drive.ends_after": None})
    solver = scene.solver
    assert solver is not None
    if solver.step is not None:
        return {ratio: scene.replace({"solver.step": ratio * solver.step}) for ratio in OF_STEPS}
    tolerance = solver.tolerance
    assert tolerance is not None
    room = next(least for least in PLANS if least * tolerance <= LOOSEST)
    found = {}
    for ratio in PLANS[room]:
        longest = min(math.sqrt(ratio) * solver.max_step_deg, LARGEST_STEP)
        found[ratio] = scene.replace(
            {
                "solver.tolerance": ratio * tolerance,
                "solver.max_step_deg": longest,
                "solver.max_steps": math.ceil(solver.max_steps / min(ratio, 1.0)),
            }
        )
    return found


def _may_fork() -> bool:
    """Return whether a copy of this process can go on by itself.

    It has this thread alone, so a lock that another one holds is never released in it; NGSolve has
    threads of its own. A process of multiprocessing's pools may have no children of that kind.
    """
    return (
        sys.platform == "linux"
        and threading.active_count() == 1
        and "ngsolve" not in sys.modules
        and not multiprocessing.current_process().daemon
    )


def _forked(directory: Path, numbers: Sequence[int]) -> None:
    """Do the work of `refinement_process` in a copy of this process."""
    sys.stdout = sys.stderr = _said(directory, numbers).open("w", encoding="utf-8")
    refinement_process.main(directory, numbers)


def _said(directory: Path, numbers: Sequence[int]) -> Path:
    """Return the terminal output of the process of these refinements."""
    return directory / SAID.format(numbers[0])


def _started(directory: Path, numbers: Sequence[int]) -> Process:
    """Start a process for refinements.

    A copy of this process is there at once; a new one takes as long as a short run to load the
    package, and is started by hand, as multiprocessing would run the user's script again in it.
    """
    said = _said(directory, numbers)
    said.touch()
    if _may_fork():
        fork = multiprocessing.get_context("fork")
        process = fork.Process(target=_forked, args=(directory, numbers))
        process.start()
        return process
    command = [
        sys.executable,
        "-m",
        refinement_process.__name__,
        str(directory),
        *map(str, numbers),
    ]
    with said.open("wb") as terminal:
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=terminal, stderr=terminal)


class RefinementRuns:
    """The refinements of a scene under way; a context manager that leaves no process behind."""

    def __init__(self, scene: Scene, start: State | None = None) -> None:
        """Start them, one after the other in a process of their own.

        A first one that is finer than the run takes longer than it. The others then have a process
        that gives way to it, so that two cores are busy until all are done.
        """
        self._scenes = plan(scene)
        self._temporary = tempfile.TemporaryDirectory(prefix="exu_press_")
        self._directory = Path(self._temporary.name)
        (self._directory / refinement_process.SCENES).write_bytes(
            pickle.dumps([(each, start) for each in self._scenes.values()])
        )
        numbers = range(len(self._scenes))
        finer = next(iter(self._scenes)) < 1.0
        self._parts = [numbers[:1], numbers[1:]] if finer else [numbers]
        self._processes = [_started(self._directory, numbers) for numbers in self._parts]

    def results(self) -> Iterator[tuple[float, Result]]:
        """Yield ratio and result of each, as soon as it is there.

        Raises:
            RuntimeError: the process failed.
        """
        ratios = [*self._scenes]
        for numbers, process in zip(self._parts, self._processes, strict=True):
            for number in numbers:
                path = self._directory / refinement_process.RESULT.format(number)
                while not path.exists():
                    if (status := _status(process)) is not None and not path.exists():
                        said = _said(self._directory, numbers)
                        words = said.read_text(encoding="utf-8", errors="replace").strip()
                        raise RuntimeError(f"a refinement run failed ({status}): {words[-2000:]}")
                    time.sleep(POLL)
                yield ratios[number], pickle.loads(path.read_bytes())

    def __enter__(self) -> "RefinementRuns":
        """Return the refinements."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the processes that are not done, and delete their files."""
        for process in self._processes:
            process.kill()
        for process in self._processes:
            if isinstance(process, subprocess.Popen):
                process.wait()
            else:
                process.join()
        self._temporary.cleanup()


def _status(process: Process) -> int | None:
    """Return a process's exit status, None as long as it runs."""
    return process.poll() if isinstance(process, subprocess.Popen) else process.exitcode
