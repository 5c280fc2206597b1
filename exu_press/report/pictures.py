"""The pictures of a run's page."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from exu_press.plots import save_pictures
from exu_press.plots.save import drawn_pictures
from exu_press.report.html import picture
from exu_press.result import Result
from exu_press.view import Animation, moment, save_picture
from exu_press.view.animation import SIZE
from fe_models.temporary import TemporaryFolder

__all__ = ["run_pictures"]

CAPTIONS = {
    "slider": "Slider motion against the ideal mechanism: position, velocity, acceleration.",
    "orbit": "Journal and ball centres in their clearance circles.",
    "force": "Joint forces and drive torque.",
    "press": "Forces of the press on its frame, and loads of its drive.",
    "energy": "Energy balance since the start; the residual is the error of the integration.",
}
"""By the picture's file name; pictures that are not listed are shown under their names."""


def run_pictures(result: Result, directory: Path | None = None) -> str:
    """Return the mechanism at its largest acceleration, and the pictures that a run draws.

    Args:
        result: of the run.
        directory: in which its pictures may be already, with its provenance in them.
    """
    with TemporaryFolder() as folder:
        drawn = [] if directory is None else drawn_pictures(result, directory)
        still = _still(result, folder)
        pictures = [
            picture(path, CAPTIONS.get(path.stem, path.stem))
            for path in drawn or save_pictures(result, folder)
        ]
    return "\n".join([still, *pictures])


def _still(result: Result, folder: Path) -> str:
    """Return the mechanism at the slider's largest acceleration, drawn in a folder."""
    peak = float(result.time[int(np.argmax(np.abs(result["slider_acceleration"])))])
    animation = Animation(result, moment(result, peak), Figure(figsize=SIZE))
    still = save_picture(animation, 1, folder / "mechanism.png")
    caption = f"The press at the slider's largest acceleration, t = {peak * 1e3:.2f} ms."
    if result.scene.press is None:
        caption = caption.replace("press", "mechanism", 1)
    return picture(still, caption)
