"""How `solve_dynamic` does on Exudyn's own scripts, which it solves by refinement.

DIR has scripts, in folders too; main/pythonDev of a checkout of github.com/jgerstmayr/EXUDYN has
Examples and TestModels. Each script runs in a process of its own up to its first dynamic solution.
Copies of that process then solve it: by `solve_dynamic` (60 s of processor time), with 8 and 16
times the script's own number of steps as the reference, and with a ladder of doubled numbers of
steps from the coarsest level on, of which the smallest sufficient one is the measure of cost
(240 s, both together). What takes longer is counted apart. Rows are kept in OUT, one file a script,
and are not computed again.

Errors are those that `solve_dynamic` bounds: the largest of all its relative norms.
Run with: python scripts/exudyn_examples.py DIR [--out OUT] [--tolerance 1e-3] [--only NAME ...]
"""

import argparse
import contextlib
import json
import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from exudyn_scripts.totals import OVER, line, totals
from fe_models.processes import ONE_THREAD

HERE = Path(__file__).parent
ONE_SCRIPT = HERE / "exudyn_scripts" / "one_script.py"
LIMITS = 60.0, 240.0
"""Processor time of a script's refinement, and of its reference and ladder, s."""

BUSY = 20.0
"""Elapsed time over processor time, after which a script is ended on a machine with other work."""


def row_of(script, out, tolerance, limits):
    """Return the row of a script; a kept one is read, if it was not cut off by lower limits."""
    file = out / f"{script.parent.name}_{script.stem}.json"
    row = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    cut_off = OVER in (row.get("status"), row.get("reference"))
    if not row or (cut_off and row["limits"] < limits):
        file.unlink(missing_ok=True)
        run(script, file, tolerance, limits)
        row = {"status": "crashed", "reason": "the script itself"}
        if file.exists():
            row = json.loads(file.read_text(encoding="utf-8"))
        row |= {"name": script.stem, "limits": limits}
        file.write_text(json.dumps(row), encoding="utf-8")
    return row


def run(script, file, tolerance, limits):
    """Run a script in a process of its own."""
    paths = os.pathsep.join(filter(None, (str(HERE), os.environ.get("PYTHONPATH"))))
    numbers = (str(number) for number in (tolerance, *limits))
    process = subprocess.Popen(
        [sys.executable, ONE_SCRIPT, script, *numbers, file],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, **ONE_THREAD, "PYTHONPATH": paths, "MPLBACKEND": "Agg"},
        start_new_session=True,
    )
    try:
        process.wait(timeout=BUSY * sum(limits))
    except subprocess.TimeoutExpired:
        file.write_text(json.dumps({"status": OVER}), encoding="utf-8")
    with contextlib.suppress(ProcessLookupError):  # what the script has started itself
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--out", type=Path, default=Path("out/exudyn_examples"))
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--only", nargs="*", default=[], help="names of scripts")
    parser.add_argument("--workers", type=int, default=1, help="scripts at a time")
    parser.add_argument("--limits", type=float, nargs=2, default=LIMITS, help="processor time, s")
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    scripts = [
        path.resolve()
        for path in sorted(options.folder.rglob("*.py"), key=lambda path: path.stem)
        if "SolveDynamic" in path.read_text(encoding="utf-8", errors="replace")
        and (not options.only or path.stem in options.only)
    ]

    def solve(script):
        return row_of(script, out, options.tolerance, list(options.limits))

    rows = []
    with ThreadPoolExecutor(options.workers) as pool:
        for row in pool.map(solve, scripts):
            rows.append(row)
            print(line(row, options.tolerance), flush=True)
    print("\n".join(["", *totals(rows, options.tolerance)]))


if __name__ == "__main__":
    main()
