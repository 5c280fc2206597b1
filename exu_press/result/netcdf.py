"""A result as a NetCDF file: units and names as attributes, the complete scene inside."""

import json
import warnings
from pathlib import Path

import numpy as np
from scipy.io import netcdf_file

from exu_press.errors import InputError
from exu_press.output import replacing
from exu_press.result.result import AXES, Channel, Result
from exu_press.result.surface import ARRAYS, Surface
from exu_press.scene import Scene

__all__ = ["is_whole", "read", "write"]

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
            if channel.axis and channel.axis not in AXES:
                file.createDimension(channel.axis, channel.values.shape[-1])
            variable = file.createVariable(name, "d", ("time", *inner, *outer))
            variable[:] = channel.values
            variable.units = channel.unit
            variable.long_name = channel.long_name
        for body, surface in result.surfaces.items():
            _write_surface(file, body, surface)


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
                    "" if variable.dimensions[-1] == "time" else variable.dimensions[-1],
                )
                for name, variable in file.variables.items()
                if variable.dimensions[0] == "time"
            }
            return Result(
                scene=Scene.from_dict(json.loads(file.scene)),
                channels=channels,
                info=json.loads(file.info),
                bodies=tuple(json.loads(file.bodies)),
                surfaces=_surfaces(file),
            )
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error})") from None
    except (TypeError, ValueError, AttributeError, KeyError, IndexError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{path}: not a result of exu_press") from None


def is_whole(path: Path) -> bool:
    """Return whether a result's file is there and of the length that its head tells.

    Only the head is read.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # of views that are gone by then
            netcdf_file(path, "r", mmap=True).close()
    except (OSError, TypeError, ValueError, IndexError):
        return False
    return True


def _write_surface(file: netcdf_file, body: str, surface: Surface) -> None:
    """Write the arrays of a flexible body's surface; dimensions that the bodies share once."""
    for array, (axes, unit, words) in ARRAYS.items():
        values = getattr(surface, array)
        if not len(values):
            continue  # no stresses
        shared = ("space", "corner", "stress")
        names = tuple(axis if axis in shared else f"{body}_{axis}" for axis in axes)
        for name, length in zip(names, values.shape, strict=True):
            if name not in file.dimensions:
                file.createDimension(name, length)
        variable = file.createVariable(f"{body}_surface_{array}", values.dtype.char, names)
        variable[:] = values
        variable.units = unit
        variable.long_name = f"{body}: {words}"


def _surfaces(file: netcdf_file) -> dict[str, Surface]:
    """Return the surfaces in a file, by body."""
    suffix = "_surface_nodes"
    surfaces = {}
    for name in file.variables:
        if name.endswith(suffix):
            body = name.removesuffix(suffix)
            stored = {
                array: np.array(file.variables[f"{body}_surface_{array}"][:])
                for array in ARRAYS
                if f"{body}_surface_{array}" in file.variables
            }
            modes = stored["modes"].shape[-1]
            stored.setdefault("stress", np.zeros((0, 6, modes), dtype=np.float32))
            native = {k: v.astype(v.dtype.newbyteorder("=")) for k, v in stored.items()}
            surfaces[body] = Surface(**native)
    return surfaces
