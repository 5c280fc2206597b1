"""What is run: one table of cases, and how much of it.

A further case is one more entry of `cases()`: a scene, where its reference comes from, and the
settings that are worth their time. A flexible press needs nothing else.
"""

from dataclasses import dataclass
from typing import Any, Literal

from exu_press.errors import InputError
from exu_press.scene import Scene
from exu_press.scene.tables import Flexible
from exu_press.studies.precision.reduced import is_reducible

__all__ = ["FULL", "QUICK", "Amount", "Case", "case_of", "cases", "chosen"]

STEPS = (1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6)  # s
TOLERANCES = (
    *(1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4),
    *(5e-5, 2e-5, 1e-5, 5e-6, 2e-6, 1e-6),
)
SQUEEZER_STEPS = (1e-4, 3e-5, 1e-5, 3e-6, 1e-6)  # s


@dataclass(frozen=True)
class Amount:
    """How much of the table is run.

    Attributes:
        repeats: of every run; the median is reported.
        revolutions: a rigid scene is not run longer.
        flexible_revolutions: a flexible scene is not run longer.
        finest_step: smaller fixed steps are left out, s.
        finest_tolerance: smaller tolerances are left out.
        finest_peer: smaller tolerances of the peers are left out.
        loosen: factor on the tolerances of the references.
        reference_step: smallest fixed step of a reference, s.
    """

    repeats: int
    revolutions: float
    flexible_revolutions: float
    finest_step: float
    finest_tolerance: float
    finest_peer: float
    loosen: float
    reference_step: float


FULL = Amount(3, 2.0, 0.2, 1e-6, 1e-6, 1e-10, 1.0, 1e-6)
QUICK = Amount(1, 0.2, 0.02, 1e-4, 1e-4, 1e-5, 30.0, 1e-5)


@dataclass(frozen=True)
class Case:
    """One row of the table.

    Attributes:
        name: on the command line and in the files.
        title: in words.
        reference: "closed form" (ideal joints), "reduced" (slider-crank: two integrators on two
            coordinates), "own" (the tightest tolerance against the smallest fixed step) or
            "published".
        scene: what is run; None for the squeezer.
        horizon: errors are pointwise up to it, s; None for the whole run.
        steps: fixed ones, s.
        tolerances: of the step control.
        reference_tolerance: "own": the tightest one, which is the reference.
        reference_step: "own": the smallest fixed step, with twice it beside, s.
        variations: whether spectral radius and Newton mode are varied.
        modes: numbers of modes that are tried, at the default tolerance.
        repeats: fewer than the amount's, for runs that take minutes.
    """

    name: str
    title: str
    reference: Literal["closed form", "reduced", "own", "published"]
    scene: Scene | None
    horizon: float | None = None
    steps: tuple[float, ...] = STEPS
    tolerances: tuple[float, ...] = TOLERANCES
    reference_tolerance: float = 0.0
    reference_step: float = 0.0
    variations: bool = False
    modes: tuple[int, ...] = ()
    repeats: int | None = None


def cases() -> tuple[Case, ...]:
    """Return the table."""
    return (
        Case("slider_crank_ideal", "Slider-crank, ideal", "closed form", _slider_crank("ideal")),
        Case(
            "slider_crank_dry_0.1mm",
            "Slider-crank, dry pin, 0.1 mm",
            "reduced",
            _slider_crank("dry", 1e-4),
            variations=True,
        ),
        Case(
            "slider_crank_dry_0.01mm",
            "Slider-crank, dry pin, 0.01 mm",
            "reduced",
            _slider_crank("dry", 1e-5),
        ),
        Case(
            "slider_crank_lubricated_0.1mm",
            "Slider-crank, lubricated pin, 0.1 mm",
            "reduced",
            _slider_crank("lubricated", 1e-4),
            variations=True,
        ),
        Case(
            "press_ideal",
            "Press, rigid, ideal",
            "closed form",
            _press("ideal", "ideal"),
            steps=STEPS[:7],
        ),
        Case(
            "press_lubricated",
            "Press, rigid, lubricated pin and dry balls, 0.1 mm",
            "own",
            _press("lubricated", "dry"),
            steps=STEPS[:8],
            tolerances=TOLERANCES[:11],
            reference_tolerance=1e-6,
            reference_step=2e-6,
        ),
        Case(
            "press_dry",
            "Press, rigid, dry pin and dry balls, 0.1 mm",
            "own",
            _press("dry", "dry"),
            horizon=0.225,  # two references part by 2e-7 m before the impacts at 0.24 s, 1e-5 after
            steps=STEPS[:8],
            tolerances=TOLERANCES[:11],
            reference_tolerance=1e-5,
            reference_step=1e-6,
        ),
        Case(
            "press_flexible_lubricated",
            "Press, flexible (20 modes), lubricated pin and dry balls, 0.1 mm",
            "own",
            _press("lubricated", "dry", bodies="flexible"),
            steps=STEPS[3:9],
            tolerances=TOLERANCES[:10],
            reference_tolerance=1e-5,
            reference_step=2e-6,
            repeats=1,
        ),
        Case(
            "press_flexible_dry",
            "Press, flexible (20 modes), dry pin and dry balls, 0.1 mm",
            "own",
            _press("dry", "dry", bodies="flexible"),
            steps=STEPS[3:8],
            tolerances=TOLERANCES[:10],
            reference_tolerance=1e-5,
            reference_step=2e-6,
            repeats=1,
        ),
        Case(
            "press_flexible_modes",
            "Press, flexible, lubricated pin and dry balls, against 40 modes",
            "own",
            _press("lubricated", "dry", bodies="flexible", flexible=Flexible(modes=40)),
            steps=(),
            tolerances=(),
            reference_tolerance=1e-4,
            reference_step=4e-6,
            modes=(0, 2, 4, 10, 20, 30, 40),
            repeats=1,
        ),
        Case(
            "squeezer",
            "Andrews' squeezer, endpoint of the test set for IVP solvers",
            "published",
            None,
            steps=SQUEEZER_STEPS,
        ),
    )


def chosen(names: list[str]) -> tuple[Case, ...]:
    """Return the cases of these names, all of them for none."""
    table = {case.name: case for case in cases()}
    for name in names:
        if name not in table:
            raise InputError(f"--case {name}: allowed is one of {', '.join(table)}")
    return tuple(case for name, case in table.items() if not names or name in names)


def case_of(name: str, scene: Scene) -> Case:
    """Return the case of a user's scene, with the best reference there is for it."""
    if not scene.joints.with_clearance:
        return Case(name, "Scene, ideal joints", "closed form", scene, steps=STEPS[:7])
    if is_reducible(scene):
        return Case(name, "Scene, slider-crank", "reduced", scene)
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


def _press(pin: str, balls: str, **given: Any) -> Scene:
    return Scene(**given).replace({"joints.crank_pin": pin, "joints.balls": balls})


def _slider_crank(pin: str, clearance: float | None = None) -> Scene:
    scene = Scene(mechanism="slider_crank", revolutions=1.0).replace("joints.crank_pin", pin)
    return scene if clearance is None else scene.replace("joints.crank_pin.clearance", clearance)
