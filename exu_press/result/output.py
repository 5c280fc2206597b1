"""What a scene's [output] asks of a run: its samples at crank angles, and what its file keeps."""

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from exu_press.errors import InputError
from exu_press.numerics.arrays import Array
from exu_press.result.channel import Channel
from exu_press.result.channels import channel_headers, read_rows
from exu_press.result.contents import Contents
from exu_press.result.info import Figures, Info
from exu_press.scene import Scene

__all__ = ["Samples", "decimated_copy", "samples_of"]

Kind = TypeVar("Kind", bound=Contents)

NEAR = 1e-3
"""Largest twist of a flexible crank whose drive is at a sampled angle, rad."""


@dataclass(frozen=True)
class Samples:
    """Samples of a run, in the order of time; `samples["slider_position"]` are a channel's values.

    Attributes:
        revolution: since the start, (m,); 0 is the first one.
        angle_deg: crank angle, (m,), deg from the mechanism's zero, from 0 to 360.
        rows: of the channels, (m,).
    """

    revolution: Array
    angle_deg: Array
    rows: NDArray[np.intp]
    _channels: Mapping[str, Channel]

    def __getitem__(self, name: str) -> Array:
        """Return the values of a channel, (m, ...)."""
        return read_rows(self._channels, name, self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def at_angle(self, angle_deg: float) -> "Samples":
        """Return the samples at one of the crank angles, one a revolution.

        Raises:
            InputError: the run was not sampled there.
        """
        here = np.abs(self.angle_deg - angle_deg) < 1e-9
        if not here.any():
            sampled = ", ".join(f"{angle:g}" for angle in np.unique(self.angle_deg))
            raise InputError(
                f"samples at {angle_deg:g} deg: this run has them at {sampled or 'none'}"
            )
        return Samples(self.revolution[here], self.angle_deg[here], self.rows[here], self._channels)


def samples_of(scene: Scene, channels: Mapping[str, Channel]) -> Samples:
    """Return the samples of a run, as far as it got.

    Raises:
        InputError: its scene asks for none.
    """
    if scene.output is None or not scene.output.samples:
        raise InputError("samples: this run has none; allowed is [output] samples = [crank angles]")
    rotation = channels["crank_angle"].values - scene.start_angle
    if scene.drive is None:
        time = channels["time"].values
        rotation = rotation[0] + scene.angular_speed * (time - time[0])
    requested, number = scene.output.section(scene.start_angle).samples(
        float(rotation.max()) + NEAR
    )
    rows = np.searchsorted(rotation, requested)
    preceding, following = np.maximum(rows - 1, 0), np.minimum(rows, len(rotation) - 1)
    nearer = np.abs(rotation[preceding] - requested) < np.abs(rotation[following] - requested)
    rows = np.where(nearer, preceding, following)
    is_sampled = np.abs(rotation[rows] - requested) < NEAR
    angles = np.array(scene.output.samples)
    revolution = np.floor(requested / (2.0 * np.pi) + 1e-9).astype(int)
    return Samples(revolution[is_sampled], angles[number[is_sampled]], rows[is_sampled], channels)


def decimated_copy(run: Kind, samples: NDArray[np.intp], summary: Mapping[str, Any]) -> Kind:
    """Return a run with the channels and steps that its scene's [output] keeps.

    The last step is one of them. Quantities, strokes and warnings of the summary are in
    `info["figures"]`; every channel at the samples, where there are any, in `sampled`.

    Raises:
        InputError: [output] names a channel that the run does not have.
    """
    output = run.scene.output
    assert output is not None
    names = output.kept_channels(run.channels)
    count = len(run.channels["time"].values)
    rows = np.append(np.arange(0, count - 1, output.every), count - 1)

    def read(rows: NDArray[np.intp], names: Iterable[str]) -> dict[str, Channel]:
        headers = channel_headers(run.channels)
        return {n: replace(headers[n], values=read_rows(run.channels, n, rows)) for n in names}

    quantities = {name: entry["value"] for name, entry in summary["quantities"].items()}
    figures: Figures = {
        "quantities": quantities,
        "strokes": summary["strokes"],
        "read_from": summary["read_from"],
        "warnings": summary["warnings"],
    }
    info: Info = {**run.info, "figures": figures}
    return dataclasses.replace(
        run,
        channels=read(rows, names),
        surfaces={
            body: surface for body, surface in run.surfaces.items() if f"{body}_modes" in names
        },
        sampled=read(samples, run.channels if len(samples) else ()),
        info=info,
    )
