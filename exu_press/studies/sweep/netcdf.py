"""A sweep's table as a NetCDF file: one dimension, a variable a column."""

import json
from pathlib import Path

import numpy as np
from scipy.io import netcdf_file

from exu_press.files.output_directory import replacing
from exu_press.studies.sweep.table import Table
from exu_press.studies.sweep.units import meaning_of, unit_of

__all__ = ["FORMAT", "save_netcdf"]

FORMAT = "exu_press sweep 1"


def save_netcdf(table: Table, path: Path) -> None:
    """Write numbers as numbers (NaN where a run has none), everything else as text."""
    with replacing(path) as partial, netcdf_file(partial, "w", version=2) as file:
        file.format = FORMAT
        file.study = json.dumps(table.study.to_dict())
        file.createDimension("run", len(table))
        for name, values in table.columns.items():
            if table.is_numeric(name):
                variable = file.createVariable(name, "d", ("run",))
                variable[:] = table.numbers(name)
            else:
                letters = _letters(["" if value is None else str(value) for value in values])
                dimension = f"letters_{letters.shape[1]}"
                if dimension not in file.dimensions:
                    file.createDimension(dimension, letters.shape[1])
                variable = file.createVariable(name, "c", ("run", dimension))
                variable[:] = letters
                variable._Encoding = "utf-8"
            if unit_of(name):
                variable.units = unit_of(name)
            if meaning_of(name):
                variable.long_name = meaning_of(name)


def _letters(texts: list[str]) -> "np.ndarray[tuple[int, int], np.dtype[np.bytes_]]":
    """Return texts as single bytes, (texts, longest)."""
    encoded = [text.encode() for text in texts]
    longest = max(1, *(len(text) for text in encoded))
    padded = np.array([text.ljust(longest, b"\0") for text in encoded], dtype=f"S{longest}")
    return padded.view("S1").reshape(len(texts), longest)
