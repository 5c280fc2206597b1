"""The curves that a page offers: scalars of a run's channels, by joint, guide, load and body."""

from collections.abc import Iterator
from dataclasses import dataclass

from exu_press.plots.words import joint_in_words
from exu_press.quantities.catalogue import CATALOGUE, quantities_of
from exu_press.quantities.quantity import Owner
from exu_press.result import Result
from exu_press.result.channel import AXES, guide_channel
from exu_press.scene import mechanism_of

__all__ = ["Curve", "curves_of", "shown_unit"]

PEAKS = {(quantity.owner, quantity.curve): quantity for quantity in CATALOGUE if quantity.curve}
"""Owner and curve -> the quantity that is its extreme."""


@dataclass(frozen=True)
class Curve:
    """One scalar over time: offset + factor * (a column, or the size of a vector).

    Attributes:
        name: unique in a run.
        group: its owner, as people read it.
        label: which of its values this is.
        unit: SI.
        channel: in which it is stored.
        columns: of the channel; of several, the size of the vector is meant.
        body: index of the body in a channel of poses.
        offset: in SI.
        factor: in SI.
        peak: full name of the quantity that is its extreme; "" where there is none.
        least: whether this extreme is the least value.
    """

    name: str
    group: str
    label: str
    unit: str
    channel: str
    columns: tuple[int, ...] = (0,)
    body: int | None = None
    offset: float = 0.0
    factor: float = 1.0
    peak: str = ""
    least: bool = False


def curves_of(result: Result) -> list[Curve]:
    """Return every curve of a run: first those of the whole mechanism, then by owner."""
    mechanism = mechanism_of(result.scene)
    of_owners: list[Curve] = []
    for name in result.joints:
        of_owners += _joint(result, name)
    for guide in mechanism.guides:
        begin = guide_channel(mechanism, guide.name)
        group = f"Guide of {_label_of(guide.name)}"
        of_owners += _channels_of(result, begin, group, Owner.GUIDE, guide.name)
    for gear in mechanism.gears:
        of_owners += _channels_of(
            result, f"gear_{gear.name}", f"Gear {_label_of(gear.name)}", Owner.GEAR, gear.name
        )
    for spring in mechanism.springs:
        begin, group = f"spring_{spring.name}", f"Spring {_label_of(spring.name)}"
        of_owners += _channels_of(result, begin, group, Owner.SPRING, spring.name)
    for load in result.scene.applied_loads:
        of_owners += _channels_of(
            result, f"load_{load}", f"Load {_label_of(load)}", Owner.LOAD, load
        )
    for index, body in enumerate(result.bodies):
        of_owners += _body(result, index, body)
    used = {curve.channel for curve in of_owners} | {"time", "crank_angle"}
    rest = [name for name in sorted(result.channels) if name not in used]
    peaks = {
        placed.quantity.curve: name
        for name, placed in quantities_of(result.scene).items()
        if placed.quantity.curve and placed.quantity.owner is Owner.RUN
    }
    whole = [curve for name in rest for curve in _plain(result, name, "Mechanism", "", peaks)]
    return [*whole, *of_owners]


def _joint(result: Result, name: str) -> Iterator[Curve]:
    group, joint = f"Joint {_label_of(name)}", result.joints[name]
    force = f"{name}_force"
    yield from _plain(result, force, group, "force", {force: _peak(Owner.JOINT, "force", name)})
    eccentricity = f"{name}_eccentricity"
    if eccentricity in result:
        columns = tuple(range(result[eccentricity].shape[1]))
        of_length = {"channel": eccentricity, "columns": columns, "group": group}
        clearance = joint.clearance
        yield Curve(
            f"{name}:ratio",
            label="eccentricity ratio",
            unit="",
            factor=1.0 / clearance,
            peak=_peak(Owner.JOINT, "ratio", name),
            **of_length,  # type: ignore[arg-type]
        )
        yield Curve(
            f"{name}:gap",
            label="gap (below zero: penetration)",
            unit="m",
            offset=clearance,
            factor=-1.0,
            peak=_peak(Owner.JOINT, "gap", name),
            least=True,
            **of_length,  # type: ignore[arg-type]
        )
        yield from _plain(result, eccentricity, group, "eccentricity", {})
    for what, label in (("moment", "moment"), ("power", "dissipated power"), ("loss", "loss")):
        if f"{name}_{what}" in result:
            yield from _plain(result, f"{name}_{what}", group, label, {})


