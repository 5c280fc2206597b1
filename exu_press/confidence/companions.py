"""Runs of the same scene at other tolerances, beside the run itself, in one further process."""

import math
import multiprocessing
import pickle
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from multiprocessing.process import BaseProcess
from pathlib import Path

from exu_press.confidence import companion
from exu_press.result import Result
from exu_press.scene import Scene

__all__ = ["Companions", "plan"]

OF_STEPS = (2.0, 3.0, 4.0)
"""Fixed steps of the companions over the run's: their errors and cost go with the step."""

PLANS: dict[str, dict[float, tuple[float, ...]]] = {
    "smooth": {
        16.0: (4.0, 8.0),
        4.0: (2.0, 4.0),
        2.0: (0.5, 2.0),
        0.0: (0.25, 0.5),
    },
    "rigid": {
        16.0: (4.0, 8.0, 16.0),
        8.0: (2.0, 4.0, 8.0),
        4.0: (2.0, 4.0),
        2.0: (0.5, 2.0),
        0.0: (0.25, 0.5),
    },
    "flexible": {64.0: (0.5, 8.0), 8.0: (0.25, 8.0), 0.0: (0.25, 0.5)},
}
"""Tolerances of the companions over the run's, by kind of scene and by how much looser is allowed.

- At least two, as a single one may agree with the run by chance; coarser ones, as all of them
  together then take little longer than the run.
- Smooth: nothing has clearance. Coarser runs take little less time there, and two cover 96 % of
  figures, three 97 %.
- Flexible bodies beside clearances: coarser runs do not follow vibrations of some kHz, so that
  their figures agree with each other and not with the truth. At loose tolerances many errors are
  nearly the same at half of it, too. In six runs at 1e-2 and 1e-3 a half covers 98 % of figures, a
  quarter 99.8 %, which takes a third more time; three coarser companions cover 94 %.

The least ratio is first: it tells where the motions part, and the coarsest are done soonest.
"""

LOOSEST = 0.1
"""No run has a looser tolerance."""

LARGEST_STEP = 15.0
"""degrees"""

POLL = 2e-3
"""s, between two looks for a result."""

SAID = "said.txt"
"""What the process of the companions wrote to its terminal."""


def plan(scene: Scene) -> dict[float, Scene]:
    """Return the companions of a scene, by the ratio of their tolerance (or step) to its own."""
    solver = scene.solver
    assert solver is not None
    if solver.step is not None:
        return {ratio: scene.replace("solver.step", ratio * solver.step) for ratio in OF_STEPS}
    tolerance = solver.tolerance
    assert tolerance is not None
    loose = scene.joints.with_clearance or (scene.guide and scene.guide.clearance)
    kind = "smooth" if not loose else "flexible" if scene.bodies else "rigid"
    room = next(least for least in PLANS[kind] if least * tolerance <= LOOSEST)
    found = {}
    for ratio in PLANS[kind][room]:
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

    def results(self) -> Iterator[tuple[float, Result]]:
        """Yield ratio and result of each, as soon as it is there.

        Raises:
            RuntimeError: the process failed.
        """
        for number, ratio in enumerate(self._scenes):
            path = self._directory / companion.RESULT.format(number)
            while not path.exists():
                if (status := self._status()) is not None and not path.exists():
                    said = (self._directory / SAID).read_text(encoding="utf-8", errors="replace")
                    raise RuntimeError(f"a companion run failed ({status}): {said.strip()[-2000:]}")
                time.sleep(POLL)
            yield ratio, pickle.loads(path.read_bytes())

    def _status(self) -> int | None:
        """Return the process's exit status, None as long as it runs."""
        if isinstance(self._process, subprocess.Popen):
            return self._process.poll()
        return self._process.exitcode

    def __enter__(self) -> "Companions":
        """Return the companions."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the process if it is not done, and clear away what it wrote."""
        self._process.kill()
        if isinstance(self._process, subprocess.Popen):
            self._process.wait()
        else:
            self._process.join()
        self._temporary.cleanup()
