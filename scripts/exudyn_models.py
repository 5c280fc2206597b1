"""How well `solve_dynamic` does in the place of `SolveDynamic`, in all of Exudyn's own scripts.

Takes the folder of a checkout of github.com/jgerstmayr/EXUDYN, and runs every script of
main/pythonDev/Examples and TestModels that solves a motion with an implicit solver, up to the end
of the first one: with the user's own steps, with two finer ones as references, with a tolerance
and steps of at most a hundredth of the run, and with the tolerance and the user's steps as the
largest. Each run is a process of its own. One of less than a second is run five times, and the
least of its processor times counts, as a shared machine may be half as fast for tenths of a second.
Of scripts that vary parameters, the first ones count. What older scripts call by names that the
installed Exudyn has no longer is put back. What is in OUT is not run again. A run with a tolerance
may take ten times the user's own processor time, and the limit on top: what takes longer is far
slower than fixed steps. All runs but coarser ones call a pre-step function on the grid of the
user's steps, as it is a part of the system, and let numbers that it sets go over from call to call.

With --equal-error, processor time is also compared with that of the fixed step of the same error,
between a 64th of the user's steps and the references.

Error: of velocities in the kinetic norm over the motion's largest speed, the worst of 20 instants;
the references' own error is what they differ by.
Run with: python scripts/exudyn_models.py CHECKOUT OUT [--only NAME ...] [--tolerance 1e-3]
"""

import argparse
import contextlib
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np

from exudyn_models.table import ENDED, Model, table
from fe_models.processes import ONE_THREAD

FOLDERS = "main/pythonDev/Examples", "main/pythonDev/TestModels"
HERE = Path(__file__).parent
ONE_RUN = HERE / "exudyn_models" / "one_run.py"
BUSY = 2.0
"""Times the limit, after which a run is ended on a machine with other work."""

BRIEF = 1.0
"""Processor time, s, below which a run is timed again, as much else may have happened in it."""

TIMINGS = 5
"""Of a brief run, of which the least counts."""

SLOWER = 10.0
"""Times the user's own processor time: what a run with a tolerance may take more than the limit."""

FINER = (16, 8, 4, 2, 1, 0.5)
COARSER = (1 / 64, 1 / 16, 1 / 4)
"""Of the user's number of steps: how few have the error of a tolerance."""


def run(script, variant, file, limit):
    """Run a script, unless that has been done, and return what it did."""
    if file.exists():
        return load(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    found = once(script, variant, file, limit)
    timed = not variant.get("errors")
    if timed and found["status"] in ENDED and found["seconds"] < BRIEF:
        timings = [once(script, variant, file, limit)["seconds"] for _ in range(TIMINGS - 1)]
        found["seconds"] = min(found["seconds"], *timings)
    if found.get("seconds", 0.0) > limit:  # what is not solved by an implicit solver has none
        found["status"] = "time limit"
    arrays = {name: value for name, value in found.items() if isinstance(value, np.ndarray)}
    told = {name: value for name, value in found.items() if name not in arrays}
    np.savez(file, found=json.dumps(told), **arrays)
    return found


def once(script, variant, file, limit):
    """Run a script in a process of its own, and return what it did."""
    file.unlink(missing_ok=True)
    said, status = "", "crashed"
    paths = os.pathsep.join(filter(None, (str(HERE), os.environ.get("PYTHONPATH"))))
    one = subprocess.Popen(
        [sys.executable, ONE_RUN, script, json.dumps(variant), file],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        # NumPy's other threads spin while they wait, a tenth of a second behind an import, which
        # doubled the processor time of what was solved meanwhile; and there may be no screen
        env={**os.environ, **ONE_THREAD, "PYTHONPATH": paths, "MPLBACKEND": "Agg"},
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        said = (one.communicate(timeout=BUSY * limit)[1].strip().splitlines() or [""])[-1]
    except subprocess.TimeoutExpired:
        status = "time limit"
    with contextlib.suppress(ProcessLookupError):  # what the script has started itself
        os.killpg(one.pid, signal.SIGKILL)
    if file.exists():
        return load(file)
    return {"status": status, "reason": said[:300], "seconds": limit, "rows": np.zeros(0)}


def load(file):
    """Return what is kept of a run."""
    with np.load(file) as kept:
        arrays = {name: kept[name] for name in kept.files}
    return {**json.loads(str(arrays.pop("found"))), **arrays}


def references(script, folder, user, limit):
    """The user's run, and two runs with finer steps, as fine as the time allows."""
    if user["status"] != "completed":
        return None
    for times in FINER:
        if user["seconds"] * times < 0.5 * limit:
            two = [
                run(script, {"times": part}, folder / f"fixed_{part:g}.npz", limit)
                for part in (times, times / 2)
            ]
            if two[0].get("steps") == two[1].get("steps"):  # so few that both have one a sample
                return None
            if all(one["status"] == "completed" for one in two):
                return two
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("checkout", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", nargs="*", default=[], help="names of scripts")
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--limit", type=float, default=20.0, help="processor time of each run, s")
    parser.add_argument("--again", action="store_true", help="run what has a tolerance again")
    parser.add_argument("--equal-error", action="store_true", help="with coarser fixed steps too")
    parser.add_argument("--drop-in", action="store_true", help="with the user's steps as well")
    parser.add_argument("--errors", action="store_true", help="with the errors that runs state")
    options = parser.parse_args()
    scripts = [path for folder in FOLDERS for path in (options.checkout / folder).glob("*.py")]
    models = []
    for script in sorted(scripts, key=lambda path: path.stem):
        if options.only and script.stem not in options.only:
            continue
        if "SolveDynamic" not in script.read_text(encoding="utf-8", errors="replace"):
            continue
        folder = options.out.resolve() / script.stem
        user = run(script.resolve(), {"times": 1}, folder / "fixed_1.npz", options.limit)
        fine = references(script.resolve(), folder, user, options.limit)
        if user["status"] in ("explicit", "no dynamic solution"):
            continue
        variants = {"tolerance": {"tolerance": options.tolerance, "steps": 100}}
        if options.drop_in:
            variants["drop_in"] = {"tolerance": options.tolerance}
        if options.errors and Model(script.stem, user, fine, {}).agree():
            variants["errors"] = {**variants["tolerance"], "errors": True}
        runs = {}
        for name, variant in variants.items():
            file = folder / f"{name}_{options.tolerance:g}.npz"
            if options.again:
                file.unlink(missing_ok=True)
            if fine:
                limit = options.limit + SLOWER * user["seconds"]
                runs[name] = run(script.resolve(), variant, file, limit)
        coarse = [
            run(script.resolve(), {"times": part}, folder / f"fixed_{part:g}.npz", options.limit)
            for part in COARSER
            if fine and options.equal_error
        ]
        models.append(Model(script.stem, user, fine, runs, coarse))
        if fine:
            print(models[-1].line(options.tolerance), flush=True)
    print(table(models, options.tolerance))


if __name__ == "__main__":
    main()
