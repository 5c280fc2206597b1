"""Many independent runs of one function, in processes or on Dask; finished ones are never lost."""

from exu_press.parallel.run import FILE, Batch, Chain, run_batch
from exu_press.parallel.task import Row

__all__ = ["FILE", "Batch", "Chain", "Row", "run_batch"]
