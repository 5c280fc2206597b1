"""Processor time of a step of the dry press, of installations of exu_press by turns.

Each time is the least of four runs over 0.06 revolutions in a process of its own. Minima count:
other work on the machine only adds to them.
Run with: python scripts/benchmark_step.py [--quick] [--repeats 10] [PYTHON ...]
PYTHON: interpreters with an installation of exu_press each; this one alone unless named.
"""

import argparse
import statistics
import subprocess
import sys

from exu_press.terminal.columns import columns

RUN = """
import time
from exu_press import Scene
times = []
for _ in range(4):
    model = Scene(joints={"crank_pin": "dry", "balls": "dry"}, revolutions=REVOLUTIONS).build()
    start = time.process_time()
    outcome = model.solve(quiet=True)
    seconds = time.process_time() - start
    times.append(seconds / (outcome.steps + outcome.rejected_steps))
print(min(times))
"""

parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
parser.add_argument("--quick", action="store_true", help="a hundredth of a revolution, twice")
parser.add_argument("--repeats", type=int, default=10)
parser.add_argument("interpreters", nargs="*", default=[sys.executable], metavar="PYTHON")
options = parser.parse_args()
program = RUN.replace("REVOLUTIONS", "0.01" if options.quick else "0.06")
times: dict[str, list[float]] = {name: [] for name in options.interpreters}
for _ in range(2 if options.quick else options.repeats):
    for name, seconds in times.items():
        command = [name, "-P", "-W", "ignore", "-c", program]
        seconds.append(float(subprocess.run(command, check=True, capture_output=True).stdout))
first = times[options.interpreters[0]]
rows = [("installation", "minimum, us", "median, us", "over the first: minimum", "median")]
for number, seconds in enumerate(times.values()):
    least, median = min(seconds), statistics.median(seconds)
    ratios = least / min(first), median / statistics.median(first)
    figures = f"{1e6 * least:.1f}", f"{1e6 * median:.1f}", *(f"{ratio:.2f}" for ratio in ratios)
    rows.append((str(number), *figures))
print("\n".join(columns(rows)))
