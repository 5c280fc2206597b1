"""A result as a NetCDF file, or as a dataset of xarray: units and names, and the scene."""

import json
import stat
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError, error_prefix, required_package
from exu_press.files.file_format import NewerFormatError, refuse_newer_format
from exu_press.files.output_directory import replacing
from exu_press.numerics.arrays import checksum
from exu_press.result.channel import AXES, Channel
from exu_press.result.contents import Contents
from exu_press.result.info import Info
from exu_press.result.surface import ARRAYS, Surface
from exu_press.scene import Scene
from exu_press.schema.stored import from_json, short_text

if TYPE_CHECKING:
    from scipy.io import netcdf_file

__all__ = ["dataset", "is_whole", "read", "read_text", "write", "write_checksums"]

Kind = TypeVar("Kind", bound=Contents)
Number = TypeVar("Number", bound=np.generic)

FORMAT = "exu_press result 2"

CHECKSUM = "checksum"
"""Attribute of a variable, whose bytes it belongs to, and of a file, whose header it belongs to."""

SAMPLE, AT_SAMPLES = "sample", "_at_samples"
"""Dimension of the samples, and the end of the names of channels over it."""


def write(result: Contents, path: Path, **more: str) -> None:
    """Write to a temporary name beside `path`, then rename: no half file is ever left there."""
    from scipy.io import netcdf_file  # takes longer to load than a short run

    with replacing(path) as partial, netcdf_file(partial, "w", version=2) as file:
        file.format = FORMAT
        file.scene = json.dumps(result.scene.to_dict())
        file.asked = json.dumps(sorted(result.scene.asked))
        file.info = json.dumps(result.info)
        file.bodies = json.dumps(result.bodies)
        file.createDimension("time", len(result.channels["time"].values))
        for axis, columns in AXES.items():
            if columns:
                file.createDimension(axis, len(columns))
        if result.bodies:
            file.createDimension("body", len(result.bodies))
        for name, channel in result.channels.items():
            _write_channel(file, name, "time", channel)
        if result.sampled:
            file.createDimension(SAMPLE, len(result.sampled["time"].values))
        for name, channel in result.sampled.items():
            _write_channel(file, name + AT_SAMPLES, SAMPLE, channel)
        for body, surface in result.surfaces.items():
            _write_surface(file, body, surface)
        for name, text in more.items():
            setattr(file, name, text)
        write_checksums(file)


def write_checksums(file: "netcdf_file") -> None:
    """Write a checksum of each variable, and one of all that is no value."""
    for variable in file.variables.values():
        variable.checksum = f"{checksum(variable.data):08x}"
    file.checksum = _header_checksum(file)


def _header_checksum(file: "netcdf_file") -> str:
    """Return the CRC-32 of a header's texts, names, types and sizes, 8 hexadecimal digits."""

    def texts(owner: Any) -> dict[str, str]:
        """Return the texts of the file or of a variable as they are stored."""
        return {name: text.decode("latin-1") or "\0" for name, text in _texts(owner).items()}

    variables = {
        name: (
            [*zip(variable.dimensions, variable.shape, strict=True)],
            texts(variable),
            variable.data.dtype.str,
        )
        for name, variable in file.variables.items()
    }
    whole = {name: text for name, text in texts(file).items() if name != CHECKSUM}
    return f"{zlib.crc32(json.dumps([whole, variables], sort_keys=True).encode()):08x}"


def _texts(owner: Any) -> dict[str, bytes]:
    """Return the texts of a file or a variable, not decoded; empty ones for numbers."""
    encoded = {
        name: value.encode() if isinstance(value, str) else value
        for name, value in owner._attributes.items()
    }
    return {name: text if isinstance(text, bytes) else b"" for name, text in encoded.items()}


def _write_channel(file: "netcdf_file", name: str, along: str, channel: Channel) -> None:
    """Write a channel over time, or over the samples."""
    inner = ("body",) if channel.values.ndim == 3 else ()
    outer = (channel.axis,) if channel.axis else ()
    if channel.axis and channel.axis not in file.dimensions:
        file.createDimension(channel.axis, channel.values.shape[-1])
    variable = file.createVariable(name, "d", (along, *inner, *outer))
    variable[:] = channel.values
    variable.units = channel.unit
    variable.long_name = channel.long_name


def read(path: Path, kind: type[Kind]) -> Kind:
    """Return the result in a file, as an object of this kind.

    Raises:
        InputError: it cannot be read, is no result, is damaged, or a later version's.
    """
    try:
        with _open_checked(path) as file:
            scene = from_json(dict[str, Any], _text(file, "scene"), "scene")
            asked = from_json(list[str], _text(file, "asked"), "asked")
            return kind(
                scene=Scene.from_result(scene, asked),
                channels=_channels(file, "time"),
                info=from_json(Info, _text(file, "info"), "info"),
                bodies=from_json(tuple[str, ...], _text(file, "bodies"), "bodies"),
                surfaces=_surfaces(file),
                sampled=_channels(file, SAMPLE),
            )
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error})") from None
    except NewerFormatError as error:
        raise InputError(f"{path}: {error}") from None
    except InputError as error:
        raise InputError(f"{path}: not a result of exu_press, or damaged: {error!s:.400}") from None


