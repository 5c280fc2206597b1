"""Many independent runs of one function, in processes or on Dask; finished ones are never lost."""

from exu_press.batch.lock import locked
from exu_press.batch.run import FILE, Batch, run_batch
from exu_press.batch.task import Row

__all__ = ["FILE", "Batch", "Row", "locked", "run_batch"]
