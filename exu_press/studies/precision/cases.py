"""What is run: a scene with the settings that are worth their time."""

from dataclasses import dataclass
from typing import Literal

from exu_press.scene import Scene
from exu_press.studies.precision.extra import Extra

__all__ = ["STEPS", "TOLERANCES", "Case", "case_of"]

STEPS = (1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6)  # s
TOLERANCES = (
    *(1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4),
    *(5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6),
)


@dataclass(frozen=True)
class Case:
    """One row of the table.

    Attributes:
        name: on the command line and in the files.
        title: in words.
        reference: "closed form" (ideal joints), "own" (the tightest tolerance against the smallest
            fixed step) or "extra".
        scene: what is run; None for a system that only `extra` knows.
        steps: fixed ones, s.
        tolerances: of the step control.
        reference_tolerance: "own": the tightest one, which is the reference.
        reference_step: "own": the smallest fixed step, with twice it beside, s.
        variations: whether spectral radius and Newton mode are varied.
        modes: numbers of modes that are tried, at the default tolerance.
        repeats: fewer than the amount's, for runs that take minutes.
        extra: other solvers, and the reference of that name.
    """

    name: str
    title: str
    reference: Literal["closed form", "own", "extra"]
    scene: Scene | None
    steps: tuple[float, ...] = STEPS
    tolerances: tuple[float, ...] = TOLERANCES
    reference_tolerance: float = 0.0
    reference_step: float = 0.0
    variations: bool = False
    modes: tuple[int, ...] = ()
    repeats: int | None = None
    extra: Extra | None = None


def case_of(name: str, scene: Scene) -> Case:
    """Return the case of a user's scene, with the best reference there is for it."""
    if not scene.joints.with_clearance:
        return Case(name, "Scene, ideal joints", "closed form", scene, steps=STEPS[:7])
    return Case(
        name,
        "Scene",
        "own",
        scene,
        steps=STEPS[:7],
        tolerances=TOLERANCES[:10],
        reference_tolerance=1e-5,
        reference_step=5e-6,
    )
