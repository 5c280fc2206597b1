"""Arguments that several commands share."""

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

from exu_press.scene import Scene, load_scene

__all__ = ["add_scene_arguments", "directory_of", "scene_of", "show_warnings"]

MOST_WARNINGS = 5

SHIPPED = Path(__file__).parent.parent / "scenes"


def add_scene_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what every command on one scene takes."""
    parser.add_argument(
        "scene",
        metavar="SCENE.toml",
        help="a scene file, or the name of a shipped one: "
        + ", ".join(sorted(path.stem for path in SHIPPED.glob("*.toml"))),
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="change a key of the scene, as in film.viscosity=0.1; may be repeated",
    )
    parser.add_argument("--out", metavar="DIR", help="where to write (default: out/SCENE)")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--no-pictures", action="store_true", help="draw nothing")


def scene_of(options: argparse.Namespace) -> Scene:
    """Return the scene that is asked for, with its changes."""
    return load_scene(_path(options.scene), options.set)


def directory_of(options: argparse.Namespace) -> Path:
    """Return the directory that is asked for; it need not exist."""
    return Path(options.out or Path("out") / Path(options.scene).stem)


def show_warnings(found: Iterable[str]) -> None:
    """Print the first few warnings, each of them once."""
    each = list(dict.fromkeys(found))
    for warning in each[:MOST_WARNINGS]:
        print(f"exu-press: warning: {warning}", file=sys.stderr)
    if len(each) > MOST_WARNINGS:
        print(f"exu-press: warning: {len(each) - MOST_WARNINGS} more like these", file=sys.stderr)


def _path(given: str) -> Path:
    shipped = SHIPPED / f"{given}.toml"
    return shipped if not Path(given).exists() and shipped.exists() else Path(given)
