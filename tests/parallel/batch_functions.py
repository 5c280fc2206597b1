"""What the tests of batches run in workers; their modules import it from here, as workers do."""

import math
import os
import resource
import signal
import time
from pathlib import Path


def digits(arguments):
    """Numbers whose last bits show any difference."""
    value = math.sin(arguments["x"] + 0.1)
    return {"x": arguments["x"], "value": value / 3.0, "many": [value**n for n in range(1, 4)]}


def slow_digits(arguments):
    """The same, not at once, leaving a mark of every call."""
    with Path(arguments["marks"]).open("a") as file:
        file.write(f"{arguments['x']} {os.getpid()}\n")
    time.sleep(0.05)
    return digits(arguments)


def marks(path):
    """Return (argument, process) of every call of slow_digits."""
    return [tuple(map(int, line.split())) for line in Path(path).read_text().splitlines()]


def nothing_finite(arguments):
    import numpy as np  # a fifth of a second for each of many workers

    return {
        "nan": math.nan,
        "list": [1.0, math.inf],
        "inner": {"value": -math.inf},
        "numpy": np.float64(0.1),
        "whole": np.int64(3),
        "array": np.array([0.5, np.nan]),
    }


def raises(arguments):
    raise ValueError("no\nnumber")


def no_json(arguments):
    return {"file": Path()}


def own_status(arguments):
    return {"status": "film broke down", "reason": "at 0.1 s"}


def sleeps(arguments):
    """Sleep as long as told; do not notice signals, as compiled code does not."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    time.sleep(arguments["seconds"])
    return {"slept": arguments["seconds"]}


def dies(arguments):
    os.kill(os.getpid(), signal.SIGKILL)


def dies_once(arguments):
    mark = Path(arguments["mark"])
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGSEGV)
    return {"x": arguments["x"]}


def exits(arguments):
    os._exit(7)


def prints(arguments):
    """Write where the answers would go, from Python and from below it."""
    print("{}", flush=True)
    os.write(1, b'{"status": "forged"}\n')
    return {"x": 1}


def threads(arguments):
    return {"omp": os.environ["OMP_NUM_THREADS"], "blas": os.environ["OPENBLAS_NUM_THREADS"]}


def performs(arguments):
    """Perform the function of this module that the arguments name."""
    return globals()[arguments["function"]](arguments)


def memory(arguments):
    """Peak memory of the worker, MB."""
    return {"megabytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, "x": arguments}


def waits(arguments):
    """Leave a mark; then wait until another file has so many lines, if told to."""
    with Path(arguments["marks"]).open("a") as file:
        file.write(f"{arguments['x']} {os.getpid()}\n")
    end = time.monotonic() + 20.0
    while "file" in arguments and time.monotonic() < end:
        path = Path(arguments["file"])
        if path.exists() and len(path.read_text().splitlines()) >= arguments["lines"]:
            break
        time.sleep(0.01)
    else:
        if "file" in arguments:
            raise TimeoutError("waited in vain")
    return {"x": arguments["x"], "sum": arguments["x"] + arguments.get("before", 0)}
