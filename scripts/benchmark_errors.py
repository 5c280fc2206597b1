"""What stated errors cost: a run with its refinements beside it over the same run alone.

    python scripts/benchmark_errors.py [--repeats 3]

Wall time needs two cores that nobody else uses; processor time is what both processes took
together, and is right on a busy machine too.
"""

import argparse
import os
import statistics
import sys
import time
from collections.abc import Callable

from exu_press import Result, Scene, simulate
from exu_press.scene import flexible_press

SCENES = {
    "press, two revolutions": Scene(),
    "press, dry pin, two revolutions": Scene(joints={"crank_pin": "dry", "balls": "dry"}),
    "press, ideal joints, two revolutions": Scene(joints={}),
    "slider-crank, ten revolutions": Scene(mechanism="slider_crank", revolutions=10.0),
    "slider-crank, dry pin, one revolution": Scene(
        mechanism="slider_crank", joints={"crank_pin": "dry"}, revolutions=1.0
    ),
    "press, flexible, half a revolution": Scene(bodies=flexible_press(), revolutions=0.5),
}

AIM = 1.5
"""Of the wall times' ratio on two cores."""


def times() -> tuple[float, float]:
    """Return wall and processor time, s; of processes that have ended, too."""
    spent = os.times()
    return time.perf_counter(), sum(spent[:4])


def taken(run: Callable[[Scene], Result], scene: Scene) -> tuple[float, float]:
    """Run a scene and return what it took, wall and processor time, s."""
    before = times()
    if not run(scene).completed:
        raise SystemExit("a run stopped early")
    wall, processor = (b - a for a, b in zip(before, times(), strict=True))
    return wall, processor


def with_errors(scene: Scene) -> Result:
    return simulate(scene, errors=True)


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeats", type=int, default=3, help="the median counts")
    options = parser.parse_args(arguments)
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    print(f"{os.cpu_count()} cores, load {load:.1f}; wall time's ratio is aimed at {AIM}")
    print(f"{'':38}  alone: wall, processor, s  with errors   ratios: wall, processor")
    for name, scene in SCENES.items():
        simulate(scene.replace({"revolutions": 0.01}))  # what is imported and compiled once
        pairs = [(taken(simulate, scene), taken(with_errors, scene))
                 for _ in range(options.repeats)]  # fmt: skip
        alone, told = (
            [statistics.median(pair[which][kind] for pair in pairs) for kind in (0, 1)]
            for which in (0, 1)
        )
        ratios = [b / a for a, b in zip(alone, told, strict=True)]
        print(
            f"{name:38}  {alone[0]:11.2f} {alone[1]:13.2f}  {told[0]:5.2f} {told[1]:5.2f}"
            f"  {ratios[0]:12.2f} {ratios[1]:9.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
