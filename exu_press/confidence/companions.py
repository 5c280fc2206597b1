"""Runs of the same scene at other tolerances, beside the run itself, in one further process."""

import math
import pickle
import subprocess
import sys
import tempfile
from pathlib import Path
from types import TracebackType

from exu_press.result import Result
from exu_press.scene import Scene

__all__ = ["Companions", "plan"]

COARSER = (4.0, 8.0, 16.0)
"""Tolerances of the companions over that of the run: together they take as long as it does."""

COARSER_STEPS = (2.0, 3.0, 4.0)

LOOSEST = 0.1
"""No run has a looser tolerance."""

LARGEST_STEP = 15.0
"""degrees"""


def plan(scene: Scene) -> dict[float, Scene]:
    """Return the companions of a scene, by the ratio of their tolerance (or step) to its own.

    Where a tolerance is too loose for coarser ones, a finer one has to do.
    """
    solver = scene.solver
    assert solver is not None
    if solver.step is not None:
        return {ratio: scene.replace("solver.step", ratio * solver.step) for ratio in COARSER_STEPS}
    assert solver.tolerance is not None
    tolerance = solver.tolerance
    ratios = [ratio for ratio in COARSER if ratio * tolerance <= LOOSEST]
    if len(ratios) < len(COARSER):
        ratios = [2.0, *ratios] if 2.0 * tolerance <= LOOSEST else [0.5]
    found = {}
    for ratio in ratios:
        change = {"solver.tolerance": ratio * tolerance}
        if (
            not scene.joints.with_clearance
        ):  # else impacts and films keep steps far below the largest one
            longest = math.sqrt(ratio) * solver.max_step_deg
            change["solver.max_step_deg"] = min(longest, LARGEST_STEP)
        found[ratio] = scene.replace(change)
    return found


class Companions:
    """The companions of a scene under way; a context manager that leaves no process behind."""

    def __init__(self, scene: Scene) -> None:
        """Start them, one after the other in a process of their own."""
        self._ratios = tuple(plan(scene))
        self._directory = tempfile.TemporaryDirectory(prefix="exu_press_")
        command = [sys.executable, "-m", "exu_press.confidence.companion", self._directory.name]
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
        )
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(pickle.dumps(tuple(plan(scene).values())))
            self._process.stdin.close()
        except BrokenPipeError:  # it ended at once, and says why when it is asked
            pass

    def results(self) -> dict[float, Result]:
        """Wait, and return what came out, by ratio.

        Raises:
            RuntimeError: the process failed.
        """
        assert self._process.stderr is not None
        complaint = self._process.stderr.read().decode(errors="replace")
        if self._process.wait() != 0:
            raise RuntimeError(f"a companion run failed: {complaint.strip()[-2000:]}")
        found = {}
        for number, ratio in enumerate(self._ratios):
            path = Path(self._directory.name) / f"{number}.pickle"
            found[ratio] = pickle.loads(path.read_bytes())
        return found

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
        self._process.wait()
        if self._process.stderr is not None:
            self._process.stderr.close()
        self._directory.cleanup()
