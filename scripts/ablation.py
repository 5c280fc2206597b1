"""What every tuned number of the integration buys: each is halved and doubled, and rules are off.

For a set of scenes, prints how much the error and the work change against the defaults. Error: of
the output's velocity over the whole run, against a tolerance thirty times finer, over its largest
value. Work: Newton iterations, which no busy machine changes.
Run with: python scripts/ablation.py [--quick] [--tolerance 1e-3] [--minutes 20]
"""

import argparse
import dataclasses
import math
import time
import warnings
from collections.abc import Iterator

import numpy as np

from exu_press import Scene, SolverStatus, SolverTuning
from exu_press.integrate import Outcome
from exu_press.mechanism.press import PAPER_LAWS
from exu_press.numerics.arrays import Array
from exu_press.scene import flexible_press

GRID = 4000  # instants at which runs are compared
FINER = 1.0 / 30.0
BUDGET = 10_000  # steps; a variant that needs more counts as stopped

OFF = {
    "factor_max": 1e9,
    "penetration": 1e9,
    "modal_mass": 0.0,
    "refit": 0.0,
    "max_extrapolation": 0.0,
    "rounding": 0.0,
}
"""Numbers at which their rule does nothing."""

NOT_OF_A_STEP = "largest_jump", "fixed_steps", "coverage"
"""Numbers that judge or state a run and change none by tolerance."""

DRY = {"crank_pin": "dry", "balls": "dry"}
SCENES = {
    "press ideal": {"joints": {}, "revolutions": 0.3},
    "press lubricated": {"revolutions": 0.08},
    "press dry": {"joints": DRY, "revolutions": 0.04},
    "press flexible": {"bodies": flexible_press(modes=4), "revolutions": 0.02},
    "slider-crank dry": {
        "mechanism": "slider_crank",
        "joints": {"crank_pin": "dry"},
        "revolutions": 0.08,
        "contact": PAPER_LAWS["contact"],
        "friction": PAPER_LAWS["friction"],
    },
    "four-bar lubricated": {
        "mechanism": "four_bar",
        "joints": {"crank_pin": {"kind": "lubricated", "clearance": 1e-4, "radius": 0.07}},
        "film": {"viscosity": 0.4, "length": 0.1},
        "revolutions": 0.1,
    },
}

Run = tuple[Array, Array, Outcome]
"""Time, output velocity and how the run ended."""


def run(name: str, tolerance: float, tuning: SolverTuning) -> Run:
    """Run a scene with a tolerance and tuned numbers."""
    solver = {"tolerance": tolerance, "max_steps": BUDGET}
    model = Scene.from_dict({**SCENES[name], "solver": solver}).build()
    try:
        outcome = model.solve(tuning=tuning)
        sensor = model.sensors[model.mechanism.slider, "velocity"]
        record = np.array(model.mbs.GetSensorStoredData(sensor))
    finally:
        model.SC.Reset()
    moving = 1 + int(np.argmax(np.abs(record[:, 1:]).max(axis=0)))
    return record[:, 0], record[:, moving], outcome


def error_of(tried: Run, reference: Run) -> float:
    """Return the largest difference of the outputs over the largest one, infinite after a stop."""
    (instants, values, outcome), (fine_instants, fine, _) = tried, reference
    if outcome.status not in (SolverStatus.COMPLETED, SolverStatus.UNDER_RESOLVED):
        return math.inf
    grid = np.linspace(0.0, fine_instants[-1], GRID)
    difference = np.interp(grid, instants, values) - np.interp(grid, fine_instants, fine)
    return float(np.abs(difference).max() / np.abs(fine).max())


def variants() -> Iterator[tuple[str, SolverTuning]]:
    """Yield the name and the numbers of every variant."""
    defaults = SolverTuning()
    for field in dataclasses.fields(SolverTuning):
        if field.name in NOT_OF_A_STEP:
            continue
        value = getattr(defaults, field.name)
        for word, factor in (("half", 0.5), ("double", 2.0)):
            changed = type(value)(value * factor)
            if field.name == "factor_max":
                changed = 1.0 + (value - 1.0) * factor
            yield f"{field.name} {word}", dataclasses.replace(defaults, **{field.name: changed})
        if field.name in OFF:
            off = dataclasses.replace(defaults, **{field.name: OFF[field.name]})
            yield f"{field.name} off", off


def main() -> None:
    """Print the table, a row a variant: error and work over those of the defaults."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="two scenes, four variants")
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--minutes", type=float, default=20.0, help="no variant begins later")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    until = time.monotonic() + 60.0 * options.minutes
    names = list(SCENES)[:: 5 if options.quick else 1]
    chosen = list(variants())[: 4 if options.quick else None]
    width = max(len(name) for name, _ in chosen) + 2
    defaults = SolverTuning()
    references = {name: run(name, FINER * options.tolerance, defaults) for name in names}
    usual = {name: run(name, options.tolerance, defaults) for name in names}
    usual_errors = {name: error_of(usual[name], references[name]) for name in names}
    work = {name: usual[name][2].newton_iterations for name in names}
    print(f"tolerance {options.tolerance:g}; error | work, over those of the defaults")
    print(" " * width + "".join(f"{name:>20}" for name in names))
    cells = [f"{usual_errors[name]:.1e} | {work[name]}" for name in names]
    print(f"{'defaults':{width}}" + "".join(f"{cell:>20}" for cell in cells), flush=True)
    for label, tuning in chosen:
        if time.monotonic() > until:
            print(f"{label} and further ones: not begun within {options.minutes:g} minutes")
            return
        cells = []
        for name in names:
            tried = run(name, options.tolerance, tuning)
            error = error_of(tried, references[name]) / usual_errors[name]
            effort = tried[2].newton_iterations / work[name]
            cells.append("stopped" if error == math.inf else f"{error:.2f} | {effort:.2f}")
        print(f"{label:{width}}" + "".join(f"{cell:>20}" for cell in cells), flush=True)


if __name__ == "__main__":
    main()
