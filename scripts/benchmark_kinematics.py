"""What a mechanism's ideal motion costs: a revolution in steps of half a degree.

First from the drawing, where the crank is followed and every half degree is looked at, then again.
Prints medians of processor times.
Run with: python scripts/benchmark_kinematics.py
"""

import argparse
import statistics
import time

import numpy as np

from exu_press.mechanism import SHIPPED, Press, SliderCrank, press, shipped_mechanism, slider_crank
from exu_press.mechanism.kinematics import kinematics_of

REPEATS = 15
ANGLE = np.radians(np.arange(0.0, 360.0, 0.5))


def main() -> None:
    """Print a row for each shipped mechanism."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    mechanisms = [press(Press()), slider_crank(SliderCrank()), *map(shipped_mechanism, SHIPPED)]
    print(f"{'mechanism':18}{'bodies':>7}{'first, ms':>11}{'again, ms':>11}")
    for mechanism in mechanisms:
        first, again = [], []
        for _ in range(REPEATS):
            kinematics_of.cache_clear()
            first.append(milliseconds(mechanism))
            again.append(milliseconds(mechanism))
        times = f"{statistics.median(first):11.1f}{statistics.median(again):11.1f}"
        print(f"{mechanism.name:18}{len(mechanism.bodies):7}{times}")


def milliseconds(mechanism) -> float:
    """Return the processor time of a revolution."""
    start = time.process_time()
    mechanism.motion(ANGLE, 1.0)
    return 1e3 * (time.process_time() - start)


if __name__ == "__main__":
    main()
