"""Error of the press's peaks against run time: by tolerance, with fixed steps, and SciPy's Radau.

The error is that of the slider's peak acceleration, as resolved: the worse one of the first two
revolutions, against the independent model of tests/independent/symmetric_press.py, which shares no
code with the package: three coordinates, SciPy's LSODA at 1e-11. Radau integrates that model too,
in plain Python; so its evaluations are to be compared, and not its time.

Run with: python scripts/press_work_precision.py [--quick] [--pin dry] [--out FILE.png]
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from exu_press import Result, Scene, simulate
from exu_press.plots.palette import COLOURS
from exu_press.plots.style import DPI, with_style
from exu_press.result.windows import revolutions_of
from exu_press.terminal.columns import columns

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from independent.reduced_slider_crank import Numbers
from independent.symmetric_press import SymmetricPress

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="a tenth of a revolution, few settings")
parser.add_argument("--pin", choices=["dry", "lubricated"], help="one press alone")
parser.add_argument("--out", type=Path, help="a picture of it")
OPTIONS = parser.parse_args()
REVOLUTIONS = 0.1 if OPTIONS.quick else 2.0
SETTINGS = {
    "tolerance": (1e-2,) if OPTIONS.quick else (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5),
    "step": (1e-4,) if OPTIONS.quick else (1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6),
    "Radau": (1e-4,) if OPTIONS.quick else (1e-4, 1e-5, 1e-6, 1e-7),
}
CASES = {"dry": "lugre_steady", "lubricated": "pinkus"}
"""Crank pin -> what the independent model calls it; the balls are dry."""
LOOK = {
    "tolerance": ("exu_press, by tolerance", COLOURS["vermilion"], "o-"),
    "step": ("exu_press, fixed steps", COLOURS["blue"], "s-"),
    "Radau": ("Radau, on the independent model", COLOURS["green"], "^-"),
}
TRUE = 1e-11
Row = tuple[str, float, list[float], int, int, float]  # error by revolution, steps, evaluations, s


def independent(
    scene: Scene, pin: str, method: str, tolerance: float
) -> tuple[list[float], int, int]:
    """Return an independent run's peaks, steps and evaluations."""
    model = SymmetricPress(CASES[pin], Numbers(clearance=1e-4, speed=scene.angular_speed))
    found = model.solved(REVOLUTIONS * 60.0 / scene.speed_rpm, tolerance, method=method)
    return model.peaks(found.t, found.y), len(found.t) - 1, int(found.nfev)


def ours(scene: Scene, key: str, value: float) -> tuple[list[float], int, int]:
    """Return the peaks, steps and evaluations of a run of the package."""
    run: Result = simulate(scene.replace({f"solver.{key}": value, "revolutions": REVOLUTIONS}))
    parts = revolutions_of(run) or [run]
    found = [float(np.abs(channels["slider_acceleration"]).max()) for channels in parts]
    return found, run.info["steps"], run.info["law_evaluations"]


def rows(pin: str) -> list[Row]:
    """Return what each solver does on a press."""
    scene = Scene(joints={"crank_pin": pin, "balls": "dry"})
    if pin == "lubricated":
        scene = scene.replace({"film.law": CASES[pin]})
    true = independent(scene, pin, "LSODA", 1e-8 if OPTIONS.quick else TRUE)[0]
    print(f"\n{pin} press: true peaks {' '.join(f'{peak:.1f}' for peak in true)} m/s^2", flush=True)
    found: list[Row] = []
    for solver, values in SETTINGS.items():
        for value in values:
            begun = time.process_time()
            if solver == "Radau":
                peak, steps, evaluations = independent(scene, pin, solver, value)
            else:
                peak, steps, evaluations = ours(scene, solver, value)
            seconds = time.process_time() - begun
            off = [
                abs(computed / reference - 1.0)
                for computed, reference in zip(peak, true, strict=True)
            ]
            found.append((solver, value, off, steps, evaluations, seconds))
    return found


def table(found: list[Row]) -> str:
    """Return it in words."""
    head = "solver", "setting", "peaks off, by revolution", "steps", "evaluations"
    lines = [
        (
            solver,
            f"{value:g}",
            " ".join(f"{computed:.2%}" for computed in off),
            f"{n}",
            f"{asked}",
            f"{s:.3g}",
        )
        for solver, value, off, n, asked, s in found
    ]
    return "\n".join(columns([(*head, "processor time, s"), *lines]))


@with_style
def picture(found: dict[str, list[Row]]) -> Figure:
    """Return error over processor time, a panel a press."""
    figure = Figure(figsize=(11.0, 4.2), layout="constrained")
    for axes, (pin, lines) in zip(
        figure.subplots(1, len(found), sharex=True, sharey=True, squeeze=False)[0],
        found.items(),
        strict=True,
    ):
        for solver, (label, colour, style) in LOOK.items():
            points = [(row[-1], max(row[2])) for row in lines if row[0] == solver]
            axes.plot(*zip(*points, strict=True), style, color=colour, label=label)
        axes.set(xscale="log", yscale="log", xlabel="processor time, s")
        axes.margins(0.06, 0.08)
        axes.set_title(f"Press with a {pin} crank pin, two revolutions")
    figure.axes[0].set_ylabel("error of the peak acceleration, relative")
    figure.axes[0].legend(loc="lower left")
    return figure


done = {}
for case in [OPTIONS.pin] if OPTIONS.pin else CASES:
    done[case] = rows(case)
    print(table(done[case]), flush=True)
if OPTIONS.out:
    picture(done).savefig(OPTIONS.out, dpi=DPI)
