"""The table of cases: scenes, where their references come from, and settings worth their time."""

from typing import Any

from exu_press.errors import InputError
from exu_press.mechanism.press import PAPER_LAWS
from exu_press.scene import Scene, flexible_press
from exu_press.studies.precision.cases import STEPS, TOLERANCES, Case
from precision.other_solvers import Reduced, Squeezer
from precision.variations import Modes

__all__ = ["cases", "chosen"]

PAPERS = {"law": "pinkus"}
"""The paper's film, which the reduced model has."""

DRY = PAPER_LAWS
"""Its contact and friction."""

SQUEEZER_STEPS = (1e-4, 3e-5, 1e-5, 3e-6, 1e-6)  # s


def cases() -> tuple[Case, ...]:
    """Return the table."""
    return (
        Case("slider_crank_ideal", "Slider-crank, ideal", _slider_crank("ideal")),
        Reduced(
            "slider_crank_dry_0.1mm",
            "Slider-crank, dry pin, 0.1 mm",
            _slider_crank("dry", 1e-4),
            variations=True,
        ),
        Reduced(
            "slider_crank_dry_0.01mm", "Slider-crank, dry pin, 0.01 mm", _slider_crank("dry", 1e-5)
        ),
        Reduced(
            "slider_crank_lubricated_0.1mm",
            "Slider-crank, lubricated pin, 0.1 mm",
            _slider_crank("lubricated", 1e-4),
            variations=True,
        ),
        Case("press_ideal", "Press, rigid, ideal", _press("ideal", "ideal"), steps=STEPS[:7]),
        Case(
            "press_lubricated",
            "Press, rigid, lubricated pin and dry balls, 0.1 mm",
            _press("lubricated", "dry"),
            steps=STEPS[:8],
            tolerances=TOLERANCES[:11],
            reference_tolerance=1e-6,
            reference_step=2e-6,
        ),
        Case(
            "press_dry",
            "Press, rigid, dry pin and dry balls, 0.1 mm",
            _press("dry", "dry"),
            steps=STEPS[:8],
            tolerances=TOLERANCES[:11],
            reference_tolerance=1e-5,
            reference_step=2e-6,
        ),
        Case(
            "press_flexible_lubricated",
            "Press, flexible (20 modes), lubricated pin and dry balls, 0.1 mm",
            _press("lubricated", "dry", bodies=flexible_press()),
            steps=STEPS[3:9],
            tolerances=TOLERANCES[:10],
            reference_tolerance=1e-6,
            reference_step=1e-6,
            repeats=1,
        ),
        Case(
            "press_flexible_dry",
            "Press, flexible (20 modes), dry pin and dry balls, 0.1 mm",
            _press("dry", "dry", bodies=flexible_press(), revolutions=0.25),
            steps=STEPS[3:9],
            tolerances=TOLERANCES[:10],
            reference_tolerance=3e-6,
            reference_step=1e-6,
            repeats=1,
        ),
        Modes(
            "press_flexible_modes",
            "Press, flexible, lubricated pin and dry balls, against 40 modes",
            _press("lubricated", "dry", bodies=flexible_press(modes=40), revolutions=0.2),
            steps=(),
            tolerances=(),
            reference_tolerance=1e-4,
            reference_step=4e-6,
            modes=(0, 2, 4, 10, 20, 30, 40),
            repeats=1,
        ),
        Squeezer(
            "squeezer",
            "Andrews' squeezer, endpoint of the test set for IVP solvers",
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


def _slider_crank(pin: str, clearance: float | None = None) -> Scene:
    scene = Scene(mechanism="slider_crank", start="centred", film=PAPERS, revolutions=1.0)
    scene = scene.replace({"joints.crank_pin": pin, **(DRY if pin == "dry" else {})})
    return scene if clearance is None else scene.replace({"joints.crank_pin.clearance": clearance})


def _press(pin: str, balls: str, **given: Any) -> Scene:
    joints = {"joints.crank_pin": pin, "joints.balls": balls}
    return Scene(film=PAPERS, **given).replace(joints)
