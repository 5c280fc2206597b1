"""A scene file: TOML in, TOML out."""

import tomllib
from pathlib import Path
from typing import Any

from exu_press.errors import InputError
from exu_press.scene.bodies import STEP_FILES
from exu_press.schema.toml import parse_toml, read_toml

__all__ = ["parse_assignment", "scene_tables"]


def scene_tables(path: Path) -> dict[str, Any]:
    """Return the tables of a scene file; paths in them are relative to it no more.

    Raises:
        InputError: the file cannot be read or parsed, or is a mechanism's.
    """
    data = read_toml(path)
    if {"crank", "output"} <= data.keys():
        raise InputError(
            f"{path}: is a mechanism, not a scene; allowed is a scene that names it, "
            f'mechanism = "{path.name}", as `exu-press new my_scene.toml --mechanism {path.name}` '
            "writes one, or `exu-press draw` with the mechanism"
        )
    if str(data.get("mechanism", "")).lower().endswith(".toml"):
        data["mechanism"] = str(path.parent / data["mechanism"])
    if isinstance(bodies := data.get("bodies"), dict):
        data["bodies"] = {name: _keys_beside(path, body) for name, body in bodies.items()}
    if "load" in data:
        from exu_press.scene.loads import with_files_beside

        data["load"] = with_files_beside(data["load"], path.parent)
    return data


def _keys_beside(scene: Path, body: Any) -> Any:
    """Return a flexible body with its file's path taken from the scene file's directory."""
    if isinstance(body, dict) and isinstance(body.get("matrices"), str):
        return {**body, "matrices": str(scene.parent / body["matrices"])}
    if isinstance(body, dict) and "flexible" in body:
        return {**body, "flexible": _keys_beside(scene, body["flexible"])}
    is_file = isinstance(body, str) and body.lower().endswith(STEP_FILES)
    return str(scene.parent / body) if is_file else body


def parse_assignment(text: str) -> tuple[str, Any]:
    """Return key and value of "key=value"; the value is TOML, or a bare word for a text.

    >>> parse_assignment("film.viscosity=0.1")
    ('film.viscosity', 0.1)
    >>> parse_assignment("joints.crank_pin=dry")
    ('joints.crank_pin', 'dry')

    Raises:
        InputError: there is no key, no value or no equals sign.
    """
    name, equals, value = (text_part.strip() for text_part in text.partition("="))
    if not (name and equals and value):
        raise InputError(f"--set {text}: allowed is key=value, as in film.viscosity=0.1")
    try:
        return name, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return name, value
    except (RecursionError, ValueError):
        return name, parse_toml(f"value = {value}", f"--set {name}")
