"""What a sweep loses on the way: the same runs in one process and in a sweep's workers.

Efficiency is the time of one process over workers times the sweep's. One process has everything
loaded when the clock starts; the workers load it within their time. On a busy machine only the
processor's time tells anything.

Run with: python scripts/benchmark_sweep.py [--quick]
"""

import argparse
import os
import tempfile

from exu_press import Scene
from exu_press.studies.base import run_scene
from exu_press.studies.sweep import Sweep, sweep

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--quick", action="store_true", help="two short runs")
quick = parser.parse_args().quick
clearances = [(50 + n) * 1e-6 for n in range(2 if quick else 48)]
scene = Scene(joints={"crank_pin": "lubricated"}, revolutions=0.05 if quick else 8.0)
study = Sweep(scene=scene, keys={"joints.crank_pin.clearance": clearances})


def in_one_process():
    for each in study.scenes:
        run_scene({"scene": each.to_dict()})


def with_workers(workers):
    with tempfile.TemporaryDirectory() as directory:
        sweep(study, directory, workers=workers)


def cost(function, *arguments):
    """Return elapsed and processor time, s, of this process and of those it started."""
    before = os.times()
    function(*arguments)
    after = os.times()
    return after.elapsed - before.elapsed, sum(after[:4]) - sum(before[:4])


run_scene({"scene": study.scenes[0].to_dict()})
one, cpu = cost(in_one_process)
print(f"{len(study.scenes)} runs, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")
print(f"{'':18} {'s':>8} {'s per run':>10} {'cpu, s':>8} {'efficiency':>11}")
print(f"{'one process':18} {one:8.2f} {one / len(study.scenes):10.3f} {cpu:8.2f} {1:11.2f}")
for workers in (1, 2):
    taken, cpu = cost(with_workers, workers)
    name = f"sweep, {workers} worker{'s' if workers > 1 else ''}"
    each = taken / len(study.scenes)
    print(f"{name:18} {taken:8.2f} {each:10.3f} {cpu:8.2f} {one / workers / taken:11.2f}")
