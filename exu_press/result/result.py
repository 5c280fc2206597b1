"""The result of one run: channels over time, its end, and its scene."""

import copy
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from exu_press.errors import InputError
from exu_press.integrate import SolverStatus
from exu_press.numerics.arrays import Array
from exu_press.result.channels import LazyChannels, channel_headers, is_on_disk, read_columns
from exu_press.result.contents import Contents
from exu_press.result.joint import JointRecord
from exu_press.scene import IdealJoint
from exu_press.scene.joint import DryJoint, Joint, LubricatedJoint, unworn
from exu_press.schema.checks import nearest

if TYPE_CHECKING:
    from exu_press.result.output import Samples

__all__ = ["Result"]

SHOWN_CHANNELS = 5
"""Names of channels in a run's text."""

CLEARANCE_CHANNELS = "eccentricity", "moment", "power"
"""Channels of a joint with clearance, beside its force."""


class _Joints(dict[str, JointRecord]):
    """Joints by name; one that there is not is refused with those that there are."""

    def __missing__(self, name: str) -> JointRecord:
        raise InputError(
            f"joint {name!r}: was not recorded{nearest(name, self)}; this run has {', '.join(self)}"
        )


@dataclass(frozen=True)
class Result(Contents):
    """Channels of a run by name, as in result["slider_position"].

    Attributes:
        scene: complete, so that the run can be repeated from it.
        channels: by name; `time` is one of them.
        info: status, reason and statistics, as they stand in the summary.
        bodies: names of the bodies in `body_position`.
        surfaces: of the flexible bodies, by name, for pictures.
        sampled: channels at the samples, where the file does not keep all channels at all steps.

    Raises:
        InputError: they do not belong together.
    """

    def __getitem__(self, name: str) -> Array:
        if name not in self.channels:
            cure = ""
            if "figures" in self.info:
                cure = "was not kept; keep it by [output] channels, and run again: "
            cure = cure or f"is not recorded{nearest(name, self.channels)}; "
            names = ", ".join(sorted(self.channels))
            raise InputError(f"channel {name!r}: {cure}this run has {names}")
        return self.channels[name].values

    def path(self, body: str) -> Array:
        """Return the path of a body's centre of mass, (n, 2), m."""
        index = self.bodies.index(body)
        return read_columns(self.channels, "body_position", lambda values: values[:, index, :2])

    def __iter__(self) -> Iterator[str]:
        return iter(self.channels)

    def __contains__(self, name: object) -> bool:
        return name in self.channels

    @property
    def time(self) -> Array:
        """Instants of the channels, (n,), s: the start and the end of every accepted step."""
        return self["time"]

    @property
    def units(self) -> Mapping[str, str]:
        """Units of the channels, by name."""
        return {name: channel.unit for name, channel in channel_headers(self.channels).items()}

    @property
    def completed(self) -> bool:
        """Return whether the run reached its end; if "under-resolved", its peaks are not right."""
        return SolverStatus(self.info["status"]).reached_end

    @cached_property
    def joints(self) -> Mapping[str, JointRecord]:
        """Every joint of the mechanism whose force was recorded, by its name."""
        recorded = {
            name: joint
            for name, joint in self.scene.joints.items()
            if f"{name}_force" in self
            and (
                isinstance(joint, IdealJoint)
                or all(f"{name}_{end}" in self for end in CLEARANCE_CHANNELS)
            )
        }
        return _Joints(
            {
                name: JointRecord(name, joint.kind, _mean_clearance(joint), self.channels)
                for name, joint in recorded.items()
            }
        )

    @property
    def clearance_joints(self) -> tuple[str, ...]:
        """Names of the joints with clearance."""
        return tuple(name for name, joint in self.joints.items() if joint.kind != "ideal")

    @cached_property
    def samples(self) -> "Samples":
        """The record at the crank angles of [output] samples, revolution by revolution.

        Raises:
            InputError: the scene asks for none.
        """
        from exu_press.result.output import samples_of

        return samples_of(self.scene, self.sampled or self.channels)

    @cached_property
    def read(self) -> dict[Any, Any]:
        """Quantities read so far, by their declaration and place: each is worked out once."""
        return {}

    def __getstate__(self) -> dict[str, Any]:
        """Return what another process gets: quantities are read there again."""
        return {name: value for name, value in self.__dict__.items() if name != "read"}

    def with_values(self, values: Mapping[str, Array]) -> "Result":
        """Return the run with these values of some of its channels, by their names."""
        if is_on_disk(self.channels):
            return self.map_values(lambda name, old: values.get(name, old))
        changed = {name: replace(self.channels[name], values=new) for name, new in values.items()}
        return replace(self, channels={**self.channels, **changed})

    def map_values(self, change: Callable[[str, Array], Array]) -> "Result":
        """Return the run with changed values of its channels, computed when they are asked for.

        Args:
            change: name and values of a channel -> its changed values.
        """
        run = copy.copy(self)
        object.__setattr__(run, "channels", LazyChannels(self.channels, change))
        for cached in ("joints", "samples", "read"):
            run.__dict__.pop(cached, None)
        return run

    def summary(self) -> dict[str, Any]:
        """Return the dictionary of summary.json."""
        from exu_press import summary

        return summary(self)

    def quantity(self, name: str) -> Any:
        """Return one quantity, an `exu_press.quantities.Value`, by its full name.

        Raises:
            InputError: the run's scene has no such quantity.
        """
        from exu_press import value_of

        return value_of(self, name)

    def compare(self, *results: "Result", labels: Sequence[str] = ()) -> Any:
        """Return this run beside others, an `exu_press.studies.comparison.Comparison`.

        Its text is the table of `exu-press compare`, a notebook shows it, and `view()` is its page.

        Args:
            results: of any scenes.
            labels: of this run and those; their kinds of bodies and joints unless given.

        Raises:
            InputError: a run is none, the runs have no revolutions in common, or labels are not
                one for each.
        """
        from exu_press import compare_results

        return compare_results([self, *results], labels)

    def __repr__(self) -> str:
        """Return what the run is of, how it ended and what it has, in a few lines."""
        scene, joints = self.scene, ", ".join(self.clearance_joints) or "none"
        bodies = ", ".join(scene.bodies) or "none"
        mechanism = scene.mechanism if isinstance(scene.mechanism, str) else scene.mechanism.name
        names = ", ".join(list(self)[:SHOWN_CHANNELS])
        return (
            f"Result of {mechanism} at {scene.speed_rpm:g} rpm: {self.info['status']} at "
            f"t = {self.info['end_time']:.6g} s, {len(self.time)} instants\n"
            f"joints with clearance: {joints}; flexible bodies: {bodies}\n"
            f"{len(self.channels)} channels, as result[name]: {names}, ...\n"
            "quantities, as result.quantity(name): all in result.summary()"
        )

    def view(self) -> Any:
        """Return the run's page, an `exu_press.report.Page`: a notebook shows it in the cell."""
        from exu_press import page_of

        return page_of(self)

    def _repr_html_(self) -> str:
        """Return the quantities as a table, for notebooks."""
        from exu_press import cell

        return cell(self)

    def save(self, path: str | Path) -> None:
        """Write the channels that [output] keeps, all unless it says, to a NetCDF file.

        An existing one is replaced only when complete.
        """
        from exu_press.result.netcdf import write
        from exu_press.result.output import decimated_copy

        output, run = self.scene.output, self
        if output is not None and not output.whole and "figures" not in self.info:
            none = np.array([], np.intp)
            run = decimated_copy(
                self, self.samples.rows if output.samples else none, self.summary()
            )
        write(run, Path(path))

    def to_xarray(self) -> Any:
        """Return the channels as an `xarray.Dataset` over time, with units and names of columns.

        Raises:
            InputError: xarray is not installed.
        """
        from exu_press.result.netcdf import dataset

        return dataset(self)

    @staticmethod
    def load(path: str | Path) -> "Result":
        """Read a file of `save`, or, with a warning, the blocks of a run whose process was killed.

        Raises:
            InputError: the file cannot be read or is not a result.
        """
        from exu_press.result.checkpoint import read

        return read(Path(path), Result)


def _mean_clearance(joint: Joint) -> float:
    """Return a joint's radial clearance, all around where it is worn, m."""
    return (
        unworn(joint).clearance
        if isinstance(joint, DryJoint | LubricatedJoint)
        else joint.clearance
    )
