"""Write a scene file to start from: keys with their meaning, unused ones as comments."""

import argparse
import dataclasses
import os
from pathlib import Path

from exu_press.errors import InputError
from exu_press.files.output_directory import replacing
from exu_press.scene import Scene
from exu_press.scene.template import template

__all__ = ["EXAMPLE", "add_arguments", "execute"]

EXAMPLE = "exu-press new my_press.toml --mechanism press"

SHIPPED = next(f for f in dataclasses.fields(Scene) if f.name == "mechanism").metadata["choices"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("file", metavar="FILE.toml", help="the file to write; must not exist")
    parser.add_argument(
        "--mechanism",
        default="press",
        metavar="NAME",
        help=f"a shipped mechanism ({', '.join(SHIPPED)}; default: press) or a mechanism file",
    )


def execute(options: argparse.Namespace) -> int:
    """Write the file; return 0."""
    path = Path(options.file)
    if path.suffix != ".toml":
        raise InputError(f"{path}: allowed is a name that ends in .toml")
    if path.exists():
        raise InputError(f"{path}: exists; allowed is another name")
    text = template(options.mechanism, os.path.relpath(options.mechanism or ".", path.parent))
    with replacing(path) as partial:
        partial.write_text(text, encoding="utf-8")
    print(f"written: {path}; run it with: exu-press run {path}")
    return 0
