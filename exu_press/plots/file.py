"""A picture as a file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from exu_press.errors import InputError
from exu_press.files.output_directory import FORMATS, replacing
from exu_press.plots.style import DPI, look

__all__ = ["check_picture", "save_figure", "save_figures"]


def check_picture(path: Path) -> None:
    """Raise InputError unless a picture can be written under this name."""
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"--save {path}: allowed is a name that ends in {', '.join(FORMATS)}")
    if not path.parent.is_dir():
        raise InputError(f"--save {path}: there is no directory {path.parent}")


def save_figure(figure: Figure, path: Path) -> Path:
    """Write under a temporary name, then rename.

    `Figure.savefig` would draw a PNG twice, the first time to find out its artists.
    """
    figure.set_layout_engine("none")  # it has been laid out; not again
    figure.set_dpi(DPI)
    kind = path.suffix.lower().removeprefix(".")
    with replacing(path) as partial:
        if kind != "png":
            with look():
                figure.savefig(partial, format=kind)
            return path
        canvas: Any = FigureCanvasAgg(figure)
        with look():
            canvas.draw()
        image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
        image.save(partial, format="png", dpi=(DPI, DPI), compress_level=4)
    return path


def save_figures(
    figures: Mapping[str, Figure], directory: str | Path, ending: str = FORMATS[0]
) -> list[Path]:
    """Write each figure under its name and return the files."""
    return [
        save_figure(figure, Path(directory) / f"{name}{ending}") for name, figure in figures.items()
    ]
