"""The process of companion runs: leaves the result of each in a directory."""

import pickle
import signal
import sys
from pathlib import Path

from exu_press.simulation import simulate

__all__ = ["SCENES", "main"]

SCENES = "scenes.pickle"


def main(directory: Path) -> None:
    """Run every scene; Ctrl-C is for the run beside, which ends this process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number, scene in enumerate(pickle.loads((directory / SCENES).read_bytes())):
        (directory / f"{number}.pickle").write_bytes(pickle.dumps(simulate(scene)))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
