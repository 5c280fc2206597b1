"""A picture as a file."""

import json
import struct
import zlib
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from datetime import datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from matplotlib import rcParams
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image
from PIL.PngImagePlugin import PngInfo, putchunk

from exu_press.errors import InputError
from exu_press.files.output_directory import FORMATS, remove_partial, replacing
from exu_press.plots.format import picture_format
from exu_press.plots.style import DPI, look
from exu_press.scene.provenance import Provenance, provenance_of
from fe_models.processes import performed_beside

__all__ = [
    "check_picture",
    "draw_figures",
    "png_texts",
    "read_sources",
    "save_figure",
    "save_figures",
    "write_png",
]


def check_picture(path: Path) -> None:
    """Raise InputError unless a picture can be written under this name."""
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"--save {path}: allowed is a name that ends in {', '.join(FORMATS)}")
    if not path.parent.is_dir():
        raise InputError(f"--save {path}: there is no directory {path.parent}")


def save_figure(
    figure: Figure, path: Path, sources: Mapping[str, Provenance] = MappingProxyType({})
) -> Path:
    """Write under a temporary name, then rename.

    `Figure.savefig` would draw a PNG twice, the first time to find out its artists.

    Args:
        figure: to be written.
        path: of the file.
        sources: provenance of what it shows, by label; it goes into the file's metadata.
    """
    figure.set_layout_engine("none")  # it has been laid out; not again
    kind = path.suffix.lower().removeprefix(".")
    with look(), replacing(path) as unfinished:
        dpi = rcParams["savefig.dpi"]
        figure.set_dpi(DPI if dpi == "figure" else dpi)
        if kind != "png":
            figure.savefig(unfinished, format=kind, metadata=_metadata(kind, sources))
            return path
        canvas: Any = figure.canvas
        if not isinstance(canvas, FigureCanvasAgg):
            canvas = FigureCanvasAgg(figure)
        canvas.draw()
        image = Image.fromarray(np.asarray(canvas.buffer_rgba()))
        write_png(unfinished, image, figure.dpi, png_texts(sources))
    return path


def write_png(path: Path, image: Image.Image, dpi: float, texts: PngInfo) -> None:
    """Write the colours of an image, compressed as little as takes the least time.

    Pillow's writer takes twice as long: it chooses a filter for every line.
    """
    colours = np.asarray(image.convert("RGB")).reshape(image.height, -1)
    lines = np.pad(colours, ((0, 0), (1, 0)))  # each after the number of its filter, which is none
    per_metre = round(dpi / 0.0254)
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        putchunk(file, b"IHDR", struct.pack(">2I5B", image.width, image.height, 8, 2, 0, 0, 0))
        putchunk(file, b"pHYs", struct.pack(">2IB", per_metre, per_metre, 1))
        for name, text, *_ in texts.chunks:
            putchunk(file, name, text)
        putchunk(file, b"IDAT", zlib.compress(lines.data, 1))
        putchunk(file, b"IEND")


def png_texts(sources: Mapping[str, Provenance]) -> PngInfo:
    """Return the metadata of a PNG file."""
    drawn, texts = provenance_of(), PngInfo()
    texts.add_text("Software", f"exu_press {drawn['version']}")
    texts.add_text("Creation Time", drawn["date"])
    texts.add_text("Description", _description(drawn, sources))
    return texts


def read_sources(path: Path) -> Any:
    """Return the provenance of what a PNG file shows, by label; None where it does not say."""
    try:
        with Image.open(path) as image:
            return json.loads(image.info["Description"])["sources"]
    except (OSError, ValueError, KeyError, TypeError, Image.DecompressionBombError):
        return None


def _description(drawn: Provenance, sources: Mapping[str, Provenance]) -> str:
    """Return what a picture is made of as JSON."""
    return json.dumps({"drawn": drawn, "sources": dict(sources)})


def _metadata(kind: str, sources: Mapping[str, Provenance]) -> dict[str, Any]:
    """Return the metadata of an SVG or a PDF file by the names that the format has for them."""
    drawn = provenance_of()
    about = _description(drawn, sources)
    software = f"exu_press {drawn['version']}"
    if kind == "svg":
        return {"Creator": software, "Date": drawn["date"], "Description": about}
    return {
        "Creator": software,
        "CreationDate": datetime.fromisoformat(drawn["date"]),
        "Subject": about,
    }


def save_figures(
    figures: Mapping[str, Figure],
    directory: str | Path,
    sources: Mapping[str, Provenance] = MappingProxyType({}),
) -> list[Path]:
    """Write each figure under its name and return the files; `sources` as of `save_figure`."""
    return [
        save_figure(figure, Path(directory) / f"{name}{picture_format().ending}", sources)
        for name, figure in figures.items()
    ]


def draw_figures(
    draws: Mapping[str, Callable[[], Figure]],
    directory: str | Path,
    sources: Mapping[str, Provenance] = MappingProxyType({}),
) -> list[Path]:
    """Draw and write each figure under its name, beside each other on the cores; return the files.

    Args:
        draws: functions that return the figures, by name.
        directory: of the files.
        sources: as of `save_figure`.

    Raises:
        InputError: a file cannot be written.
    """

    def write(name: str) -> Path:
        return save_figures({name: draws[name]()}, directory, sources)[0]

    first, *remaining = draws
    with ExitStack() as stack:
        for name in remaining:  # when its process has ended, which an error or Ctrl-C kills
            stack.callback(remove_partial, Path(directory) / f"{name}{picture_format().ending}")
        beside = [stack.enter_context(performed_beside(write))(name) for name in remaining]
        return [write(first), *(written() for written in beside)]
