"""The decimated copy of a run that its file keeps, with the quantities of the whole run."""

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from exu_press.result.channel import Channel
from exu_press.result.channels import channel_headers, read_rows
from exu_press.result.contents import Contents
from exu_press.result.info import Figures, Info

__all__ = ["decimated_copy"]

Kind = TypeVar("Kind", bound=Contents)


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
