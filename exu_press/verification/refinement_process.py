"""A process of refinement runs: leaves the result of each in a directory."""

import gc
import os
import pickle
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from exu_press.result.run import run_once

__all__ = ["RESULT", "SCENES", "main"]

SCENES = "scenes.pickle"

RESULT = "{}.pickle"
"""File name of the result of the scene of this number."""


LATER = 10
"""By how much nicer all but the first one are to what else runs; systems without it share alike."""


def main(directory: Path, numbers: Sequence[int]) -> None:
    """Run scenes from their starts; Ctrl-C is for the run beside, which ends this process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.disable()  # a tenth of the time goes into it, and a few runs leave it next to nothing
    if hasattr(os, "nice") and 0 not in numbers:
        os.nice(LATER)
    scenes = pickle.loads((directory / SCENES).read_bytes())
    for number in numbers:
        result = directory / RESULT.format(number)
        unfinished = result.with_suffix(".unfinished")
        scene, start = scenes[number]
        unfinished.write_bytes(pickle.dumps(run_once(scene, start=start)))
        unfinished.rename(result)


if __name__ == "__main__":
    main(Path(sys.argv[1]), [int(number) for number in sys.argv[2:]])