def _peak(owner: Owner, curve: str, at: str) -> str:
    """Return the full name of the quantity that is a curve's extreme, or nothing."""
    quantity = PEAKS.get((owner, curve))
    return "" if quantity is None else quantity.full_name(at)


def _channels_of(result: Result, begin: str, group: str, owner: Owner, at: str) -> Iterator[Curve]:
    """Yield the curves of all channels of a guide, a gear, a spring or a load."""
    for name in result.channels:
        if name.startswith(f"{begin}_"):
            what = name.removeprefix(f"{begin}_")
            peak = _peak(owner, what, at)
            yield from _plain(result, name, group, _label_of(what), {name: peak} if peak else {})


def _body(result: Result, index: int, body: str) -> Iterator[Curve]:
    group = f"Body {_label_of(body)}"
    if f"{body}_stress" in result:
        yield from _plain(result, f"{body}_stress", group, "stress where it is largest", {})
    if "body_position" in result:
        for column, (what, unit) in enumerate((("x", "m"), ("y", "m"), ("angle", "rad"))):
            name = f"{body}:{what}"
            yield Curve(name, group, what, unit, "body_position", (column,), body=index)
    if f"{body}_modes" in result:
        channel = f"{body}_modes"
        for column in range(result[channel].shape[1]):
            unit = result.units[channel]
            yield Curve(
                f"{channel}:{column}", group, f"mode {column + 1}", unit, channel, (column,)
            )


def _plain(
    result: Result, name: str, group: str, label: str, peaks: dict[str, str]
) -> Iterator[Curve]:
    """Yield a channel's value, or a vector's size and its components."""
    channel = result.channels[name]
    label = label or _label_of(name).capitalize()
    if channel.values.ndim == 1:
        yield Curve(name, group, label, channel.unit, name, peak=peaks.get(name, ""))
        return
    count = channel.values.shape[1]
    if channel.axis in ("plane", "space"):
        columns, peak = tuple(range(count)), peaks.get(name, "")
        yield Curve(name, group, label, channel.unit, name, columns, peak=peak)
    for column, component in enumerate(AXES.get(channel.axis) or map(str, range(count))):
        component_name = f"{name}:{component}"
        is_end = component not in ("x", "y", "z", "angle")
        component_label = f"{label}, {'on ' * is_end}{component}"
        yield Curve(
            component_name,
            group,
            component_label,
            channel.unit,
            name,
            (column,),
            peak=peaks.get(component_name, ""),
        )


def _label_of(name: str) -> str:
    label = joint_in_words(name)
    return label[:1].lower() + label[1:]


def shown_unit(unit: str, largest: float) -> tuple[str, float]:
    """Return the unit in which a curve is shown, and the factor to it from SI.

    Args:
        unit: SI.
        largest: absolute value, in SI.

    >>> shown_unit("m", 0.47), shown_unit("m", 2e-4), shown_unit("N", 9e5), shown_unit("m/s", 1.0)
    (('mm', 1000.0), ('µm', 1000000.0), ('kN', 0.001), ('m/s', 1.0))
    """
    if unit == "m":
        return ("mm", 1e3) if largest >= 1e-3 else ("µm", 1e6)
    if unit in ("N", "N m", "W", "J", "Pa"):
        for prefix, factor in (("M", 1e-6), ("k", 1e-3)):
            if largest * factor >= (5.0 if prefix == "M" else 1.0):
                return prefix + unit, factor
    return unit, 1.0
