"""How well Exudyn's own examples follow the tolerance, and what that costs against fixed steps.

Prints for each example and tolerance: the error over the tolerance, the steps, and the run time of
the best fixed step of Exudyn's own that has the same error, over that of `solve_dynamic`. Errors:
of velocities (impacts: of positions) over the whole run, against a tolerance ten times finer than
the finest. Run with: python scripts/examples_error.py [--quick] [--only NAME]
"""

import argparse
import sys
import time as clock

import exudyn
import numpy as np

from exu_press import SolverStatus
from exudyn_examples import EXAMPLES
from exudyn_examples.measure import at_equal_error, error, run

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
ENDED = SolverStatus.COMPLETED, SolverStatus.UNDER_RESOLVED
FIXED = [100 * 4**k for k in range(6)]  # numbers of fixed steps


def timed(example, **keys):
    """Run time of an example alone, s: the least of three."""
    times = []
    for _ in range(3):
        begun = clock.perf_counter()
        seconds = run(example, record=False, **keys).seconds
        times.append(seconds)
        if clock.perf_counter() - begun > 1.0:
            break
    return min(times)


def fixed_steps(example, end, fine, least):
    """Errors and run times with fixed steps, finer and finer until the error is the least."""
    found = []
    for steps in FIXED:
        try:
            done = run(example, steps=steps, end=end)
        except exudyn.ExudynError:  # steps too long for Newton's method
            continue
        missed = error(done, fine, example.positions) if done.outcome else np.inf
        if np.isfinite(missed):
            found.append((missed, timed(example, steps=steps, end=end)))
        if missed < least:
            break
    return found


def cell(done, missed, tolerance, faster):
    if done.outcome.status not in ENDED:
        return f"{done.outcome.status.value:>22s}"
    gain = "      " if np.isnan(faster) else f"{faster:5.1f}x"
    return f"{missed / tolerance:8.2g} {done.steps:6d} {gain}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="short runs, three tolerances")
    parser.add_argument("--only", choices=[*EXAMPLES], help="one example")
    options = parser.parse_args()
    exudyn.config.printToConsole = (
        False  # where a contact has changed it says so, many times a step
    )
    tolerances = TOLERANCES[:3] if options.quick else TOLERANCES
    print("error over tolerance, steps, run time of the best fixed step of equal error over this")
    print(f"{'':20s}" + "".join(f"{t:>23g}" for t in tolerances))
    for name, example in EXAMPLES.items():
        if options.only not in (None, name):
            continue
        end = example.short if options.quick else example.end
        its = [t for t in tolerances if t >= example.finest]
        fine = run(EXAMPLES[example.twin or name], tolerance=0.1 * its[-1], end=end)
        if fine.outcome.status not in ENDED:
            sys.exit(f"{name}: no reference: {fine.outcome.reason}")
        runs = [run(example, tolerance=t, end=end) for t in its]
        errors = [error(done, fine, example.positions) for done in runs]
        found = fixed_steps(example, end, fine, min(errors))
        line = f"{name:20s}"
        for done, missed, tolerance in zip(runs, errors, its, strict=True):
            faster = at_equal_error(found, missed) / timed(example, tolerance=tolerance, end=end)
            line += " " + cell(done, missed, tolerance, faster)
        print(line, flush=True)


if __name__ == "__main__":
    main()
