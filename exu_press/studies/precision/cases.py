"""Cases: a scene with the settings that are worth their time."""

from dataclasses import dataclass, replace
from typing import Self

from exu_press.scene import Scene
from exu_press.studies.precision import references
from exu_press.studies.precision.errors import Errors, errors_of, peaks_error
from exu_press.studies.precision.references import Reference
from exu_press.studies.precision.stated import StatedErrors, stated_errors
from exu_press.studies.precision.timing import Attempt, TimedRun, fixed_steps, tolerances

__all__ = ["FULL", "QUICK", "STEPS", "TOLERANCES", "Case", "Extent", "case_of"]

STEPS = (1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6)  # s
TOLERANCES = (
    *(1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4),
    *(5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6),
)

FINEST = 1e-6
"""Tolerance of the truth of stated errors where no case says otherwise."""


@dataclass(frozen=True)
class Extent:
    """The part of the cases that is run.

    Attributes:
        repeats: of every run; the median is reported.
        revolutions: a rigid scene is not run longer.
        flexible_revolutions: a flexible scene is not run longer.
        finest_step: smaller fixed steps are left out, s.
        finest_tolerance: smaller tolerances are left out.
        finest_peer: smaller tolerances of the peers are left out.
        loosen: factor on the tolerances of the references.
        reference_step: smallest fixed step of a reference, s.
        starts: of a reference, beside its own, where trajectories diverge.
        stated: tolerances whose stated errors are held against the true ones.
    """

    repeats: int
    revolutions: float
    flexible_revolutions: float
    finest_step: float
    finest_tolerance: float
    finest_peer: float
    loosen: float
    reference_step: float
    starts: int
    stated: tuple[float, ...]


FULL = Extent(3, 2.0, 1.0, 1e-6, 1e-6, 1e-10, 1.0, 1e-6, 6, (1e-2, 3e-3, 1e-3, 3e-4))
QUICK = Extent(1, 0.2, 0.02, 1e-4, 1e-4, 1e-5, 30.0, 1e-5, 1, (1e-2,))


@dataclass(frozen=True)
class Case:
    """One row of the table; a campaign's own kinds have other references, solvers or systems.

    Attributes:
        name: on the command line and in the files.
        scene: of the runs; None for a system that is no scene.
        steps: fixed ones, s.
        tolerances: of the step control.
        reference_tolerance: the tightest one, which is the reference of a scene that has no closed
            form.
        reference_step: the smallest fixed step, with twice it beside, s.
        repeats: fewer than the amount's, for runs that take minutes.
    """

    name: str
    title: str
    scene: Scene | None
    steps: tuple[float, ...] = STEPS
    tolerances: tuple[float, ...] = TOLERANCES
    reference_tolerance: float = 0.0
    reference_step: float = 0.0
    repeats: int | None = None

    @property
    def duration(self) -> float:
        """Simulated time, s."""
        return self._scene.duration

    @property
    def _scene(self) -> Scene:
        assert self.scene is not None
        return self.scene

    def limit_to(self, amount: Extent) -> Self:
        """Return as much of it as is run."""
        scene = self.scene
        if scene is not None:
            longest = amount.flexible_revolutions if scene.bodies else amount.revolutions
            scene = scene.replace({"revolutions": min(scene.revolutions, longest)})
        return replace(
            self,
            scene=scene,
            steps=tuple(h for h in self.steps if h >= amount.finest_step),
            tolerances=tuple(tol for tol in self.tolerances if tol >= amount.finest_tolerance),
            repeats=self.repeats or amount.repeats,
        )

    def reference(self, amount: Extent) -> Reference:
        """Return the reference of its runs."""
        if _has_closed_form(self._scene):
            return references.closed_form(self._scene)
        tolerance = amount.loosen * self.reference_tolerance
        step = max(self.reference_step, amount.reference_step)
        return references.from_own(self._scene, tolerance, step, amount.starts)

    def attempts(self, amount: Extent) -> list[Attempt]:
        """Return its runs."""
        scene = self._scene
        return fixed_steps(scene, self.steps) + tolerances(scene, self.tolerances)

    def errors(
        self, run: TimedRun, reference: Reference, horizon: float
    ) -> tuple[Errors, float | None]:
        """Return the errors of a run, and where there is a horizon that of all its peaks."""
        if run.trajectory is None or reference.trajectory is None:
            return Errors(None, None, None), None
        both = run.trajectory, reference.trajectory
        peaks = peaks_error(*both, run.starts, reference.starts)
        return errors_of(*both, horizon), peaks if horizon < self.duration else None

    def compare_stated_errors(self, amount: Extent, horizon: float) -> list[StatedErrors]:
        """Return the stated errors of runs until the horizon."""
        if self.scene is None:
            return []
        predictable = self.scene.replace(
            {"revolutions": self.scene.revolutions * horizon / self.duration}
        )
        finest = amount.loosen * (self.reference_tolerance or FINEST)
        return stated_errors(self.name, predictable, amount.stated, finest)


def case_of(name: str, scene: Scene) -> Case:
    """Return the case of a user's scene, with the best reference there is for it."""
    if _has_closed_form(scene):
        return Case(name, "Scene, ideal joints", scene, steps=STEPS[:7])
    return Case(
        name,
        "Scene",
        scene,
        steps=STEPS[:7],
        tolerances=TOLERANCES[:10],
        reference_tolerance=1e-5,
        reference_step=5e-6,
    )


def _has_closed_form(scene: Scene) -> bool:
    soft = any(guide.soft for guide in scene.guides.values())
    gives = scene.joints.with_clearance or soft or scene.bodies
    return not gives and scene.drive is None
