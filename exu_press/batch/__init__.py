"""Many independent runs of one function, in processes or on Dask; finished ones are never lost."""

from exu_press.batch.lock import locked
from exu_press.batch.run import FILE, run_batch

__all__ = ["FILE", "locked", "run_batch"]
