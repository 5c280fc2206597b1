"""A study file: TOML in, a checked study out."""

from pathlib import Path

from exu_press.checks import table_from
from exu_press.errors import InputError
from exu_press.read_toml import read_toml
from exu_press.scene import load_scene
from exu_press.studies.sweep.study import Study

__all__ = ["load_study"]


def load_study(path: str | Path) -> Study:
    """Return the study of a TOML file; a scene's path counts from the study's directory.

    Raises:
        InputError: the file cannot be read or parsed, or the study or one of its scenes is not
            allowed.
    """
    path = Path(path)
    data = read_toml(path)
    if "scene" not in data:
        raise InputError(f'{path}: no scene; allowed is scene = "FILE.toml" or a [scene] table')
    if isinstance(data["scene"], str):
        data["scene"] = load_scene(path.parent / data["scene"])
    try:
        return table_from(Study, "", data)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
