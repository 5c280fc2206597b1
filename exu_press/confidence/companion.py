"""A process of companion runs: leaves the result of each in a directory."""

import gc
import pickle
import signal
import sys
from pathlib import Path

from exu_press.simulation import simulate

__all__ = ["RESULT", "SCENES", "main"]

SCENES = "scenes.pickle"

RESULT = "{}.pickle"
"""Of the scene of this number."""


def main(directory: Path) -> None:
    """Run the scenes of a directory; Ctrl-C is for the run beside, which ends this process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.disable()  # a tenth of the time goes into it, and a few runs leave it next to nothing
    for number, scene in enumerate(pickle.loads((directory / SCENES).read_bytes())):
        result = directory / RESULT.format(number)
        unfinished = result.with_suffix(".unfinished")
        unfinished.write_bytes(pickle.dumps(simulate(scene)))
        unfinished.rename(result)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
