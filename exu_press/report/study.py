"""The common parts of studies' reports: their files are read, their pictures shown."""

import shlex
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.page import Live
from exu_press.page.study import Column
from exu_press.report.html import page, paragraph, picture, stills
from exu_press.report.run import scene_parts
from exu_press.scene import Scene
from exu_press.schema.stored import from_json
from exu_press.studies.sweep.units import shown_unit

__all__ = ["command_of", "reading", "scaled", "shown_column", "study_page"]

WRONG = (ValueError, KeyError, IndexError, TypeError, AttributeError)


@contextmanager
def reading(file: Path, wanted: str, name: str = "") -> Iterator[Any]:
    """Yield a study's JSON, of its file or another one beside it; its faults are InputErrors."""
    try:
        told = file.with_name(name) if name else file
        yield from_json(dict[str, Any], told.read_bytes(), told.name)
    except OSError as error:
        raise InputError(f"{error.filename}: cannot be read ({error.strerror})") from None
    except WRONG as error:
        raise InputError(f"{file}: not {wanted} ({error!s:.200})") from None


def study_page(
    file: Path,
    title: str,
    under: str,
    sections: Sequence[tuple[str, str | Live | None]],
    caption: str,
    *,
    scene: Scene | None = None,
    drawn: str = "*.png",
) -> str:
    """Return the page of a study.

    Args:
        file: of the study; its pictures lie beside it.
        title: of the page.
        under: line below the title, before the file's name.
        sections: its own, the live part among them.
        caption: of each picture.
        scene: whose keys and assumptions are shown at the end, if any.
        drawn: pattern of the pictures' names.
    """
    live = next((inner for _, inner in sections if isinstance(inner, Live)), None)
    found = [path for path in sorted(file.parent.glob(drawn)) if path.is_file()]
    pictures = "\n".join(picture(path, caption) for path in found)
    shown = stills(pictures or paragraph("None was drawn."), live)
    about = [] if scene is None else scene_parts(scene)
    under = f"{under}; {file.parent.name}/{file.name}"
    return page(title, under, [*sections, ("Pictures", shown), *about])


def command_of(changes: Mapping[str, Any]) -> str:
    """Return the command that runs a study's scene with keys changed; None leaves one as it is.

    >>> command_of({"speed_rpm": 300.0, "film.law": None})
    'exu-press run SCENE.toml --set speed_rpm=300.0'
    """
    told = (f"{name}={value}" for name, value in changes.items() if value is not None)
    return " ".join(["exu-press run SCENE.toml", *(f"--set {shlex.quote(one)}" for one in told)])


def shown_column(
    name: str,
    values: Sequence[Any],
    low: Sequence[float | None] | None = None,
    high: Sequence[float | None] | None = None,
    other: str | None = None,
) -> Column:
    """Return a key or a quantity of a study's runs, SI, in the unit of `shown_unit`."""
    numbers = [value for value in values if isinstance(value, float)]
    unit, scale = shown_unit(name, numbers, other)
    ends = (None if each is None else scaled(each, scale) for each in (low, high))
    return Column(name, unit, scaled(values, scale), *ends)


def scaled(values: Sequence[Any], scale: float) -> list[Any]:
    """Return values with a factor at the numbers among them."""
    return [scale * value if isinstance(value, float) else value for value in values]
