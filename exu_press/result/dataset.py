"""A result as a dataset of xarray, for those who have it."""

import importlib
import json
from typing import Any

from exu_press.errors import InputError
from exu_press.result.channel import AXES
from exu_press.result.contents import Contents

__all__ = ["dataset"]


def dataset(result: Contents) -> Any:
    """Return the channels of a result as an `xarray.Dataset` over time.

    Raises:
        InputError: xarray is not installed.
    """
    try:
        xarray: Any = importlib.import_module("xarray")
    except ModuleNotFoundError:
        raise InputError(
            "to_xarray: needs the package xarray; install it by pip install xarray"
        ) from None
    variables, used = {}, set()
    for name, channel in result.channels.items():
        inner = ("body",) if channel.values.ndim == 3 else ()
        outer = (channel.axis,) if channel.axis else ()
        used |= {*inner, *outer}
        words = {"units": channel.unit, "long_name": channel.long_name}
        variables[name] = (("time", *inner, *outer), channel.values, words)
    columns = {"body": result.bodies, **AXES}
    return xarray.Dataset(
        variables,
        coords={axis: list(columns[axis]) for axis in used if axis in columns},
        attrs={"scene": json.dumps(result.scene.to_dict()), "info": json.dumps(result.info)},
    )
