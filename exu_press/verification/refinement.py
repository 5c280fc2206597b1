"""Runs of the same scene at other tolerances, beside the run itself, in further processes."""

import gc
import math
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager

from exu_press.model.state import State
from exu_press.result import Result
from exu_press.result.run import run_once
from exu_press.scene import Scene
from fe_models.processes import Child, ChildError, may_copy
from fe_models.temporary import remove_abandoned

__all__ = ["RefinementRuns", "plan", "refine", "step_changes"]

OF_STEPS = (2.0, 3.0, 4.0)
"""Fixed steps of the refinements over the run's: their errors and cost go with the step."""

PLANS: dict[float, tuple[float, float]] = {4.0: (0.5, 4.0), 2.0: (0.5, 2.0), 0.0: (0.25, 0.5)}
"""Tolerances of the refinements over the run's, by how much looser is allowed.

- Two, as a single one may agree with the run by chance.
- One is finer: at loose tolerances coarser runs do not follow the vibrations of bodies and contacts
  and agree with each other, and not with the truth.
- The other one is coarser where that is allowed, as it takes two thirds of the run's time. At 8
  times the tolerance it takes half of it, and agrees with the others by chance more often.

The least ratio is first: it tells where the trajectories diverge.
"""

LOOSEST = 0.1
"""No run has a looser tolerance."""

FINEST, LARGEST_STEP = 1e-8, 15.0
"""Least tolerance and largest step, deg, that a scene may have."""

GIVES_WAY = 10
"""By how much nicer all but the first one are to what else runs; systems without it share alike."""


def plan(scene: Scene) -> dict[float, Scene]:
    """Return the refinements of a scene, by the ratio of their tolerance (or step) to its own.

    One that ends when its press stands goes on to the end of its revolutions in all of them: each
    stands at another instant.
    """
    if scene.drive is not None and scene.drive.ends_after is not None:
        scene = scene.replace({"drive.ends_after": None})
    key, value = scene.solver.accuracy
    ratios: Sequence[float] = OF_STEPS
    if key == "tolerance":
        ratios = next(ratios for least, ratios in PLANS.items() if least * value <= LOOSEST)
    return {ratio: scene.replace(step_changes(scene, ratio)) for ratio in ratios}


def step_changes(scene: Scene, ratio: float) -> dict[str, float]:
    """Return the keys with which a scene has `ratio` times its tolerance, or its fixed step.

    The largest step of a tolerance goes with its root. Finer runs may take as many more steps.
    """
    solver = scene.solver
    key, value = solver.accuracy
    changes = {
        f"solver.{key}": ratio * value,
        "solver.max_steps": math.ceil(solver.max_steps / min(ratio, 1.0)),
    }
    if key == "tolerance":
        changes["solver.tolerance"] = max(ratio * value, FINEST)
        longest = min(math.sqrt(ratio) * solver.max_step_deg, LARGEST_STEP)
        changes["solver.max_step_deg"] = longest
    return changes


def refine(scene: Scene, start: State | None) -> Result:
    """Run a scene from its start, in a process of its own."""
    gc.disable()  # a tenth of the time goes into it, and a few runs leave it next to nothing
    return run_once(scene, start=start)


class RefinementRuns(AbstractContextManager["RefinementRuns", None]):
    """The refinements of a scene under way; a context manager that leaves no process behind."""

    def __init__(self, scene: Scene, start: State | None = None) -> None:
        """Start them, one after the other in a process of their own.

        A first one that is finer than the run takes longer than it. The others then have a process
        that gives way to it, so that two cores are busy until all are done. A copy of this process
        is there at once; a new one takes as long as a short run to load the package.
        """
        scenes = plan(scene)
        first, *remaining = scenes
        sequences = [[first], remaining] if first < 1.0 else [[first, *remaining]]
        function = refine if may_copy() else f"{__name__}:{refine.__name__}"
        self._children: list[tuple[Child, list[float]]] = []
        try:
            for ratios in sequences:
                child = Child(function, niceness=0 if first in ratios else GIVES_WAY)
                self._children.append((child, ratios))
                for ratio in ratios:
                    child.request(scenes[ratio], start)
        except BaseException:
            self.end()
            raise

    def results(self) -> Iterator[tuple[float, Result]]:
        """Yield ratio and result of each, as soon as it is there.

        Raises:
            ChildError: a process failed.
        """
        for child, ratios in self._children:
            for ratio in ratios:
                try:
                    yield ratio, child.answer()
                except ChildError as error:
                    raise ChildError(f"a refinement run failed ({error})") from None

    def end(self) -> None:
        """End the processes that are not done."""
        for child, _ in self._children:
            child.kill()
        for child, _ in self._children:
            child.end()
        remove_abandoned()  # of children that were killed as they wrote

    def __exit__(self, *_: object) -> None:
        self.end()
