"""What the file of a run keeps of it, with the quantities read of all."""

import dataclasses
from dataclasses import replace

import numpy as np

from exu_press.result.channel import Channel
from exu_press.result.info import Figures, Info
from exu_press.result.result import Result

__all__ = ["kept"]


def kept(run: Result) -> Result:
    """Return a run with the channels and steps that its scene's [output] keeps.

    The last step is one of them. Quantities, strokes and warnings of the summary are in
    `info["figures"]`; every channel at the samples, where there are any, in `sampled`.

    Raises:
        InputError: [output] names a channel that the run does not have.
    """
    output = run.scene.output
    if output is None or output.whole or "figures" in run.info:
        return run
    names = output.kept(run.channels)
    count = len(run.time)
    rows = np.union1d(np.arange(0, count, output.every), [count - 1])
    sampled: dict[str, Channel] = {}
    if output.samples and len(run.samples):
        at = run.samples.rows
        sampled = {n: replace(one, values=one.values[at]) for n, one in run.channels.items()}
    summary = run.summary()
    quantities = {name: told["value"] for name, told in summary["quantities"].items()}
    figures: Figures = {
        "quantities": quantities,
        "strokes": summary["strokes"],
        "read_from": summary["read_from"],
        "warnings": summary["warnings"],
    }
    info: Info = {**run.info, "figures": figures}
    return dataclasses.replace(
        run,
        channels={n: replace(run.channels[n], values=run.channels[n].values[rows]) for n in names},
        surfaces={body: one for body, one in run.surfaces.items() if f"{body}_modes" in names},
        sampled=sampled,
        info=info,
    )
