"""Arguments that several commands share."""

import argparse
import sys
import textwrap
from collections.abc import Iterable
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import folder_name
from exu_press.mechanism import SHIPPED as MECHANISMS
from exu_press.plots.format import PictureFormat
from exu_press.scene import Scene
from exu_press.schema.checks import demand_known

__all__ = [
    "add_code_argument",
    "add_error_argument",
    "add_picture_arguments",
    "add_run_arguments",
    "add_scene_arguments",
    "add_set_argument",
    "add_study_arguments",
    "add_worker_arguments",
    "demand_save",
    "directory_of",
    "picture_format_of",
    "scene_of",
    "scene_path",
    "shipped_names",
    "show_warnings",
]

MOST_WARNINGS = 5

SHIPPED = Path(__file__).parent.parent / "scenes"


def add_scene_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of every command on one scene."""
    parser.add_argument(
        "scene",
        metavar="SCENE.toml",
        help=f"a scene file, or the name of a shipped one: {', '.join(shipped_names())}",
    )
    add_run_arguments(parser)


def add_run_arguments(parser: argparse.ArgumentParser, folder: str = "SCENE") -> None:
    """Add --set, --allow-code, --out, which is out/FOLDER, --quiet and those of pictures."""
    add_set_argument(parser, "the scene, as in film.viscosity=0.1")
    _add_output_arguments(parser, folder)


def add_code_argument(parser: argparse.ArgumentParser) -> None:
    """Add the permission to import what a file names."""
    parser.add_argument(
        "--allow-code",
        action="store_true",
        help="import the modules that the file names as kinds; they run with your rights",
    )


def add_set_argument(parser: argparse.ArgumentParser, of_what: str) -> None:
    """Add --set, which changes single keys."""
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help=f"change a key of {of_what}; may be repeated",
    )


def add_error_argument(parser: argparse.ArgumentParser) -> None:
    """Add --no-error, which leaves out errors of figures."""
    parser.add_argument(
        "--no-error",
        action="store_true",
        help="leave out the errors of the figures, and the finer and coarser runs that they need",
    )


def add_study_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of every command on a study file."""
    parser.add_argument("study", metavar="STUDY.toml", help="a study file")
    _add_output_arguments(parser, "STUDY")


def _add_output_arguments(parser: argparse.ArgumentParser, folder: str) -> None:
    add_code_argument(parser)
    parser.add_argument("--out", metavar="DIR", help=f"where to write (default: out/{folder})")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    add_picture_arguments(parser)


def add_worker_arguments(parser: argparse.ArgumentParser) -> None:
    """Add --workers and --dask, which say where runs are done."""
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--workers", type=int, metavar="N", help="number of processes (default: the cores)"
    )
    where.add_argument("--dask", metavar="ADDRESS", help="a Dask scheduler, as in tcp://host:8786")


def add_picture_arguments(
    parser: argparse.ArgumentParser, *, to_files: bool = True, on_paper: bool = True
) -> None:
    """Add the arguments of pictures.

    Args:
        to_files: whether the command names their files itself, and may leave them out.
        on_paper: whether they may have a width on paper.
    """
    if to_files:
        parser.add_argument("--no-pictures", action="store_true", help="draw nothing")
        parser.add_argument(
            "--format", default="png", metavar="FORMAT", help="of pictures: png, svg or pdf"
        )
    if on_paper:
        parser.add_argument(
            "--width",
            metavar="WIDTH",
            help="of pictures on paper, as in 84mm: without heading, in letters of 7 points",
        )
    parser.add_argument(
        "--style", metavar="FILE.mplstyle", help="a matplotlib style, whose settings go before ours"
    )


def picture_format_of(options: argparse.Namespace) -> PictureFormat:
    """Return how a command draws its pictures, or would.

    Raises:
        InputError: one of its options is not allowed.
    """
    if "style" not in options:
        return PictureFormat()
    chosen = PictureFormat.from_texts(
        getattr(options, "format", "png"),
        getattr(options, "width", None),
        options.style,
        getattr(options, "pictures", "default"),
    )
    if chosen.style is not None and not getattr(options, "no_pictures", False):
        from exu_press.plots.style import check_drawable  # loads matplotlib

        check_drawable(chosen.style)
    return chosen


def demand_save(options: argparse.Namespace, *names: str) -> None:
    """Raise InputError where one of these options is given, and --save is not."""
    for name in names:
        if options.save is None and (value := getattr(options, name)) is not None:
            raise InputError(f"--{name} {value}: allowed with --save")


def scene_of(options: argparse.Namespace) -> Scene:
    """Return the scene of the arguments, with its changes."""
    return Scene.load(scene_path(options.scene), options.set, allow_code=options.allow_code)


def directory_of(options: argparse.Namespace, file: str) -> Path:
    """Return the directory of --out, else that of a file; it need not exist."""
    return Path(options.out or Path("out") / folder_name(Path(file).stem))


def show_warnings(texts: Iterable[str], file: Path | None = None) -> None:
    """Print warnings, each of them once; the first few where a file has them all."""
    unique = list(dict.fromkeys(texts))
    first_texts = unique if file is None else unique[:MOST_WARNINGS]
    if len(unique) > len(first_texts):
        first_texts.append(f"{len(unique) - MOST_WARNINGS} more like these in {file}")
    for warning in first_texts:
        lines = textwrap.wrap(
            f"exu-press: warning: {warning}", 100, subsequent_indent="  ", break_on_hyphens=False
        )
        print("\n".join(lines), file=sys.stderr)


def shipped_names() -> list[str]:
    """Return the names of the shipped scenes."""
    return sorted(path.stem for path in SHIPPED.glob("*.toml"))


def scene_path(name: str) -> Path:
    """Return the file of a scene, or of the shipped one of this name."""
    path, names = Path(name), shipped_names()
    if path.exists() or path.suffix:
        return path
    if name not in names and name in MECHANISMS:
        raise InputError(
            f"{name}: is a shipped mechanism, not a scene; allowed is a scene of it, as "
            f"`exu-press new my_scene.toml --mechanism {name}` writes one, or `exu-press draw`"
        )
    demand_known(f"{name}: no such scene", name, ["a file", *names])
    return SHIPPED / f"{name}.toml"
