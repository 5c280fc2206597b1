"""A result as a NetCDF file: units and names as attributes, the complete scene inside."""

import json
from pathlib import Path

import numpy as np
from scipy.io import netcdf_file

from exu_press.errors import InputError
from exu_press.output import replacing
from exu_press.result.result import AXES, Channel, Result
from exu_press.scene import Scene

__all__ = ["read", "write"]

FORMAT = "exu_press result 1"


def write(result: Result, path: Path) -> None:
    """Write to a temporary name beside `path`, then rename: no half file is ever left there."""
    with replacing(path) as partial, netcdf_file(partial, "w", version=2) as file:
        file.format = FORMAT
        file.scene = json.dumps(result.scene.to_dict())
        file.info = json.dumps(result.info)
        file.bodies = json.dumps(result.bodies)
        file.createDimension("time", len(result.time))
        for axis, columns in AXES.items():
            if columns:
                file.createDimension(axis, len(columns))
        if result.bodies:
            file.createDimension("body", len(result.bodies))
        for name, channel in result.channels.items():
            inner = ("body",) if channel.values.ndim == 3 else ()
            outer = (channel.axis,) if channel.axis else ()
            variable = file.createVariable(name, "d", ("time", *inner, *outer))
            variable[:] = channel.values
            variable.units = channel.unit
            variable.long_name = channel.long_name


def read(path: Path) -> Result:
    """Return the result in a file."""
    try:
        with netcdf_file(path, "r", mmap=False) as file:
            if getattr(file, "format", b"").decode() != FORMAT:
                raise InputError(f"{path}: not a result of exu_press")
            channels = {
                name: Channel(
                    np.array(variable[:], dtype=float),
                    variable.units.decode(),
                    variable.long_name.decode(),
                    variable.dimensions[-1] if variable.dimensions[-1] in AXES else "",
                )
                for name, variable in file.variables.items()
            }
            return Result(
                scene=Scene.from_dict(json.loads(file.scene)),
                channels=channels,
                info=json.loads(file.info),
                bodies=tuple(json.loads(file.bodies)),
            )
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error})") from None
    except (TypeError, ValueError, AttributeError, KeyError, IndexError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: not a result of exu_press") from None
