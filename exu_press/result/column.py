"""One number a step of a run: a channel, or a column of one that has several."""

from collections.abc import Iterator

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.result.channel import AXES, Channel
from exu_press.result.result import Result
from exu_press.schema.checks import demand_known

__all__ = ["column_of"]


def column_of(result: Result, name: str) -> tuple[Array, str]:
    """Return the values (n,) and the unit of a channel, or of NAME.COLUMN of one with columns.

    Raises:
        InputError: the run has no such channel, or the channel no such column.
    """
    channel, _, _ = name.partition(".")
    if channel not in result.channels:
        known = [n for c in sorted(result) for n, _ in _columns(c, result.channels[c])]
        demand_known(f"channel {name!r}: this run has none of that name", name, known)
    recorded = result.channels[channel]
    columns = dict(_columns(channel, recorded))
    if not columns:
        raise InputError(f"channel {channel!r}: allowed is one with a value, or columns, a step")
    if name not in columns:
        none = f"{channel} has no columns; allowed is"
        what = none if channel in columns else "allowed is a column of it:"
        raise InputError(f"channel {name!r}: {what} {', '.join(columns)}")
    return columns[name], recorded.unit


def _columns(name: str, channel: Channel) -> Iterator[tuple[str, Array]]:
    """Yield the columns of a channel, each with its name; none of a table a step."""
    values = channel.values
    if values.ndim == 1:
        yield name, values
    elif values.ndim == 2:
        for k, column in enumerate(AXES.get(channel.axis) or range(values.shape[-1])):
            yield f"{name}.{column}", values[:, k]
