"""Runs of the same scene at other tolerances, beside the run itself, in one further process."""

import math
import multiprocessing
import pickle
import subprocess
import sys
import tempfile
import threading
from multiprocessing.process import BaseProcess
from pathlib import Path
from types import TracebackType

from exu_press.confidence import companion
from exu_press.result import Result
from exu_press.scene import Scene

__all__ = ["Companions", "plan"]

COARSER = (4.0, 8.0, 16.0)
"""Tolerances of the companions over that of the run: beside it, they take little longer."""

OF_SMOOTH = 2
"""So many of them do where nothing has clearance, whose runs take little longer at any tolerance:
two cover 96 % of figures, three 97 %."""

OF_FLEXIBLE = (0.5, 8.0)
"""Those of flexible bodies beside clearances: coarser runs do not follow vibrations of some kHz, so
that their figures agree with each other and not with the truth."""

FINER = (0.5, 0.25)

LEAST = 2
"""Companions: a single one may agree with the run by chance."""

COARSER_STEPS = (2.0, 3.0, 4.0)

LOOSEST = 0.1
"""No run has a looser tolerance."""

LARGEST_STEP = 15.0
"""degrees"""

SAID = "said.txt"
"""What the process of the companions wrote to its terminal."""


def plan(scene: Scene) -> dict[float, Scene]:
    """Return the companions of a scene, by the ratio of their tolerance (or step) to its own.

    Where a tolerance is too loose for two coarser ones, finer ones have to do.
    """
    solver = scene.solver
    assert solver is not None
    if solver.step is not None:
        return {ratio: scene.replace("solver.step", ratio * solver.step) for ratio in COARSER_STEPS}
    assert solver.tolerance is not None
    tolerance = solver.tolerance
    ratios = [ratio for ratio in COARSER if ratio * tolerance <= LOOSEST]
    if len(ratios) < len(COARSER):
        ratios = [2.0, *ratios] if 2.0 * tolerance <= LOOSEST else []
    loose = scene.joints.with_clearance or (scene.guide and scene.guide.clearance)
    if not loose:
        ratios = ratios[:OF_SMOOTH]
    elif scene.bodies:
        ratios = [ratio for ratio in OF_FLEXIBLE if ratio * tolerance <= LOOSEST]
    more = [ratio for ratio in FINER if ratio not in ratios]
    ratios = [*ratios, *more[: max(0, LEAST - len(ratios))]]
    found = {}
    for ratio in ratios:
        change = {"solver.tolerance": ratio * tolerance}
        if not loose:  # else impacts and films keep steps far below the largest one
            longest = math.sqrt(ratio) * solver.max_step_deg
            change["solver.max_step_deg"] = min(longest, LARGEST_STEP)
        found[ratio] = scene.replace(change)
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


def _forked(directory: Path) -> None:
    """Do in a copy of this process what `companion` does in a new one."""
    sys.stdout = sys.stderr = (directory / SAID).open("w", encoding="utf-8")
    companion.main(directory)


class Companions:
    """The companions of a scene under way; a context manager that leaves no process behind."""

    def __init__(self, scene: Scene) -> None:
        """Start them, one after the other in a process of their own.

        A copy of this process is there at once; a new one takes as long as a short run to load the
        package, and is started by hand, as multiprocessing would run the user's script again in it.
        """
        self._scenes = plan(scene)
        self._temporary = tempfile.TemporaryDirectory(prefix="exu_press_")
        self._directory = Path(self._temporary.name)
        (self._directory / companion.SCENES).write_bytes(pickle.dumps([*self._scenes.values()]))
        (self._directory / SAID).touch()
        self._process: BaseProcess | subprocess.Popen[bytes]
        if _may_fork():
            fork = multiprocessing.get_context("fork")
            self._process = fork.Process(target=_forked, args=(self._directory,))
            self._process.start()
        else:
            command = [sys.executable, "-m", companion.__name__, self._temporary.name]
            with (self._directory / SAID).open("wb") as said:
                self._process = subprocess.Popen(
                    command, stdin=subprocess.DEVNULL, stdout=said, stderr=said
                )

    def results(self) -> dict[float, Result]:
        """Wait, and return what came out, by ratio.

        Raises:
            RuntimeError: the process failed.
        """
        if status := self._wait():
            said = (self._directory / SAID).read_text(encoding="utf-8", errors="replace")
            raise RuntimeError(f"a companion run failed ({status}): {said.strip()[-2000:]}")
        return {
            ratio: pickle.loads((self._directory / f"{number}.pickle").read_bytes())
            for number, ratio in enumerate(self._scenes)
        }

    def _wait(self) -> int | None:
        """Return the process's exit status at its end."""
        if isinstance(self._process, subprocess.Popen):
            return self._process.wait()
        self._process.join()
        return self._process.exitcode

    def __enter__(self) -> "Companions":
        """Return the companions."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End the process if it is not done, and clear away what it wrote."""
        self._process.kill()
        self._wait()
        self._temporary.cleanup()
