"""What came out of one run: channels over time, how it ended, and the scene it came from."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.result.contents import check_contents
from exu_press.result.info import Info
from exu_press.result.joint import JointRecord
from exu_press.result.surface import Surface
from exu_press.scene import IdealJoint, Scene
from exu_press.scene.joint import Joint
from exu_press.stored import LARGEST

__all__ = ["Channel", "Result"]

Array = NDArray[np.float64]

AXES = {
    "": (),
    "plane": ("x", "y"),
    "space": ("x", "y", "z"),
    "pose": ("x", "y", "angle"),
    "ends": ("journal", "bearing"),
}
"""What a channel's columns are."""


@dataclass(frozen=True)
class Channel:
    """One recorded quantity.

    Attributes:
        values: (n,), or (n, k) with one of AXES as columns, or (n, bodies, 3) for "pose".
        unit: SI.
        long_name: what it is, in words.
        axis: name of the columns: in AXES, or BODY_mode for a flexible body's modes.

    Raises:
        InputError: the values have another shape, or one of them is no number.
    """

    values: Array
    unit: str
    long_name: str
    axis: str = ""

    def __post_init__(self) -> None:
        """Check the values."""
        shape, columns = self.values.shape, AXES.get(self.axis)
        axes = {"": 1, "pose": 3}.get(self.axis, 2)
        if len(shape) != axes or (columns and shape[-1] != len(columns)):
            raise InputError(f"{self.long_name}: shape {shape}; columns are {self.axis!r}")
        if not (np.abs(self.values) < LARGEST).all():
            raise InputError(f"{self.long_name}: allowed are numbers below {LARGEST:g}")


@dataclass(frozen=True)
class Result:
    """Channels of a run by name, as in result["slider_position"].

    Attributes:
        scene: complete, so that the run can be repeated from it.
        channels: by name; `time` is one of them.
        info: status, reason and statistics, as they stand in the summary.
        bodies: names of the bodies in `body_position`.
        surfaces: of the flexible bodies, by name, for pictures.

    Raises:
        InputError: they do not belong together.
    """

    scene: Scene
    channels: Mapping[str, Channel]
    info: Info
    bodies: tuple[str, ...] = field(default=())
    surfaces: Mapping[str, Surface] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check what whoever reads a result relies on."""
        check_contents(self)

    def __getitem__(self, name: str) -> Array:
        """Return the values of a channel."""
        if name not in self.channels:
            raise InputError(f"channel {name!r}: this run has {', '.join(sorted(self.channels))}")
        return self.channels[name].values

    def __iter__(self) -> Iterator[str]:
        """Iterate over the channels' names."""
        return iter(self.channels)

    def __contains__(self, name: object) -> bool:
        """Return whether the run has a channel."""
        return name in self.channels

    @property
    def time(self) -> Array:
        """Instants of the channels, (n,), s: the start and the end of every accepted step."""
        return self["time"]

    @property
    def completed(self) -> bool:
        """Whether the run reached its end; "under-resolved" says that its peaks are not right."""
        return self.info["status"] in ("completed", "under-resolved")

    @cached_property
    def joints(self) -> Mapping[str, JointRecord]:
        """Every joint of the mechanism whose force was recorded, by its name."""
        recorded = {
            name: joint for name, joint in self.scene.joints.items() if f"{name}_force" in self
        }
        return {name: self._joint(name, joint) for name, joint in recorded.items()}

    @property
    def clearance_joints(self) -> tuple[str, ...]:
        """Names of the joints with clearance."""
        return tuple(name for name, joint in self.joints.items() if joint.kind != "ideal")

    def summary(self) -> dict[str, Any]:
        """Return the dictionary of summary.json."""
        from exu_press.observe import summary

        return summary(self)

    def save(self, path: str | Path) -> None:
        """Write everything to a NetCDF file; an existing one is replaced only when complete."""
        from exu_press.result.netcdf import write

        write(self, Path(path))

    def _joint(self, name: str, joint: Joint) -> JointRecord:
        """Return what one joint did."""
        force = self[f"{name}_force"]
        nothing = np.zeros((len(self.time), 2))
        apart, moment, power = np.zeros_like(force), nothing, nothing[:, 0]
        if not isinstance(joint, IdealJoint):
            apart, moment = self[f"{name}_eccentricity"], self[f"{name}_moment"]
            power = self[f"{name}_power"]
        return JointRecord(
            kind=joint.kind,
            spherical=self.channels[f"{name}_force"].axis == "space",
            clearance=joint.clearance,
            force=force,
            eccentricity=apart,
            gap=joint.clearance - np.linalg.norm(apart, axis=1),
            moment=moment,
            dissipated_power=power,
        )

    @staticmethod
    def load(path: str | Path) -> "Result":
        """Read what `save` wrote.

        Raises:
            InputError: the file cannot be read or is not a result.
        """
        from exu_press.result.netcdf import read

        return read(Path(path))