def _text(owner: Any, name: str) -> str:
    """Return a text of a file or a variable."""
    texts = _texts(owner)
    if name not in texts:
        raise InputError(f"has no {name}")
    try:
        return texts[name].decode()
    except UnicodeDecodeError:
        raise InputError(f"{name} = {short_text(texts[name])}: allowed is UTF-8") from None


def _values(variable: Any, dtype: type[Number]) -> NDArray[Number]:
    """Return a copy of a variable's values; raise InputError where they are damaged."""
    stored: NDArray[Any] = variable.data
    if _text(variable, CHECKSUM) != f"{checksum(stored):08x}":
        raise InputError("its values are damaged: they do not have the checksum of the file")
    if stored.dtype.newbyteorder("=") != dtype:
        raise InputError(f"type {stored.dtype.name}; allowed is {np.dtype(dtype).name}")
    return stored.astype(dtype)


def _channels(file: "netcdf_file", along: str) -> dict[str, Channel]:
    """Return the channels over time, or over the samples."""
    suffix = AT_SAMPLES if along == SAMPLE else ""
    return {
        name.removesuffix(suffix): _channel(name, variable)
        for name, variable in file.variables.items()
        if next(iter(variable.dimensions), "") == along
    }


def _channel(name: str, variable: Any) -> Channel:
    """Return a channel; its last dimension names its columns."""
    _, *inner = variable.dimensions
    with error_prefix(f"channel {short_text(name)}: "):
        return Channel(
            _values(variable, np.float64),
            _text(variable, "units"),
            _text(variable, "long_name"),
            inner[-1] if inner else "",
        )


def read_text(path: Path, name: str) -> str:
    """Return a text that a file has beside a result; raise InputError if it is damaged."""
    with error_prefix(f"{path}: "), _open_checked(path) as file:
        return _text(file, name)


@contextmanager
def _open_checked(path: Path) -> Iterator["netcdf_file"]:
    """Open the file of a result, whose header is checked; values are read when they are used.

    Raises:
        InputError: it is of another format, or its header is damaged.
        OSError: it cannot be opened.
    """
    from scipy.io import netcdf_file  # takes longer to load than a short run

    if not stat.S_ISREG(path.stat().st_mode):
        raise OSError("not a file")
    try:
        file = netcdf_file(path, "r", mmap=True)
    except OSError:
        raise
    except Exception:  # whatever the reader raises of foreign bytes
        raise InputError("not a whole NetCDF file of the classic format") from None
    try:
        sizes = [variable.data.nbytes for variable in file.variables.values()]
        if sum(sizes) > path.stat().st_size:  # it would ask for any amount of memory
            raise InputError("its variables lie over each other")
        form = _texts(file).get("format", b"").decode(errors="replace")
        refuse_newer_format(form, FORMAT)
        if form != FORMAT:
            raise InputError(f"has no format = {FORMAT!r}")
        if _texts(file).get(CHECKSUM) != _header_checksum(file).encode():
            raise InputError("its header is damaged: it does not have the checksum of the file")
        yield file
    finally:
        with warnings.catch_warnings():  # of values that a traceback still has
            warnings.simplefilter("ignore", RuntimeWarning)
            file.close()


def is_whole(path: Path) -> bool:
    """Return whether a file is there, as long as its header says, and the header undamaged."""
    try:
        with _open_checked(path):
            return True
    except (OSError, InputError):
        return False


def _write_surface(file: "netcdf_file", body: str, surface: Surface) -> None:
    """Write the arrays of a flexible body's surface; dimensions that the bodies share once."""
    for array, (axes, unit, meaning) in ARRAYS.items():
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
        variable.long_name = f"{body}: {meaning}"


def _surfaces(file: "netcdf_file") -> dict[str, Surface]:
    """Return the surfaces in a file, by body."""
    suffix = "_surface_nodes"
    bodies = [name.removesuffix(suffix) for name in file.variables if name.endswith(suffix)]
    return {body: _surface(file, body) for body in bodies}


def _surface(file: "netcdf_file", body: str) -> Surface:
    """Return the surface of a body; in a file without stresses there are none."""

    def array(name: str, dtype: type[Number]) -> NDArray[Number]:
        if f"{body}_surface_{name}" not in file.variables:
            raise InputError(f"has no {name}")
        return _values(file.variables[f"{body}_surface_{name}"], dtype)

    with error_prefix(f"surface of {short_text(body)}: "):
        modes = array("modes", np.float32)
        stress = np.zeros((0, 6, modes.shape[-1]), np.float32)
        if f"{body}_surface_stress" in file.variables:
            stress = array("stress", np.float32)
        return Surface(array("nodes", np.float32), array("triangles", np.int32), modes, stress)


def dataset(result: Contents) -> Any:
    """Return the channels of a result as an `xarray.Dataset` over time.

    Raises:
        InputError: xarray is not installed.
    """
    xarray = required_package("xarray", "to_xarray", "xarray")
    variables, axes = {}, set()
    for name, channel in result.channels.items():
        inner = ("body",) if channel.values.ndim == 3 else ()
        outer = (channel.axis,) if channel.axis else ()
        axes |= {*inner, *outer}
        attributes = {"units": channel.unit, "long_name": channel.long_name}
        variables[name] = (("time", *inner, *outer), channel.values, attributes)
    columns = {"body": result.bodies, **AXES}
    return xarray.Dataset(
        variables,
        coords={axis: list(columns[axis]) for axis in axes if axis in columns},
        attrs={"scene": json.dumps(result.scene.to_dict()), "info": json.dumps(result.info)},
    )
