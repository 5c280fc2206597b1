"""Contents of a result, checked."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from exu_press.errors import InputError
from exu_press.integrate import SolverStatus
from exu_press.mechanism import Mechanism
from exu_press.result.channel import Channel
from exu_press.result.channels import channel_headers
from exu_press.result.info import Info
from exu_press.result.recorders import expected_channels
from exu_press.scene import Scene, mechanism_of
from exu_press.schema.stored import short_text

if TYPE_CHECKING:
    from exu_press.result.surface import Surface

__all__ = ["Contents"]

LARGEST_SINGLE = 1e16
"""Largest displacement or stress of a surface: its square is a number in single precision."""


@dataclass(frozen=True)
class Contents:
    """The contents of a `Result` and of its file, checked once; the attributes are there."""

    scene: Scene
    channels: Mapping[str, Channel]
    info: Info
    bodies: tuple[str, ...] = field(default=())
    surfaces: Mapping[str, "Surface"] = field(default_factory=dict)
    sampled: Mapping[str, Channel] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check everything that readers rely on."""
        _check(self)


def _check(result: Contents) -> None:
    """Raise InputError where a result contradicts itself or its scene."""
    status = result.info["status"]
    if status not in (member.value for member in SolverStatus):
        allowed = ", ".join(repr(member.value) for member in SolverStatus)
        raise InputError(f"info.status = {short_text(status)}: allowed is one of {allowed}")
    scene, mechanism = result.scene, mechanism_of(result.scene)
    bodies = tuple(body.name for body in mechanism.bodies)
    if result.bodies != bodies:
        raise InputError(
            f"bodies = {short_text(result.bodies)}: allowed are the scene's, {', '.join(bodies)}"
        )
    whole = "figures" not in result.info
    expected = expected_channels(scene, own_items=bool(result.info["own_items"]))
    for channels in (result.channels, result.sampled) if result.sampled else (result.channels,):
        _check_channels(channels, mechanism, expected, whole=whole)
    _check_surfaces(result)


def _check_channels(
    channels: Mapping[str, Channel],
    mechanism: Mechanism,
    expected: Mapping[str, tuple[str, bool]],
    *,
    whole: bool,
) -> None:
    """Check the channels and their columns."""
    required = [name for name, (_, always) in expected.items() if always]
    for name in required if whole else ("time", "crank_angle"):
        if name not in channels:
            raise InputError(f"channel {name}: missing; this scene's results have it")
    count = len(channels["time"].values)
    kinds = channel_headers(channels)
    computed_later = (
        kinds is not channels
    )  # on disk or changed: values are checked where they are read
    for name, channel in kinds.items():
        if name.endswith("_eccentricity") and name not in expected:
            raise InputError(f"channel {name}: the scene has no such joint with clearance")
        allowed, _ = expected.get(name, (channel.axis, False))  # one face of several is not known
        if channel.axis != allowed:
            raise InputError(
                f"channel {name}: columns are {short_text(channel.axis)}; allowed is {allowed!r}"
            )
        if not computed_later and len(channel.values) != count:
            raise InputError(f"channel {name}: {len(channel.values)} values; time has {count}")
    poses = channel_headers(channels).get("body_position")
    if poses is not None and poses.values.shape[1] != len(mechanism.bodies):
        raise InputError(f"channel body_position: allowed are {len(mechanism.bodies)} bodies")
    if count == 0 or not (np.diff(channels["time"].values) > 0.0).all():
        raise InputError("channel time: allowed are increasing instants, at least one")


def _check_surfaces(result: Contents) -> None:
    """Check that surfaces belong to bodies, and their modes to channels."""
    for body, surface in result.surfaces.items():
        if body not in result.bodies:
            raise InputError(f"surface of {short_text(body)}: the scene has no such body")
        name, modes = f"{body}_modes", surface.modes.shape[-1]
        if name not in result.channels or result.channels[name].values.shape[1:] != (modes,):
            raise InputError(f"channel {name}: allowed are {modes} columns, as the surface's modes")
        most = modes * np.abs(result.channels[name].values).max()
        for array in (surface.nodes, surface.modes * most, surface.stress * most):
            if array.size and not np.abs(array).max() < LARGEST_SINGLE:
                raise InputError(f"surface of {body}: allowed are numbers below {LARGEST_SINGLE:g}")
