"""A result as a NetCDF file, or as a dataset of xarray: units and names, and the scene."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError, error_prefix, required_package
from exu_press.files.file_format import NewerFormatError, refuse_newer_format
from exu_press.files.output_directory import replacing
from exu_press.result.channel import AXES, Channel
from exu_press.result.classic import Classic, Variable, checksum, header_checksum, open_classic
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

    def texts(owner: Any) -> dict[str, bytes]:
        """Return the texts of the file or of a variable as they are stored."""
        stored = owner._attributes.items()
        return {n: (t if isinstance(t, bytes) else t.encode()) or b"\0" for n, t in stored}

    for variable in file.variables.values():
        variable.checksum = f"{checksum(variable.data):08x}"
    variables = {
        name: (
            dict(zip(variable.dimensions, variable.shape, strict=True)),
            texts(variable),
            variable.data.dtype,
        )
        for name, variable in file.variables.items()
    }
    file.checksum = header_checksum(texts(file), variables)


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
        file = _open_checked(path)
        scene = from_json(dict[str, Any], _text(file.attributes, "scene"), "scene")
        asked = from_json(list[str], file.attributes.get("asked", b"[]"), "asked")
        return kind(
            scene=Scene.from_dict(scene, asked, resolve=False),
            channels=_channels(file, "time"),
            info=from_json(Info, _text(file.attributes, "info"), "info"),
            bodies=from_json(tuple[str, ...], _text(file.attributes, "bodies"), "bodies"),
            surfaces=_surfaces(file),
            sampled=_channels(file, SAMPLE),
        )
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror or error})") from None
    except NewerFormatError as error:
        raise InputError(f"{path}: {error}") from None
    except InputError as error:
        raise InputError(f"{path}: not a result of exu_press, or damaged: {error!s:.400}") from None


def _text(attributes: Mapping[str, bytes], name: str) -> str:
    """Return a text of a file or a variable."""
    if name not in attributes:
        raise InputError(f"has no {name}")
    try:
        return attributes[name].decode()
    except UnicodeDecodeError:
        raise InputError(f"{name} = {short_text(attributes[name])}: allowed is UTF-8") from None


def _channels(file: Classic, along: str) -> dict[str, Channel]:
    """Return the channels over time, or over the samples."""
    suffix = AT_SAMPLES if along == SAMPLE else ""
    return {
        name.removesuffix(suffix): _channel(name, variable)
        for name, variable in file.variables.items()
        if next(iter(variable.dimensions), "") == along
    }


def _channel(name: str, variable: Variable) -> Channel:
    """Return a channel; its last dimension names its columns."""
    _, *inner = variable.dimensions
    with error_prefix(f"channel {short_text(name)}: "):
        return Channel(
            variable.values(np.float64),
            _text(variable.attributes, "units"),
            _text(variable.attributes, "long_name"),
            inner[-1] if inner else "",
        )


def read_text(path: Path, name: str) -> str:
    """Return a text that a file has beside a result; raise InputError if it is damaged."""
    with error_prefix(f"{path}: "):
        return _text(_open_checked(path).attributes, name)


def _open_checked(path: Path) -> Classic:
    """Return a file of a result, its header checked.

    Raises:
        InputError: it is of another format, or its header is damaged.
        OSError: it cannot be opened.
    """
    file = open_classic(path)
    form = file.attributes.get("format", b"").decode(errors="replace")
    refuse_newer_format(form, FORMAT)
    if form != FORMAT:
        raise InputError(f"has no format = {FORMAT!r}")
    file.check_header()
    return file


def is_whole(path: Path) -> bool:
    """Return whether a file is there, as long as its header says, and the header undamaged."""
    try:
        open_classic(path).check_header()
    except (OSError, InputError):
        return False
    return True


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


def _surfaces(file: Classic) -> dict[str, Surface]:
    """Return the surfaces in a file, by body."""
    suffix = "_surface_nodes"
    bodies = [name.removesuffix(suffix) for name in file.variables if name.endswith(suffix)]
    return {body: _surface(file, body) for body in bodies}


def _surface(file: Classic, body: str) -> Surface:
    """Return the surface of a body; in a file without stresses there are none."""

    def array(name: str, dtype: type[Number]) -> NDArray[Number]:
        if f"{body}_surface_{name}" not in file.variables:
            raise InputError(f"has no {name}")
        return file.variables[f"{body}_surface_{name}"].values(dtype)

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
